"""A motion from its file of markers to a record."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pyjoystick.laboratory import MarkerSetup, read_trial
from tests.pyjoystick.laboratory.measurements.made import plain_text, swing, write

TIME = np.arange(180) / 60.0


def test_rounded_coordinates_that_repeat_are_no_freeze(tmp_path: Path) -> None:
    """At 240 Hz near a turn, coordinates of 0.1 mm repeat; the angle of two of them takes smaller steps."""
    time = np.arange(720) / 240.0
    theta = swing(time)
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.stack((top, *base), axis=1) + np.random.default_rng(8).normal(0.0, 0.02, (720, 3, 3))
    setup = MarkerSetup(top="TOP", base=("BASE1", "BASE2"), released="backward")
    for frozen, decimals in ((0, 1), (10, 1), (10, 3)):
        shown = np.round(points, decimals)
        shown[200 : 200 + frozen] = shown[200]
        trial = read_trial(write(tmp_path / "a.csv", plain_text(time, shown)), setup, name="a")
        notes = [note for note in trial.record.notes if "stays exactly the same" in note]
        assert len(notes) == bool(frozen)
        assert all("for up to 10 samples" in note for note in notes)


def test_a_gap_that_may_hide_a_peak_leaves_a_record_for_the_fit(tmp_path: Path) -> None:
    """The side of the release is checked all the same; whoever counts peaks refuses the record then."""
    theta = swing(TIME)
    top = np.column_stack((280.0 * np.sin(theta), 0.0 * theta, 280.0 * np.cos(theta)))
    base = [np.broadcast_to([0.0, side, -100.0], top.shape) for side in (-50.0, 50.0)]
    points = np.stack((top, *base), axis=1) + np.random.default_rng(8).normal(0.0, 0.2, (len(TIME), 3, 3))
    points[46:61, 0] = np.nan  # 0.27 s, in which two swings of 0.25 s begin and end
    setup = MarkerSetup(top="TOP", base=("BASE1", "BASE2"), released="backward")
    trial = read_trial(write(tmp_path / "a.csv", plain_text(TIME, points)), setup, name="a")
    assert len(trial.record.time) == len(TIME) - 15
    assert any(note.startswith("gaps: about 15 samples are missing") for note in trial.record.notes)
