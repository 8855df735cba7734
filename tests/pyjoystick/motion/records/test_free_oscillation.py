from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import Record, RecordError, check_free_oscillation, read_record
from pyjoystick.support import FloatArray
from tests.pyjoystick.motion.records.made import HOLD, RATE, motion, written


def _record(theta: FloatArray | None = None, time: FloatArray | None = None) -> Record:
    instants, degrees, _ = motion()
    return Record("made", instants if time is None else time, np.radians(degrees if theta is None else theta))


def _refusal(record: Record, **options: str) -> RecordError:
    with pytest.raises(RecordError) as caught:
        check_free_oscillation(record, **options)  # type: ignore[arg-type]
    assert caught.value.source == record.source
    assert caught.value.advice
    return caught.value


def _without(record: Record, *samples: int) -> Record:
    kept = np.setdiff1d(np.arange(len(record)), samples)
    return dataclasses.replace(
        record, time=record.time[kept], theta=record.theta[kept], rows=record.rows[kept]
    )


def test_a_clean_release_has_no_notes() -> None:
    record = _record()
    checked = check_free_oscillation(record, released="backward")
    assert checked.notes == ()
    assert checked.theta == pytest.approx(record.theta)


def test_noise_alone_raises_no_note() -> None:
    noise = np.random.default_rng(5)
    for _ in range(20):
        noisy = motion()[1] + noise.normal(0.0, 0.1, len(motion()[1]))
        assert all(note.startswith("coarse") for note in check_free_oscillation(_record(noisy)).notes)


@pytest.mark.parametrize(
    "theta",
    [np.zeros(105), np.full(105, 3.0), np.linspace(-20.0, 0.0, 105), np.linspace(-20.0, 20.0, 105)[:55]],
    ids=["nothing", "held", "pushed back", "pushed over"],
)
def test_no_free_oscillation_is_refused(theta: FloatArray) -> None:
    record = _record(theta, np.arange(len(theta)) / RATE)
    error = _refusal(record)
    assert "no free oscillation" in error.reason
    assert error.rows == (0, len(theta) - 1)


def test_too_few_peaks_are_refused() -> None:
    end = HOLD + 23  # after the third peak
    error = _refusal(_record(motion()[1][:end], motion()[0][:end]))
    assert "too few peaks" in error.reason
    assert error.value == 3
    assert len(error.rows) == 3


def test_fewer_peaks_than_eq_12_judges_are_flagged() -> None:
    end = HOLD + 38  # before the seventh swing
    notes = check_free_oscillation(_record(motion()[1][:end], motion()[0][:end])).notes
    assert notes[0].startswith("few peaks: 6 stand out after the release; eq. (12) judges 9")


