"""Motions from files, and the signal chain applied to a known motion."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.forced_motion import ForwardAndReturn, Samples, measure, read_motion, torque_by_reference
from pyjoystick.forced_motion.measured import seen_by_cameras
from pyjoystick.laboratory import Chain, LowPass, write_motion
from pyjoystick.model import NOMINAL
from pyjoystick.motion import RecordError
from pyjoystick.support import SeriesError

MOTION = ForwardAndReturn(amplitude=0.25, rise=0.3, dwell=0.1, rest=0.3)
FRAMES = np.arange(79) / 60.0


def _csv(path: Path, heading: str, columns: tuple[np.ndarray, ...]) -> Path:
    rows = [",".join(f"{value:.15g}" for value in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join((heading, *rows)) + "\n")
    return path


def test_the_three_columns_are_taken_as_they_stand(tmp_path: Path) -> None:
    at = MOTION.at(FRAMES)
    degrees = (FRAMES, *(np.degrees(one) for one in (at.theta, at.omega, at.alpha)))
    path = _csv(tmp_path / "m.csv", "time (s),theta (deg),omega (deg/s),alpha (deg/s2)", degrees)
    found = read_motion(path)
    assert not found.differentiated
    for name in ("theta", "omega", "alpha"):
        np.testing.assert_allclose(getattr(found.samples, name), getattr(at, name), rtol=1e-13, atol=1e-13)


def test_an_angle_alone_goes_through_the_chain(tmp_path: Path) -> None:
    """A chain that lets everything pass returns the motion, the paper's a smoother one."""
    path = _csv(tmp_path / "a.csv", "t [s],Angle [rad]", (FRAMES, MOTION.at(FRAMES).theta))
    columns = {"time": "t", "theta": "Angle"}
    open_chain = Chain(low_pass=LowPass(cutoff=200.0))
    found = read_motion(path, columns=columns, chain=open_chain)
    assert found.differentiated
    exact = MOTION.at(found.samples.time)
    assert np.abs(found.samples.theta - exact.theta).max() < 1e-4
    error = np.abs(found.samples.omega - exact.omega).max()
    assert error < 0.02
    papers = read_motion(path, columns=columns).samples
    assert 2.0 * error < np.abs(papers.omega - exact.omega).max() < 0.1


def test_what_import_markers_writes_can_be_read(tmp_path: Path) -> None:
    motion = Chain().run(FRAMES, MOTION.at(FRAMES).theta)
    write_motion(motion, tmp_path / "motion.csv", ["synthetic"])
    found = read_motion(tmp_path / "motion.csv")
    assert not found.differentiated
    np.testing.assert_allclose(found.samples.alpha, motion.alpha, rtol=1e-9, atol=1e-9)


def test_a_synthetic_measurement_is_near_the_motion() -> None:
    samples = seen_by_cameras(MOTION, random=np.random.default_rng(3))
    exact = MOTION.at(samples.time)
    assert np.abs(samples.theta - exact.theta).max() < math.radians(0.5)
    assert 0.0 < np.abs(samples.omega - exact.omega).max() < 0.2
    found = measure(NOMINAL, samples, torque_by_reference(NOMINAL, samples))
    true = Samples.of(NOMINAL, MOTION)
    expected = measure(NOMINAL, true, torque_by_reference(NOMINAL, true))
    assert found.positive_work == pytest.approx(expected.positive_work, rel=0.05)
    assert found.total.peak == pytest.approx(expected.total.peak, rel=0.1)


@pytest.mark.parametrize(
    "heading", ["time (s),theta (rad)", "time (s),theta (rad),omega (rad/s),alpha (rad/s2)"]
)
def test_gaps_are_refused(tmp_path: Path, heading: str) -> None:
    at = MOTION.at(FRAMES)
    kept = np.delete(np.arange(len(FRAMES)), np.arange(30, 40))
    columns = [one[kept] for one in (FRAMES, at.theta, at.omega, at.alpha)][: heading.count(",") + 1]
    path = _csv(tmp_path / "gap.csv", heading, tuple(columns))
    with pytest.raises(RecordError, match=r"rows 31-32: a gap of 0\.1833 s.*the torque in it is not known"):
        read_motion(path)


def test_bad_files(tmp_path: Path) -> None:
    at = MOTION.at(FRAMES)
    three = (FRAMES, at.theta, at.alpha)
    path = _csv(tmp_path / "unit.csv", "time (s),theta (rad),alpha (g)", three)
    with pytest.raises(RecordError, match=r"column 'alpha \(g\)', row 1: has an unknown unit .* deg/s2"):
        read_motion(path)
    path = _csv(tmp_path / "two.csv", "time (s),theta (rad)", (FRAMES, at.theta))
    with pytest.raises(RecordError, match="has no column 'acceleration'"):
        read_motion(path, columns={"alpha": "acceleration"})
    with pytest.raises(RecordError, match="cannot be read"):
        read_motion(tmp_path / "nowhere.csv")
    short = _csv(tmp_path / "short.csv", "time (s),theta (rad)", (FRAMES[:3], at.theta[20:23]))
    with pytest.raises(SeriesError, match="at least 4 are needed"):
        read_motion(short)
    nothing = _csv(tmp_path / "zero.csv", "time (s),theta (rad)", (FRAMES, 0.0 * at.theta))
    with pytest.raises(RecordError, match="column 'theta': is zero throughout"):
        read_motion(nothing)


@pytest.mark.parametrize("factor", [-1.0, 10.0, 0.0])
def test_an_acceleration_that_is_not_that_of_the_velocity_is_refused(factor: float, tmp_path: Path) -> None:
    at = MOTION.at(FRAMES)
    columns = (FRAMES, at.theta, at.omega, factor * at.alpha)
    path = _csv(tmp_path / "m.csv", "time (s),theta (rad),omega (rad/s),alpha (rad/s2)", columns)
    with pytest.raises(RecordError, match=r"column 'alpha', rows 2, 80: is not the rate of omega"):
        read_motion(path)


def test_an_acceleration_that_is_late_or_wrong_for_a_moment_is_noted(tmp_path: Path) -> None:
    at = MOTION.at(FRAMES)

    def notes(alpha: np.ndarray) -> tuple[str, ...]:
        path = _csv(
            tmp_path / "m.csv",
            "time (s),theta (rad),omega (rad/s),alpha (rad/s2)",
            (FRAMES, at.theta, at.omega, alpha),
        )
        return read_motion(path).notes

    before = notes(at.alpha)
    (late,) = set(notes(np.roll(at.alpha, 2))) - set(before)
    assert late == "alpha lags omega by 33.3 ms: was it filtered differently?"
    wrong = at.alpha.copy()
    wrong[30] = 10.0 * np.abs(wrong).max()
    assert any(note.startswith("alpha is") and "row 32" in note for note in notes(wrong))
