"""Peaks of a sampled oscillation, with interpolation between samples.

A peak is a maximum above zero or a minimum below zero, as in eqs. (9)-(12). The ends of a series are not
peaks: the release of a free oscillation is its start, not one of its peaks.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.motion.extrema import extrema_of_derivative, extrema_of_samples, peaks_among
from pyjoystick.motion.records.derivatives import ratio_to_rate
from pyjoystick.support import FloatArray, SeriesError, not_negative, real_numbers


def find_peaks(
    time: ArrayLike,
    value: ArrayLike,
    derivative: ArrayLike | None = None,
    *,
    minimum_height: float = 0.0,
    minimum_prominence: float = 0.0,
) -> pd.DataFrame:
    """Find peaks of both signs.

    With the derivative (omega for theta, alpha for omega), a peak is an extremum of the cubic that matches
    the values and derivatives of two adjacent samples. For smooth series, its error decreases with the sample
    spacing h as h^4 in value and h^3 in time. Without the derivative, a quartic through five samples replaces
    the cubic: h^5 and h^4. The velocity of the joystick peaks between kinks that are closer together
    than most samples; there neither order applies, and the time is accurate to about a sample.

    Three or more equal samples at the top (a clipped or resting signal) count as one peak in their middle.
    Nothing is smoothed: in noise, every ripple is a peak unless `minimum_prominence` is larger than its
    swing.

    Args:
        time: times (s), shape (n,), strictly increasing
        value: the series, shape (n,), n >= 3; rad for ``theta`` of a run, not degrees
        derivative: its time derivative, shape (n,); rad/s for ``omega``
        minimum_height: peaks with a smaller |value| are ignored
        minimum_prominence: a peak counts only if the series returns by this much on either side before it
            exceeds the peak

    Returns:
        one row per peak in order of time, with the columns ``time`` (s), ``value`` (the unit of the series)
        and ``sign`` (1 for a maximum, -1 for a minimum); empty if there are no peaks. ``attrs["units"]`` has
        the unit of ``time`` and, for a column of a table that has units, of ``value``

    Raises:
        SeriesError: a series is not one-dimensional, not of the length of the others, too short, contains NaN
            or infinity; the time does not increase; or the derivative is that of something else
        ParameterError: a limit is negative or not finite
    """
    instants, values = _series("time", time), _series("value", value)
    slopes = None if derivative is None else _series("derivative", derivative)
    _check_lengths(instants, values, slopes)
    if slopes is not None and (ratio := ratio_to_rate(instants, values, slopes, smallest=0.0)) is not None:
        raise SeriesError("derivative", f"is not that of value, which changes {ratio:.3g} times as fast")
    height = not_negative("minimum_height", minimum_height)
    prominence = not_negative("minimum_prominence", minimum_prominence)
    extrema = (
        extrema_of_samples(instants, values)
        if slopes is None
        else extrema_of_derivative(instants, values, slopes)
    )
    peaks = peaks_among(extrema, values[0], values[-1], height, prominence)
    table = pd.DataFrame({"time": peaks[:, 0], "value": peaks[:, 1], "sign": peaks[:, 2].astype(np.int64)})
    unit = value.attrs.get("units", {}).get(value.name) if isinstance(value, pd.Series) else None
    table.attrs["units"] = {"time": "s"} | ({} if unit is None else {"value": unit})
    return table


def periods(peaks: pd.DataFrame, *, release_time: float | None = None) -> pd.DataFrame:
    """Period around each peak: time from the previous to the next peak, which are on the other side.

    Args:
        peaks: alternating peaks, from `find_peaks`
        release_time: time (s) of the release from rest, which then counts as the peak before the first one

    Returns:
        one row per peak that has neighbors on both sides: ``time`` (s), ``amplitude`` (magnitude of the
        peak) and ``period`` (s)
    """
    times, values = peaks["time"].to_numpy(), np.abs(peaks["value"].to_numpy())
    if release_time is None:
        middle = slice(1, -1)
    else:
        times, middle = np.insert(times, 0, release_time), slice(0, -1)
    spans = times[2:] - times[:-2]
    return pd.DataFrame({"time": times[1:-1], "amplitude": values[middle][: len(spans)], "period": spans})


def _series(name: str, series: ArrayLike) -> FloatArray:
    try:
        array = real_numbers(series)
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
