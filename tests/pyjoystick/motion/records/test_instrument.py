"""Counters that wrap around and sensors that freeze, against motions that only look like it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import Record, RecordError, check_free_oscillation
from pyjoystick.motion.records.instrument import require_no_jump
from pyjoystick.motion.spline import fit_spline
from pyjoystick.support import FloatArray

RATE = 250.0
HOLD = 50


def _degrees() -> FloatArray:
    """A joystick that is held for 0.2 s and released from -20 degrees, with noise."""
    time = np.arange(400) / RATE
    run = simulate(NOMINAL, time=time[HOLD:] - time[HOLD], theta_start=math.radians(-20.0))
    theta = np.concatenate((np.full(HOLD, -20.0), np.degrees(run.theta)))
    return theta + np.random.default_rng(2).normal(0.0, 0.05, len(theta))


DEGREES = _degrees()


def _record(degrees: FloatArray) -> Record:
    return Record("made", np.arange(len(degrees)) / RATE, np.radians(degrees))


@pytest.mark.parametrize("half", [6.0, 11.0])
def test_a_counter_that_wraps_is_refused_with_the_rows(half: float) -> None:
    wrapped = (DEGREES + half) % (2.0 * half) - half
    with pytest.raises(RecordError, match=r"the angle jumps by .* did a counter wrap around") as caught:
        check_free_oscillation(_record(wrapped))
    jumps = np.flatnonzero(np.abs(np.diff(wrapped)) > half)
    assert caught.value.rows == tuple(np.unique(np.concatenate((jumps, jumps + 1))).tolist())


@pytest.mark.parametrize("rate", [10.0, 30.0, 60.0, 1000.0])
def test_no_sampling_makes_a_jump_of_a_motion(rate: float) -> None:
    time = np.arange(0.0, 1.4, 1.0 / rate)
    run = simulate(NOMINAL, time=time, theta_start=math.radians(-20.0))
    require_no_jump(Record("made", time, np.asarray(run.theta)))


@pytest.mark.parametrize("count", [3, 10])
def test_a_sensor_that_freezes_is_noted_with_its_rows(count: int) -> None:
    frozen = DEGREES.copy()
    frozen[80 : 80 + count] = frozen[80]
    [note] = [note for note in check_free_oscillation(_record(frozen)).notes if "exactly the same" in note]
    assert f"for up to {count} samples" in note
    assert f"(rows 80-{79 + count})" in note


@pytest.mark.parametrize("step", [1e-4, 0.02, 0.1, 0.5])
def test_coarse_angles_are_not_frozen(step: float) -> None:
    """They repeat at every turn, in the hold and at rest."""
    coarse = step * np.round(DEGREES / step)
    assert not any("exactly" in note for note in check_free_oscillation(_record(coarse)).notes)
    smooth = step * np.round(np.convolve(DEGREES, np.ones(5) / 5.0, mode="same")[2:-2] / step)
    assert not any("exactly" in note for note in check_free_oscillation(_record(smooth)).notes)


def test_a_joystick_that_sticks_is_not_frozen() -> None:
    stuck = DEGREES.copy()
    stuck[300:] = stuck[300]
    assert not any("exactly" in note for note in check_free_oscillation(_record(stuck)).notes)


@pytest.mark.parametrize("passages", [[0.3, 0.28, 0.4], [0.19, 0.3], [0.3, 0.3, 0.4]])
def test_passages_out_of_order_determine_no_spline(passages: list[float]) -> None:
    """SciPy refuses their knots with an error of its own."""
    record = _record(DEGREES)
    assert fit_spline(record.time, record.theta, np.array(passages)) is None
