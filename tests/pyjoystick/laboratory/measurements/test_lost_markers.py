"""Lost markers, which files report at 0, 0, 0."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import measure_angle, read_markers
from tests.pyjoystick.laboratory.measurements.c3d_writer import write_c3d
from tests.pyjoystick.laboratory.measurements.made import NAMES, nexus_text, plain_text, swing, write

TIME = np.arange(180) / 60.0
LOST = slice(50, 57)


def _points(origin: tuple[float, float, float]) -> np.ndarray:
    """A joystick (mm) of 280 mm on a pivot at `origin`, whose top is lost in seven frames."""
    theta = swing(TIME)
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.stack((top, *base), axis=1) + np.array(origin)
    points += np.random.default_rng(3).normal(0.0, 0.2, points.shape)
    points[LOST, 0] = 0.0
    return points


@pytest.mark.parametrize("form", ["plain", "nexus", "c3d"])
def test_zeros_count_as_lost_in_every_form_of_file(form: str, tmp_path: Path) -> None:
    points = _points((400.0, 1200.0, 900.0))
    path = tmp_path / ("a.c3d" if form == "c3d" else "a.csv")
    if form == "c3d":
        write_c3d(path, NAMES, points, rate=60.0)
    else:
        write(path, plain_text(TIME, points) if form == "plain" else nexus_text(points))
    markers = read_markers(path)
    assert np.flatnonzero(markers.missing("TOP")).tolist() == list(range(50, 57))
    found = measure_angle(markers, top="TOP", base=["BASE1", "BASE2"], forward="x")
    known = np.isfinite(found.theta)
    assert not known[LOST].any()
    # The noise of 0.2 mm over 280 mm is 0.04 degrees; the zeros made an angle of 80 degrees.
    np.testing.assert_allclose(np.degrees((found.theta - swing(TIME))[known]), 0.0, atol=0.3)
    [note] = [note for note in found.notes if "0, 0, 0" in note]
    first = markers.rows[50]
    assert "TOP counts as lost in 7 frames" in note
    assert f"rows {first}-{first + 6}" in note


def test_zeros_on_the_path_of_a_marker_are_positions(tmp_path: Path) -> None:
    """A top at rest at the origin, its coordinates rounded to a millimeter."""
    points = _points((0.0, 0.0, -280.0))
    points[LOST, 0] = points[57, 0]
    points = np.round(points)
    assert (points[:, 0] == 0.0).all(axis=1).sum() > 20
    markers = read_markers(write(tmp_path / "a.csv", plain_text(TIME, points)))
    assert not markers.missing("TOP").any()
    assert markers.notes == ()


def test_a_marker_that_is_nowhere_else_is_noted(tmp_path: Path) -> None:
    points = _points((400.0, 1200.0, 900.0))
    points[LOST, 0] = points[57, 0]
    points[:, 1] = 0.0
    markers = read_markers(write(tmp_path / "a.csv", plain_text(TIME, points)))
    assert markers.notes == (
        "marker BASE1 is at 0, 0, 0 wherever it is seen: was it lost in every frame?",
        "marker TOP is at exactly the same place in 8 frames (rows 52-59): was it lost there?",
    )


@pytest.mark.parametrize("digits", [1, 6])
def test_markers_at_rest_are_not_lost(digits: int, tmp_path: Path) -> None:
    """Constant base markers that are not seen at first and at last, and a rest between two motions."""
    theta = 0.2 * np.cos(np.pi * np.clip(TIME, 0.0, 1.0)) + 0.1 * np.cos(np.pi * np.clip(TIME, 2.0, 3.0))
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.round(np.stack((top, *base), axis=1) + 400.0, digits)
    points[[0, -1], 1:] = np.nan
    assert read_markers(write(tmp_path / "a.csv", plain_text(TIME, points))).notes == ()


@pytest.mark.parametrize("first", [22, 37, 80, 105])
@pytest.mark.parametrize("count", [3, 20])
def test_a_recording_that_freezes_is_noted(first: int, count: int, tmp_path: Path) -> None:
    """In a motion and at its turns."""
    theta = 0.3 * np.sin(2.0 * np.pi * TIME)
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.stack((top, *base), axis=1) + 400.0
    points += np.random.default_rng(3).normal(0.0, 0.2, points.shape)
    points[first : first + count] = points[first]
    [note] = read_markers(write(tmp_path / "a.csv", plain_text(TIME, points))).notes
    place = f"in {count} frames (rows {first + 2}-{first + count + 1})"
    assert note == f"all markers are at exactly the same place {place}: did the recording freeze?"


@pytest.mark.parametrize("frozen", ["TOP", "BASE2", "all"])
@pytest.mark.parametrize("place", ["start", "end", "before a loss"])
def test_a_freeze_at_an_end_or_beside_lost_frames_is_noted(frozen: str, place: str, tmp_path: Path) -> None:
    points = _points((400.0, 1200.0, 900.0))
    points[LOST, 0] = points[49, 0]
    part = {"start": slice(0, 60), "end": slice(120, 180), "before a loss": slice(100, 120)}[place]
    which = slice(None) if frozen == "all" else NAMES.index(frozen)
    points[LOST, 0] += np.random.default_rng(5).normal(0.0, 0.2, (7, 3))
    points[part, which] = points[part.start, which]
    if place == "before a loss":
        points[120:125, which] = np.nan
    (note,) = read_markers(write(tmp_path / "a.csv", plain_text(TIME, points))).notes
    who = "all markers are" if frozen == "all" else f"marker {frozen} is"
    count = part.stop - part.start
    assert note.startswith(f"{who} at exactly the same place in {count} frames (rows {part.start + 2}-")


@pytest.mark.parametrize("step", [0.1, 1.0])
@pytest.mark.parametrize("seed", range(5))
def test_coarse_coordinates_repeat_by_chance(step: float, seed: int, tmp_path: Path) -> None:
    """Two strokes with a rest between them; noise of a fifth of the rounding."""
    time = np.arange(480) / 120.0
    theta = 0.3 * np.cos(np.pi * (np.clip(time, 0.0, 1.0) + np.clip(time, 3.0, 4.0)))
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.stack((top, *base), axis=1) + 400.0
    points += np.random.default_rng(seed).normal(0.0, 0.2 * step, points.shape)
    text = plain_text(time, np.round(points / step) * step)
    assert read_markers(write(tmp_path / "a.csv", text)).notes == ()


def test_a_marker_that_was_measured_once_is_not_lost(tmp_path: Path) -> None:
    """A base marker in one place, and after a correction in another one, beside a trembling one."""
    points = _points((400.0, 1200.0, 900.0))
    points[LOST, 0] = np.nan
    points[:90, 1], points[90:, 1] = points[0, 1], points[90, 1]
    assert read_markers(write(tmp_path / "a.csv", plain_text(TIME, points))).notes == ()
