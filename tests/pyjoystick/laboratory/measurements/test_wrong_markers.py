"""Markers that are somewhere else for some frames: refused if no joystick moves so fast, otherwise noted."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from pyjoystick.laboratory import BASE, TOP, measure_angle, synthetic_markers
from pyjoystick.laboratory.measurements.angle import AngleMeasurement
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import RecordError, glitch_notes, require_no_glitch
from tests.pyjoystick.laboratory.measurements.made import swing

RATE = 120.0
TIME = np.arange(360) / RATE


def _measured(theta: np.ndarray, moved: dict[int, float], **options: float) -> AngleMeasurement:
    """Measure an angle (rad) from markers of which the top is moved forward (m) in some frames."""
    markers = synthetic_markers(TIME, theta, random=np.random.default_rng(4), noise=2e-4)
    positions = markers.positions.copy()
    for frame, shift in moved.items():
        positions[frame, markers.index(TOP), 0] += shift
    markers = dataclasses.replace(markers, positions=positions)
    return measure_angle(markers, top=TOP, base=BASE, forward="x", up="z", rest=(2.5, 3.0), **options)


@pytest.mark.parametrize("frames", [[157], [100], [40, 41, 42]])
@pytest.mark.parametrize("shift", [-0.26, 0.15])
def test_a_marker_that_is_far_off_is_refused(frames: list[int], shift: float) -> None:
    where = f"rows {frames[0] - 1}-{frames[0]}"
    with pytest.raises(RecordError, match=rf"{where}: the angle jumps by \d+.* its label swapped"):
        _measured(swing(TIME), dict.fromkeys(frames, shift), radius=0.266)


@pytest.mark.parametrize("frame", [60, 157, 250])
@pytest.mark.parametrize("shift", [0.02, -0.03])
def test_a_marker_that_is_a_little_off_is_noted(frame: int, shift: float) -> None:
    notes = _measured(swing(TIME), {frame: shift}).notes
    assert any(note.startswith("the angle leaves the motion by up to") for note in notes)
    assert any(f"row {frame})" in note for note in notes)


@pytest.mark.parametrize("frame", [0, 1, 2, 3, 356, 357, 358, 359])
@pytest.mark.parametrize("shift", [0.02, -0.05])
def test_a_marker_that_is_off_at_first_or_in_the_end(frame: int, shift: float) -> None:
    notes = _measured(swing(TIME), {frame: shift}).notes
    rows = {max(1, min(frame, len(TIME) - 2)), frame}
    assert any("the angle leaves the motion" in note and str(row) in note for note in notes for row in rows)


@pytest.mark.parametrize("degrees", [2.0, 5.0, -18.0, 22.0])
def test_the_motion_of_a_joystick_is_no_glitch(degrees: float) -> None:
    """The paper's joystick, which its springs stop with kinks, and the clearance between them."""
    motion = simulate(NOMINAL, time=TIME, theta_start=np.radians(degrees))
    assert not [
        note for note in _measured(motion.theta, {}, radius=0.266).notes if "leaves the motion" in note
    ]


@pytest.mark.parametrize("rate", [240.0, 500.0, 1000.0])
@pytest.mark.parametrize("held", [0, 100])
def test_a_light_joystick_is_fast_everywhere(rate: float, held: int) -> None:
    time = np.arange(480) / rate
    theta = np.radians(20.0) * np.exp(-time) * np.cos(2.0 * np.pi * 18.0 * time)
    theta = np.append(np.full(held, theta[0]), theta)
    time = np.arange(len(theta)) / rate
    assert np.abs(np.diff(theta)).max() > 30.0 / rate
    require_no_glitch("made", time, theta, np.arange(len(theta)), "why?", "do")
    assert not list(glitch_notes(time, theta, np.arange(len(theta)), "why?"))


def test_an_arc_without_a_radius_confirms_none() -> None:
    small = swing(TIME) / 20.0
    assert any(
        "the arc does not confirm the radius" in note for note in _measured(small, {}, radius=0.266).notes
    )
