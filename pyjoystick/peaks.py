"""Peaks of a sampled oscillation, located between the samples.

A peak is a maximum above zero or a minimum below zero, as eqs. (9)-(12) use them. The ends of a series are no
peaks: the release of a free oscillation is its start, not one of its peaks.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from pyjoystick._types import FloatArray
from pyjoystick.checks import not_negative
from pyjoystick.errors import SeriesError

_STENCIL = 5


class _Extremum(NamedTuple):
    time: float
    value: float
    sign: int


def find_peaks(
    time: ArrayLike,
    value: ArrayLike,
    derivative: ArrayLike | None = None,
    *,
    minimum_height: float = 0.0,
    minimum_prominence: float = 0.0,
) -> pd.DataFrame:
    """Peaks of both signs.

    With the derivative (omega for theta, alpha for omega) a peak is where the cubic that has the values and
    derivatives of the two samples around it is extreme. For smooth series its error falls with the sample
    spacing h as h^4 in value and h^3 in time. Without the derivative a quartic through five samples takes the
    place of the cubic: h^5 and h^4. The velocity of the joystick peaks between kinks that lie closer together
    than most samples do; there neither order holds and the time is good to about a sample.

    Three or more equal samples at the top (a clipped or resting signal) count as one peak in their middle.
    Nothing is smoothed: in noise every ripple is a peak unless `minimum_prominence` is larger than its swing.

    Args:
        time: instants (s), shape (n,), strictly increasing
        value: the series, shape (n,), n >= 3
        derivative: its derivative with respect to time, shape (n,)
        minimum_height: peaks with |value| below this are left out
        minimum_prominence: a peak counts only if the series comes back by this much on either side before it
            goes beyond the peak

    Returns:
        one row a peak in order of time, with the columns ``time`` (s), ``value`` (the unit of the series) and
        ``sign`` (1 for a maximum, -1 for a minimum); empty where there is no peak

    Raises:
        SeriesError: a series is not one-dimensional, not of the length of the others, too short, holds NaN or
            infinity, or the time does not increase
        ParameterError: a limit is negative or not finite
    """
    instants, values = _series("time", time), _series("value", value)
    slopes = None if derivative is None else _series("derivative", derivative)
    _check_lengths(instants, values, slopes)
    height = not_negative("minimum_height", minimum_height)
    prominence = not_negative("minimum_prominence", minimum_prominence)
    extrema = _of_samples(instants, values) if slopes is None else _of_derivative(instants, values, slopes)
    peaks = [
        extremum
        for extremum in _prominent(extrema, float(values[0]), float(values[-1]), prominence)
        if extremum.value * extremum.sign > 0.0 and abs(extremum.value) >= height
    ]
    return pd.DataFrame(
        {
            "time": np.array([peak.time for peak in peaks], dtype=np.float64),
            "value": np.array([peak.value for peak in peaks], dtype=np.float64),
            "sign": np.array([peak.sign for peak in peaks], dtype=np.int64),
        }
    )


def _series(name: str, series: ArrayLike) -> FloatArray:
    try:
        array = np.array(series, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise SeriesError(name, "must hold numbers only") from error
    if array.ndim != 1:
        raise SeriesError(name, f"must be one-dimensional, has the shape {array.shape}")
    for i in np.flatnonzero(~np.isfinite(array))[:1]:
        raise SeriesError(name, f"is {array[i]} at index {i}; must be finite")
    return array


def _check_lengths(instants: FloatArray, values: FloatArray, slopes: FloatArray | None) -> None:
    for name, series in (("value", values), ("derivative", slopes)):
        if series is not None and len(series) != len(instants):
            raise SeriesError(name, f"has {len(series)} samples, time has {len(instants)}")
    if len(instants) < 3:
        raise SeriesError("time", f"has {len(instants)} samples; at least 3 are needed")
    for i in np.flatnonzero(np.diff(instants) <= 0.0)[:1]:
        raise SeriesError("time", f"must increase; index {i + 1} is {instants[i + 1]} after {instants[i]}")


def _runs(series: FloatArray) -> list[tuple[int, int]]:
    """First and last index of every run of equal samples."""
    starts = np.concatenate(([0], np.flatnonzero(np.diff(series) != 0.0) + 1))
    ends = np.append(starts[1:], len(series)) - 1
    return list(zip(starts.tolist(), ends.tolist(), strict=True))


def _of_derivative(instants: FloatArray, values: FloatArray, slopes: FloatArray) -> list[_Extremum]:
    """Extrema where the derivative changes its sign, at once or after a stretch of zeros."""
    signs = np.sign(slopes)
    extrema = []
    moving = np.flatnonzero(signs)
    for before, after in zip(moving[:-1].tolist(), moving[1:].tolist(), strict=True):
        if signs[before] == signs[after]:
            continue
        sign = int(signs[before])
        if after == before + 1:
            extrema.append(_cubic_extremum(instants, values, slopes, before, sign))
        else:
            extrema.append(_middle(instants, values, before + 1, after - 1, sign))
    return extrema


def _cubic_extremum(
    instants: FloatArray, values: FloatArray, slopes: FloatArray, i: int, sign: int
) -> _Extremum:
    """The extremum of the Hermite cubic between samples i and i+1, whose slopes differ in sign."""
    spacing = float(instants[i + 1] - instants[i])
    start, end = float(slopes[i]) * spacing, float(slopes[i + 1]) * spacing
    rise = float(values[i + 1] - values[i])
    # The slope of the cubic is start + 2*b*s + 3*a*s^2 with s from 0 to 1; it has one zero in there.
    a, b = start + end - 2.0 * rise, 3.0 * rise - 2.0 * start - end
    root = float(np.sqrt(b * b - 3.0 * a * start))
    s = -start / (b - sign * root)
    return _Extremum(float(instants[i]) + s * spacing, float(values[i]) + s * (start + s * (b + s * a)), sign)


def _of_samples(instants: FloatArray, values: FloatArray) -> list[_Extremum]:
    """Extrema of the samples, refined by a polynomial through their neighbors."""
    runs = _runs(values)
    extrema = []
    for (_, before), (first, last), (after, _) in zip(runs, runs[1:], runs[2:], strict=False):
        sign = int(np.sign(values[first] - values[before]))
        if np.sign(values[last] - values[after]) != sign:
            continue
        if last - first >= 2:
            extrema.append(_middle(instants, values, first, last, sign))
        else:
            extrema.append(_polynomial_extremum(instants, values, first, last, sign))
    return extrema


def _middle(instants: FloatArray, values: FloatArray, first: int, last: int, sign: int) -> _Extremum:
    middle = 0.5 * float(instants[first] + instants[last])
    return _Extremum(middle, float(np.interp(middle, instants, values)), sign)


def _polynomial_extremum(
    instants: FloatArray, values: FloatArray, first: int, last: int, sign: int
) -> _Extremum:
    """The extremum of the quartic through five samples around the highest (or lowest) one.

    Where it has none between the neighboring samples the parabola through the three in the middle is taken,
    which always has one.
    """
    lowest = min(max(first - _STENCIL // 2, 0), max(len(values) - _STENCIL, 0))
    spacing = float(instants[last + 1] - instants[first - 1])
    bounds = (
        (instants[first - 1] - instants[first]) / spacing,
        (instants[last + 1] - instants[first]) / spacing,
    )
    nearest, height = 0.0, 0.0
    for stencil in (slice(first - 1, first + 2), slice(lowest, lowest + _STENCIL)):
        x = (instants[stencil] - instants[first]) / spacing
        polynomial = Polynomial(
            np.linalg.solve(np.vander(x, increasing=True), values[stencil] - values[first])
        )
        places = _extrema_inside(polynomial, bounds, sign)
        if places:
            nearest = min(places, key=abs)
            height = float(polynomial(nearest))
    return _Extremum(float(instants[first]) + nearest * spacing, float(values[first]) + height, sign)


def _extrema_inside(polynomial: Polynomial, bounds: tuple[float, float], sign: int) -> list[float]:
    slope = polynomial.deriv()
    real = [float(root.real) for root in slope.roots() if root.imag == 0.0]
    curvature = slope.deriv()
    return [root for root in real if bounds[0] < root < bounds[1] and float(curvature(root)) * sign < 0.0]


def _prominent(
    extrema: Iterable[_Extremum], first: float, last: float, prominence: float
) -> Iterable[_Extremum]:
    """The extrema from which the series comes back by `prominence` on either side.

    The most extreme value since the last turn is held until the series has come back far enough from it. The
    ends of the series may be what it comes back to, but are not extrema themselves.
    """
    lowest = highest = first
    held: _Extremum | None = None
    for extremum in extrema:
        if held is None:
            rise = extremum.value - lowest if extremum.sign > 0 else highest - extremum.value
            lowest, highest = min(lowest, extremum.value), max(highest, extremum.value)
            held = extremum if rise >= prominence else None
        elif extremum.sign == held.sign:
            held = extremum if (extremum.value - held.value) * held.sign > 0.0 else held
        elif abs(extremum.value - held.value) >= prominence:
            yield held
            held = extremum
    if held is not None and (held.value - last) * held.sign >= prominence:
        yield held