def test_a_second_release_is_refused_with_its_row(tmp_path: Path) -> None:
    def twice(time: FloatArray, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
        return np.arange(2 * len(time)) / RATE, np.concatenate((theta, theta * 1.01))

    with pytest.raises(RecordError, match="a second release") as caught:
        read_record(written(tmp_path, twice))
    line_of_second = len(motion()[0]) + 2
    assert line_of_second <= caught.value.rows[0] < line_of_second + HOLD + 1
    assert "one release" in caught.value.advice


def test_driven_motion_is_refused() -> None:
    theta = -20.0 * np.cos(2.0 * math.pi * 2.0 * motion()[0])
    error = _refusal(_record(theta))
    assert "does not decay" in error.reason


def test_the_wrong_side_of_release_is_refused_where_it_is_known() -> None:
    mirrored = _record(-motion()[1])
    assert check_free_oscillation(mirrored).notes == ()
    error = _refusal(mirrored, released="backward")
    assert "released forward instead of backward: wrong sign?" in error.reason
    assert error.value == "+20.00 degrees"


def test_a_short_gap_is_flagged() -> None:
    notes = check_free_oscillation(_without(_record(), HOLD + 10, HOLD + 11)).notes
    assert notes == (f"gaps: about 2 samples are missing between rows {HOLD + 9}, {HOLD + 12}",)


def test_a_gap_that_may_hide_a_peak_is_refused() -> None:
    error = _refusal(_without(_record(), *range(HOLD + 8, HOLD + 15)))
    assert "a gap of 0.1333 s in which a peak may hide" in error.reason
    assert error.rows == (HOLD + 7, HOLD + 15)


def test_a_gap_is_noted_where_no_peaks_are_counted() -> None:
    record = _without(_record(), *range(HOLD + 8, HOLD + 15))
    [note] = check_free_oscillation(record, counted=False).notes
    assert note == f"gaps: about 7 samples are missing between rows {HOLD + 7}, {HOLD + 15}"


def test_a_swing_that_a_gap_cuts_off_is_no_measure_of_the_next() -> None:
    """All of the second swing but its feet is lost, so that the fourth seems to go further."""
    record = _without(_record(), *range(HOLD + 12, HOLD + 17))
    assert check_free_oscillation(record, counted=False).notes[0].startswith("gaps: about 5 samples")
    assert "a peak may hide" in _refusal(record).reason


def test_a_second_release_is_seen_though_every_swing_lacks_a_sample() -> None:
    theta = np.concatenate((motion()[1], motion()[1]))
    record = _record(theta, np.arange(len(theta)) / RATE)
    error = _refusal(_without(record, *range(HOLD + 3, len(theta), 6)))
    assert "a second release" in error.reason


def test_a_gap_that_hides_a_whole_period_is_refused() -> None:
    """The two swings that are left beside it then look like one long one."""
    error = _refusal(_without(_record(), *range(HOLD + 12, HOLD + 26)))
    assert "a peak may hide" in error.reason


def test_gaps_in_the_hold_and_in_the_rest_are_flagged_only() -> None:
    quiet = np.concatenate((motion()[1], np.zeros(40)))
    record = _record(quiet, np.arange(len(quiet)) / RATE)
    notes = check_free_oscillation(_without(record, *range(2, 11), *range(110, 130))).notes
    assert notes == ("gaps: about 29 samples are missing between rows 1, 11, 109, 130",)


def test_uneven_times_are_flagged() -> None:
    rounded = np.round(motion()[0], 3)
    notes = check_free_oscillation(_record(time=rounded)).notes
    assert notes[0].startswith("uneven times: steps from 0.016 to 0.017 s; if the times are rounded")


def test_swings_of_few_samples_are_flagged() -> None:
    slow = slice(None, None, 3)
    notes = check_free_oscillation(_record(motion()[1][slow], motion()[0][slow])).notes
    assert any(note.startswith("coarse sampling") for note in notes)


def test_an_angle_beyond_the_stops_is_flagged() -> None:
    notes = check_free_oscillation(_record(2.0 * motion()[1])).notes
    assert notes == (
        "the angle goes to 40.0 degrees (row 0), far beyond a joystick's stops at about 20 degrees: "
        "is its unit right?",
    )


def test_a_rest_away_from_zero_is_flagged() -> None:
    quiet = np.concatenate((motion()[1], np.zeros(20))) + 0.5
    notes = check_free_oscillation(_record(quiet, np.arange(len(quiet)) / RATE)).notes
    assert "at rest at +0.500 degrees (rows 113-124)" in notes[-1]


@pytest.mark.parametrize("stop", np.linspace(0.9, 1.5, 13))
def test_a_record_that_ends_in_a_swing_is_not_at_rest(stop: float) -> None:
    """At 500 Hz, ten samples about a turning point differ by less than noise does."""
    time = np.arange(0.0, stop, 2e-3)
    noise = np.random.default_rng(1).normal(0.0, np.radians(0.03), len(time))
    theta = simulate(NOMINAL, time=time, theta_start=np.radians(-10.0)).theta + noise
    assert check_free_oscillation(Record("made", time, theta)).notes == ()


@pytest.mark.parametrize(("factor", "advice"), [(-1.0, "turn the sign"), (0.0, "leave the column out")])
def test_nor_is_one_of_a_motion_as_small_as_noise(factor: float, advice: str) -> None:
    """Of half a degree: such a record alone may be noise, a free oscillation is not."""
    time, theta, omega = motion()
    small = Record("made", time, 0.025 * np.radians(theta), 0.025 * factor * omega)
    with pytest.raises(RecordError, match=advice):
        check_free_oscillation(small)


@pytest.mark.parametrize(
    ("factor", "advice"),
    [
        (-1.0, "turn the sign"),
        (math.degrees(1.0), r"omega \(deg/s\)"),
        (math.radians(1.0), r"omega \(rad/s\)"),
        (3.0, "leave the column out"),
    ],
)
def test_a_velocity_that_is_not_that_of_the_angle_is_refused(factor: float, advice: str) -> None:
    time, theta, omega = motion()
    good = Record("made", time, np.radians(theta), omega)
    assert check_free_oscillation(good).notes == ()
    with pytest.raises(RecordError, match=advice) as caught:
        dataclasses.replace(good, omega=factor * omega)
    assert caught.value.column == "omega"


def test_a_velocity_that_is_somewhat_off_is_flagged() -> None:
    time, theta, omega = motion()
    notes = check_free_oscillation(Record("made", time, np.radians(theta), 1.25 * omega)).notes
    assert len(notes) == 1
    assert "times as fast as the measured velocity" in notes[0]


@pytest.mark.parametrize(
    ("lost", "is_noted"), [(0, False), (HOLD, False), (HOLD + 1, False), (HOLD + 4, True)]
)
def test_a_record_that_begins_after_the_release_is_noted(lost: int, is_noted: bool) -> None:
    checked = check_free_oscillation(_record().between(lost / RATE - 1e-9))
    assert any("moves at the first sample" in note for note in checked.notes) is is_noted
