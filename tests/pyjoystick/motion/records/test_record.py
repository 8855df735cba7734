from __future__ import annotations

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import Record, RecordError, rows_in_words
from pyjoystick.support import FloatArray

TIME = np.array([0.0, 0.1, 0.2, 0.3, 0.7])
THETA = np.array([0.1, 0.0, -0.1, 0.0, 0.1])


def test_arrays_are_copied_and_kept() -> None:
    time = TIME.copy()
    record = Record("one", time, THETA)
    time[0] = 5.0
    assert record.time[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        record.theta[0] = 1.0
    assert record.rows.tolist() == [0, 1, 2, 3, 4]
    assert len(record) == 5
    assert record.interval == pytest.approx(0.1)


def test_a_part_keeps_its_rows() -> None:
    part = Record("one", TIME, THETA, omega=2.0 * THETA, rows=np.arange(7, 12)).between(0.05, 0.35)
    assert part.time.tolist() == [0.1, 0.2, 0.3]
    assert part.rows.tolist() == [8, 9, 10]
    assert part.omega is not None
    assert part.omega.tolist() == [0.0, -0.2, 0.0]
    with pytest.raises(RecordError, match="has 2 samples"):
        part.between(0.15)


def test_notes_are_added() -> None:
    record = Record("one", TIME, THETA, notes=("first",))
    assert record.with_notes("second").notes == ("first", "second")


@pytest.mark.parametrize(
    ("time", "theta", "column", "rows"),
    [
        (TIME, THETA[:4], "theta", ()),
        (TIME, THETA.reshape(1, 5), "theta", ()),
        (["a"], THETA, "time", ()),
        (TIME, [0.0, 0.1, np.nan, np.inf, 0.0], "theta", (2, 3)),
        ([0.0, np.nan, 0.2, 0.3, 0.7], THETA, "time", (1,)),
        ([0.0, 0.1, 0.1, 0.3, 0.7], THETA, "time", (2,)),
        ([0.0, 0.1, 0.05, 0.3, 0.7], THETA, "time", (2,)),
        (TIME, [0.0, 0.1, 1.58, -1.58, 0.0], "theta", (2, 3)),
        (TIME[:2], THETA[:2], "", ()),
    ],
)
def test_bad_arrays_are_refused(time: object, theta: object, column: str, rows: tuple[int, ...]) -> None:
    with pytest.raises(RecordError) as caught:
        Record("one", time, theta, source="test")  # type: ignore[arg-type]
    assert (caught.value.source, caught.value.column, caught.value.rows) == ("test", column, rows)


def test_rows_in_words() -> None:
    assert rows_in_words([7]) == "row 7"
    assert rows_in_words([9, 3, 4, 5, 5]) == "rows 3-5, 9"
    assert rows_in_words(range(1, 30, 2)) == "rows 1, 3, 5, 7, 9 and 10 more places"


def test_the_angle_ends_where_the_geometry_of_the_cam_does() -> None:
    below = np.nextafter(np.pi / 2.0, 0.0)
    assert Record("one", TIME, [0.0, below, -below, 0.0, 0.0]).theta[1] == below
    for beyond in (np.pi / 2.0, -np.pi / 2.0):
        with pytest.raises(RecordError, match="an angle of 90 degrees or more") as caught:
            Record("one", TIME, [0.0, 0.0, 0.0, beyond, 0.0])
        assert caught.value.rows == (3,)


def test_angles_that_no_instrument_resolves_are_refused() -> None:
    assert not Record("one", TIME, np.zeros(5)).theta.any()
    assert Record("one", TIME, 1e-7 * THETA).theta[0] == 1e-8
    with pytest.raises(RecordError, match="all angles are below 1e-09 rad"):
        Record("one", TIME, 1e-300 * THETA)


def test_times_that_differ_by_less_than_any_clock_are_repeated() -> None:
    for step in (0.0, 1e-320, -1e-320, 1e-13):
        with pytest.raises(RecordError, match="times are repeated") as caught:
            Record("one", [0.0, step, 0.2, 0.3, 0.7], THETA)
        assert caught.value.rows == (1,)


_MOTION = np.linspace(0.0, 1.0, 101)
_ANGLE = 0.2 * np.sin(9.0 * _MOTION)
_RATE = 1.8 * np.cos(9.0 * _MOTION)


@pytest.mark.parametrize(
    ("omega", "ratio", "advice"),
    [
        (np.degrees(_RATE), "0.0175", r"name the column omega \(deg/s\)"),
        (-_RATE, "-1", "turn the sign"),
        (0.0 * _RATE, "inf", "leave the column out"),
        (2.0 * _RATE, "0.5", "leave the column out"),
    ],
    ids=["in degrees", "of the other sign", "missing", "twice"],
)
def test_a_velocity_that_is_not_that_of_the_angle_is_refused(
    omega: FloatArray, ratio: str, advice: str
) -> None:
    message = rf"is not the rate of theta, which changes {ratio}\d* times as fast; {advice}"
    with pytest.raises(RecordError, match=message):
        Record("one", _MOTION, _ANGLE, omega=omega)


def test_a_velocity_with_noise_offset_and_gaps_is_taken() -> None:
    noise = np.random.default_rng(5).normal(0.0, 0.3, len(_MOTION))
    Record("one", _MOTION, _ANGLE, omega=_RATE + noise + 0.4)
    kept = np.abs(_MOTION - 0.4) > 0.1
    Record("one", _MOTION[kept], _ANGLE[kept], omega=_RATE[kept])


def test_at_rest_noise_is_no_contradiction() -> None:
    noise = np.random.default_rng(6).normal(0.0, 1.0, (2, len(_MOTION)))
    Record("one", _MOTION, 0.001 * noise[0], omega=0.05 * noise[1])


@pytest.mark.parametrize("rate", [15.0, 20.0, 24.0, 30.0, 60.0])
@pytest.mark.parametrize("release", [-15.0, -8.0, -4.0])
def test_a_coarse_record_is_no_contradiction_but_degrees_are(rate: float, release: float) -> None:
    """The fastest swings have three to twelve samples."""
    motion = simulate(NOMINAL, time=np.arange(0.0, 2.0, 1.0 / rate), theta_start=np.radians(release))
    Record("one", motion.time, motion.theta, omega=motion.omega)
    with pytest.raises(RecordError, match="is not the rate of theta"):
        Record("one", motion.time, motion.theta, omega=np.degrees(motion.omega))
