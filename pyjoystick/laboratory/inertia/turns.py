"""Turns and zero crossings of a recorded swing, with standard errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial import Polynomial

from pyjoystick.laboratory.inertia.swing_checks import widest_gap
from pyjoystick.motion import Record, RecordError, Swing, find_swings
from pyjoystick.support import FloatArray

_FEWEST_SWINGS: Final = 5
#: Fraction of a half swing's height that separates the samples of its top from those of the zero crossing.
_TOP: Final = 0.7
_PASSAGE: Final = 0.5
_FEWEST_SAMPLES: Final = 6
_THRESHOLD: Final = 0.2
#: Points at which the largest angle of a half swing is sought.
_POINTS: Final = 201
#: Steps of Newton's method to a crossing, from the middle of its samples.
_STEPS: Final = 6


@dataclass(frozen=True, slots=True, eq=False)
class Turns:
    """Turns of n whole half swings and the crossings of the middle between them.

    The standard errors are those of the samples' noise, which is estimated from all of the samples used. So
    they are known even where a record has only a few swings.

    Attributes:
        tops: angles of the turns (rad), shape (n,)
        top_errors: their standard errors (rad)
        passages: times of the crossings (s), shape (n-1,)
        passage_errors: their standard errors (s)
    """

    tops: FloatArray
    top_errors: FloatArray
    passages: FloatArray
    passage_errors: FloatArray


def turns_of(record: Record, theta: FloatArray) -> Turns:
    """Tops of half swings and zero crossings, from polynomials through nearby samples.

    Args:
        record: the measured record
        theta: its angle from the rest position (rad), shape (n,)

    Raises:
        RecordError: too few half swings, or too few samples in one
    """
    swings = whole_swings(record, theta)
    at_tops = [_top_curve(record, theta, swing) for swing in swings]
    highest = [curve.highest(swing.sign) for curve, swing in zip(at_tops, swings, strict=True)]
    tops = np.array([curve.polynomial(t) for curve, t in zip(at_tops, highest, strict=True)])
    crossings = [
        _crossing_curve(record, theta, pair, _PASSAGE * float(np.min(np.abs(tops[i : i + 2]))))
        for i, pair in enumerate(pairwise(swings))
    ]
    passages = np.array([curve.zero() for curve in crossings])
    slopes = np.array([curve.polynomial.deriv()(t) for curve, t in zip(crossings, passages, strict=True)])
    curves = at_tops + crossings
    noise = math.sqrt(sum(one.squares for one in curves) / sum(one.freedom for one in curves))
    errors = [
        noise * np.array([curve.error_factor(t) for curve, t in zip(group, times, strict=True)])
        for group, times in ((at_tops, highest), (crossings, passages))
    ]
    return Turns(tops, errors[0], passages, errors[1] / np.abs(slopes))


def whole_swings(record: Record, theta: FloatArray) -> list[Swing]:
    """Complete half swings, without the first and the last, which may be cut off."""
    swings = find_swings(theta, _THRESHOLD * float(np.max(np.abs(theta))))[1:-1]
    if len(swings) < _FEWEST_SWINGS:
        reason = f"has {len(swings)} whole half swings that count; at least {_FEWEST_SWINGS} are needed"
        raise RecordError(record.source, reason, "record the pendulum for longer", column="theta")
    return swings


@dataclass(frozen=True, slots=True, eq=False)
class _Curve:
    """A polynomial through samples: sum of squares, degrees of freedom, covariance for noise of 1."""

    polynomial: Polynomial
    squares: float
    freedom: int
    covariance: FloatArray

    def error_factor(self, time: float) -> float:
        """Standard error of the value at a time, relative to the noise of the samples."""
        offset, scale = self.polynomial.mapparms()
        row = (offset + scale * time) ** np.arange(len(self.covariance))
        return math.sqrt(float(row @ self.covariance @ row))

    def highest(self, sign: int) -> float:
        """Time of the largest value on one side."""
        grid = np.linspace(self.polynomial.domain[0], self.polynomial.domain[1], _POINTS)
        return float(grid[np.argmax(self.polynomial(grid) * sign)])

    def zero(self) -> float:
        """Time of the value 0, by Newton's method within the samples."""
        first, last = self.polynomial.domain
        slope, time = self.polynomial.deriv(), 0.5 * float(first + last)
        for _ in range(_STEPS):
            time = float(np.clip(time - self.polynomial(time) / slope(time), first, last))
        return time


def _top_curve(record: Record, theta: FloatArray, swing: Swing) -> _Curve:
    span = slice(swing.first, swing.last + 1)
    height = theta[span] * swing.sign
    chosen = height > _TOP * np.max(height)
    _require_enough(record, span, np.count_nonzero(chosen))
    return _curve(record.time[span][chosen], theta[span][chosen], 4)


def _crossing_curve(record: Record, theta: FloatArray, swings: tuple[Swing, Swing], largest: float) -> _Curve:
    before, after = swings
    span = slice(before.extreme, after.extreme + 1)
    near = np.abs(theta[span]) < largest
    _require_enough(record, slice(before.first, after.last + 1), np.count_nonzero(near))
    return _curve(record.time[span][near], theta[span][near], 3)


def _curve(time: FloatArray, angle: FloatArray, degree: int) -> _Curve:
    found = Polynomial.fit(time, angle, degree)
    offset, scale = found.mapparms()
    powers = np.vander(offset + scale * time, degree + 1, increasing=True)
    residual = angle - found(time)
    covariance = np.linalg.inv(powers.T @ powers)
    return _Curve(found, float(residual @ residual), len(time) - degree - 1, covariance)


def _require_enough(record: Record, span: slice, count: int | np.intp) -> None:
    """Refuse a top or crossing with too few samples for a polynomial."""
    if count >= _FEWEST_SAMPLES:
        return
    reason = f"has {count} samples where {_FEWEST_SAMPLES} are needed for a top or a passage of zero"
    rows, advice = record.rows[[span.start, span.stop - 1]], "record with more samples a second"
    # A gap may hide the samples at the end of the stretch.
    gap = widest_gap(record, slice(max(span.start - 1, 0), span.stop + 1))
    if gap is not None:
        missing = float(record.time[gap + 1] - record.time[gap])
        reason += f": {missing:.4g} s are missing"
        rows, advice = record.rows[[gap, gap + 1]], "cut the record before the gap, or record it again"
    raise RecordError(record.source, reason, advice, column="theta", rows=rows)
