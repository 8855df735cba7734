"""Period of a recorded swing, corrected for amplitude and damping."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.polynomial import Polynomial
from scipy.stats import linregress

from pyjoystick.laboratory.inertia.budget import Measured, combined
from pyjoystick.laboratory.inertia.decay import fitted_decay
from pyjoystick.laboratory.inertia.swing import SwingPeriod, amplitude_factor
from pyjoystick.laboratory.inertia.swing_checks import check_swings, widest_gap
from pyjoystick.motion import Record, RecordError, Swing, find_swings
from pyjoystick.support import FloatArray

_FEWEST_SWINGS: Final = 5
#: Fraction of a half swing's height that separates the samples of its top from those of the zero crossing.
_TOP: Final = 0.7
_PASSAGE: Final = 0.5
_FEWEST_SAMPLES: Final = 6
_THRESHOLD: Final = 0.2


def period_of_record(record: Record) -> SwingPeriod:
    """Period of small undamped swings from the angle over time.

    Tops of the half swings and zero crossings come from polynomials through nearby samples.
    The times of the crossings are a straight line over the sum of the amplitude factors of the half swings
    between them; its slope is half the period. The heights give the damping ratio z of viscous damping,
    hence the factor sqrt(1 - z^2), and dry friction. Dry friction does not change the time from turn to turn,
    but delays the zero crossings by asin(f/(A - f)) of phase, for the amplitude A and the angle
    f = T_c/(m*g*h): the smaller the swing, the longer the delay.

    Args:
        record: the joystick as a pendulum, with at least five half swings above a fifth of the largest angle

    Raises:
        RecordError: too few half swings, or too few samples in one; a second release; a gap that may hide a
            turn; an angle that stays at the end of the instrument's range
    """
    # The record's zero may differ from the rest position, which follows from the tops.
    centered = record.theta - float(np.mean(record.theta))
    check_swings(record, centered, _whole_swings(record, centered))
    theta = record.theta - _middle(record, centered, record.theta)
    tops, passages = _tops_and_passages(record, theta)
    heights = np.abs(tops)
    inner = amplitude_factor(heights[1:-1])
    phase = np.concatenate(([0.0], np.cumsum(inner))) / 2.0
    decay = fitted_decay(heights)

    def line(friction: float) -> tuple[float, float]:
        late = np.arcsin(np.clip(friction / (heights[:-1] - friction), -1.0, 1.0)) / (2.0 * math.pi)
        found = linregress(phase + late, passages)
        return float(found.slope), float(found.stderr)

    def undamped(passages: float, ratio: float, friction: float) -> float:
        return (line(friction)[0] + passages) * math.sqrt(1.0 - ratio**2)

    scatter = line(decay.friction_angle.value)[1]
    estimate = combined(
        undamped,
        {
            "passages": Measured(0.0, scatter, len(passages) - 2.0),
            "ratio": decay.damping_ratio,
            "friction": decay.friction_angle,
        },
    )
    return SwingPeriod(
        estimate,
        2.0 * float(passages[-1] - passages[0]) / (len(passages) - 1),
        float(np.mean(inner)),
        decay,
    )


def _middle(record: Record, centered: FloatArray, theta: FloatArray) -> float:
    """The rest angle: the mean of a top and of the two adjacent ones on the other side."""
    shift = theta[0] - centered[0]
    tops, _ = _tops_and_passages(record, centered)
    return float(shift + np.mean((tops[:-2] + 2.0 * tops[1:-1] + tops[2:]) / 4.0))


def _tops_and_passages(record: Record, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Angles of the tops of the half swings, shape (n,); times of the crossings between, shape (n-1,)."""
    swings = _whole_swings(record, theta)
    tops = np.empty(len(swings))
    for i, swing in enumerate(swings):
        span = slice(swing.first, swing.last + 1)
        time, height = record.time[span], theta[span] * swing.sign
        top = height > _TOP * np.max(height)
        curve = _polynomial(record, span, time[top], height[top], 4)
        grid = np.linspace(time[top][0], time[top][-1], 201)
        tops[i] = swing.sign * np.max(curve(grid))
    passages = np.empty(len(swings) - 1)
    for i, (before, after) in enumerate(pairwise(swings)):
        span = slice(before.extreme, after.extreme + 1)
        time, angle = record.time[span], theta[span]
        around = slice(before.first, after.last + 1)
        near = np.abs(angle) < _PASSAGE * min(abs(tops[i]), abs(tops[i + 1]))
        # Fit time as a function of the angle, so that the crossing is its value at 0.
        passages[i] = _polynomial(record, around, angle[near], time[near], 3)(0.0)
    return tops, passages


def _whole_swings(record: Record, theta: FloatArray) -> list[Swing]:
    """Complete half swings, without the first and the last, which may be cut off."""
    swings = find_swings(theta, _THRESHOLD * float(np.max(np.abs(theta))))[1:-1]
    if len(swings) < _FEWEST_SWINGS:
        reason = f"has {len(swings)} whole half swings that count; at least {_FEWEST_SWINGS} are needed"
        raise RecordError(record.source, reason, "record the pendulum for longer", column="theta")
    return swings


def _polynomial(record: Record, span: slice, x: FloatArray, y: FloatArray, degree: int) -> Polynomial:
    """Polynomial through some of the samples of one stretch or of two adjacent ones."""
    if len(x) < _FEWEST_SAMPLES:
        reason = f"has {len(x)} samples where {_FEWEST_SAMPLES} are needed for a top or a passage of zero"
        rows, advice = record.rows[[span.start, span.stop - 1]], "record with more samples a second"
        # A gap may hide the samples at the end of the stretch.
        gap = widest_gap(record, slice(max(span.start - 1, 0), span.stop + 1))
        if gap is not None:
            missing = float(record.time[gap + 1] - record.time[gap])
            reason += f": {missing:.4g} s are missing"
            rows, advice = record.rows[[gap, gap + 1]], "cut the record before the gap, or record it again"
        raise RecordError(record.source, reason, advice, column="theta", rows=rows)
    return Polynomial.fit(x, y, degree)
