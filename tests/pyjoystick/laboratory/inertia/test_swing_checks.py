"""Records of a swing test that would give wrong numbers."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from pyjoystick.laboratory import period_of_record
from pyjoystick.motion import Record, RecordError
from pyjoystick.support import FloatArray
from tests.pyjoystick.laboratory.inertia.pendulum import swing

RECORD = swing(1)


def _with(theta: FloatArray) -> Record:
    return dataclasses.replace(RECORD, theta=theta)


@pytest.mark.parametrize("degrees", [12.0, 18.0])
def test_a_clipped_angle_is_refused_with_the_rows_that_are_left(degrees: float) -> None:
    """At 18 of 25 degrees the period still came out, with dry friction that the pendulum does not have."""
    limit = np.radians(degrees)
    record = _with(np.clip(RECORD.theta, -limit, limit))
    with pytest.raises(RecordError, match=rf"stays at its largest value .*found [+-]{degrees:.4g}") as caught:
        period_of_record(record)
    assert max(caught.value.rows) < 600
    start = int(caught.value.advice.split("rows from ")[1].split()[0])
    assert period_of_record(record.between(float(record.time[start]))).decay is not None


def test_coarse_angles_and_samples_taken_twice_are_not_clipped() -> None:
    """An encoder of 0.5 degrees stays for several samples at each turn, and so does a slow sensor."""
    coarse = _with(np.radians(0.5 * np.round(np.degrees(swing(None).theta) / 0.5)))
    expected = period_of_record(RECORD).period.value
    assert period_of_record(coarse).period.value == pytest.approx(expected, rel=1e-3)
    time = np.arange(4 * len(RECORD)) / 240.0
    repeated = Record("repeated", time, np.repeat(RECORD.theta, 4))
    assert period_of_record(repeated).period.value == pytest.approx(expected, rel=1e-3)


def test_a_second_release_is_refused() -> None:
    first, second = RECORD.theta[:600], RECORD.theta[:600]
    with pytest.raises(RecordError, match=r"rows? 6\d\d: the motion grows again.* a second release"):
        period_of_record(_with(np.concatenate((first, second))))


@pytest.mark.parametrize("degrees", [0.0, 0.05])
def test_an_amplitude_that_slowly_grows_is_refused(degrees: float) -> None:
    time = np.arange(0.0, 20.0, 0.01)
    noise = np.radians(degrees) * np.random.default_rng(1).standard_normal(len(time))
    free = np.radians(3.0) * np.cos(7.857 * time)
    steady = Record("steady", time, free + noise)
    assert period_of_record(steady).period.value == pytest.approx(2.0 * np.pi / 7.857, rel=1e-3)
    growing = Record("growing", time, free * (1.0 + time / 60.0) + noise)
    with pytest.raises(RecordError, match=r"the amplitude grows, from 3\..* degrees in the last third"):
        period_of_record(growing)


def test_a_gap_in_which_the_pendulum_turns_is_refused_and_a_short_one_named() -> None:
    kept = np.ones(len(RECORD), dtype=np.bool_)
    kept[300:345] = False
    rows = np.flatnonzero(kept)
    record = Record("gap", RECORD.time[kept], RECORD.theta[kept], rows=rows)
    with pytest.raises(RecordError, match=r"rows 299, 345: a gap of 0\.76.* may have turned"):
        period_of_record(record)
    kept[310:] = True
    record = Record("gap", RECORD.time[kept], RECORD.theta[kept], rows=np.flatnonzero(kept))
    with pytest.raises(RecordError, match=r"rows 299, 310: has \d samples .* 0\.18\d* s are missing; cut"):
        period_of_record(record)


def test_a_gap_between_two_samples_of_a_passage_does_no_harm() -> None:
    kept = np.arange(len(RECORD)) != 400
    record = Record("gap", RECORD.time[kept], RECORD.theta[kept])
    assert period_of_record(record).period.value == pytest.approx(
        period_of_record(RECORD).period.value, rel=1e-4
    )
