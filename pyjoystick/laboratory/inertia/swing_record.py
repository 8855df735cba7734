"""Period of a recorded swing, corrected for amplitude and damping."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from scipy.linalg import solve_triangular

from pyjoystick.laboratory.inertia.budget import Measured, combined
from pyjoystick.laboratory.inertia.decay import fitted_decay
from pyjoystick.laboratory.inertia.swing import SwingPeriod, amplitude_factor, half_swing_factor
from pyjoystick.laboratory.inertia.swing_checks import check_swings
from pyjoystick.laboratory.inertia.turns import Turns, turns_of, whole_swings
from pyjoystick.motion import Record, RecordError
from pyjoystick.support import FloatArray

#: Smallest standard error of a crossing, relative to the period: what rounding does to records without noise.
_ROUNDING: Final = 1e-12
#: Standard uncertainty of the method, relative to the period: higher orders of amplitude and friction.
_METHOD: Final = 2e-6
#: An amplitude grows if the last third of the heights exceeds the first by this many standard errors
_SIGNIFICANT: Final = 5.0
#: and by this part of the first; less does no harm.
_GROWTH: Final = 0.01


def period_of_record(record: Record) -> SwingPeriod:
    """Period of small undamped swings from the angle over time.

    Tops of the half swings and zero crossings come from polynomials through nearby samples.
    The times of the crossings are a straight line over the sum of the factors by which amplitude and friction
    lengthen the half swings between them (`half_swing_factor`); its slope is half the period. The heights
    give dry friction and the damping ratio z of viscous damping, hence the factor sqrt(1 - z^2).

    Args:
        record: the joystick as a pendulum, with at least five half swings above a fifth of the largest angle

    Raises:
        RecordError: too few half swings, or too few samples in one; a second release, or an amplitude that
            grows; a gap that may hide a turn; an angle that stays at the end of the instrument's range
    """
    # The record's zero may differ from the rest position, which follows from the tops.
    centered = record.theta - float(np.mean(record.theta))
    check_swings(record, centered, whole_swings(record, centered))
    turns = turns_of(record, centered - _middle(turns_of(record, centered)))
    _require_decay(record, turns)
    heights, passages = np.abs(turns.tops)[1:-1], turns.passages
    decay = fitted_decay(np.abs(turns.tops), turns.top_errors)
    found = decay.damping_ratio.value, decay.friction_angle.value
    whitening = _whitening(turns, *found)

    def line(ratio: float, friction: float) -> tuple[float, float]:
        return _slope(half_swing_factor(heights, friction, ratio), passages, whitening)

    def undamped(passages: float, ratio: float, friction: float, method: float) -> float:
        return (line(ratio, friction)[0] + passages) * (math.sqrt(1.0 - ratio**2) + method)

    scatter = line(*found)[1]
    estimate = combined(
        undamped,
        {
            "passages": Measured(0.0, scatter, len(passages) - 2.0),
            "ratio": decay.damping_ratio,
            "friction": decay.friction_angle,
            "method": Measured(0.0, _METHOD),
        },
    )
    return SwingPeriod(
        estimate,
        2.0 * float(passages[-1] - passages[0]) / (len(passages) - 1),
        float(np.mean(amplitude_factor(heights))),
        decay,
    )


def _require_decay(record: Record, turns: Turns) -> None:
    """Refuse an amplitude that slowly grows, as that of no free pendulum does."""
    heights, count = np.abs(turns.tops), len(turns.tops) // 3
    first, last = heights[:count], heights[-count:]
    before, after = float(np.mean(first)), float(np.mean(last))
    # The scatter counts, too: that of a beat, or of coarse angles, exceeds the noise.
    squares = np.concatenate((turns.top_errors[:count], turns.top_errors[-count:])) ** 2
    error = math.sqrt((float(np.mean(squares)) * 2.0 + float(np.var(first) + np.var(last))) / count)
    if after - before <= max(_SIGNIFICANT * error, _GROWTH * before):
        return
    raise RecordError(
        record.source,
        f"the amplitude grows, from {math.degrees(before):.4g} degrees in the first third of the half swings",
        "let the joystick swing freely: nothing may drive it, such as a moving support",
        column="theta",
        value=f"{math.degrees(after):.4g} degrees in the last third",
    )


def _middle(turns: Turns) -> float:
    """The rest angle: the mean of a top and of the two adjacent ones on the other side."""
    tops = turns.tops
    return float(np.mean((tops[:-2] + 2.0 * tops[1:-1] + tops[2:]) / 4.0))


def _whitening(turns: Turns, ratio: float, friction: float) -> FloatArray:
    """Lower triangular L of the covariance L*L' of the crossings about their line (s2).

    An error of a height changes the amplitude factor of one half swing and so delays all later crossings. At
    60 degrees these errors add up to three times those of the crossings themselves.
    """
    half = float(np.mean(np.diff(turns.passages)))
    heights, errors = np.abs(turns.tops)[1:-1], turns.top_errors[1:-1]
    changed, factors = (half_swing_factor(one, friction, ratio) for one in (heights + errors, heights))
    common = np.tril(np.ones((len(heights) + 1, len(heights))), -1) * (half * (changed - factors))
    own = np.hypot(turns.passage_errors, _ROUNDING * half)
    return np.asarray(np.linalg.cholesky(np.diag(own**2) + common @ common.T))


def _slope(factors: FloatArray, passages: FloatArray, whitening: FloatArray) -> tuple[float, float]:
    """Slope of the crossings over the sum of the factors of the half swings between, and its standard error.

    If the crossings scatter more than the noise of the samples explains, that scatter counts.
    """
    phase = np.concatenate(([0.0], np.cumsum(factors))) / 2.0
    columns = np.column_stack((np.ones_like(phase), phase, passages - passages[0]))
    white = solve_triangular(whitening, columns, lower=True)
    design, times = white[:, :2], white[:, 2]
    found = np.linalg.lstsq(design, times, rcond=None)[0]
    residual = times - design @ found
    excess = max(1.0, float(residual @ residual) / (len(times) - 2))
    variance = float(np.linalg.inv(design.T @ design)[1, 1])
    return float(found[1]), math.sqrt(excess * variance)
