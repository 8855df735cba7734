"""The hysteresis of load-deflection curves, caused by the testing machine or the joystick."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.laboratory import MeasuredValues
from pyjoystick.model import read_parameter_file
from pyjoystick.reports import new_project, run_project
from pyjoystick.reports.project.hysteresis import one_friction

CURVES = """
[load_curve.forward]
file = "data/synthetic_forward.csv"
friction = {forward}
[load_curve.backward]
file = "data/synthetic_backward.csv"
friction = {backward}
[fmus]
fmi = []
"""
#: Of the synthetic testing machine (N).
TRUTH = 0.3


def _curves_alone(folder: Path, forward: str, backward: str) -> tuple[str, ...]:
    """Run the load curves of the example; the notes on them."""
    new_project(folder, example=True)
    text = CURVES.format(forward=forward, backward=backward)
    (folder / "laboratory.toml").write_text(text, encoding="utf-8")
    steps = {one.name: one for one in run_project(folder, find=Path).steps}
    return (*steps["load curve forward"].notes, *steps["load curve backward"].notes)


def test_half_the_hysteresis_of_both_curves_is_the_friction_of_the_plungers(tmp_path: Path) -> None:
    notes = _curves_alone(tmp_path, "true", "true")
    assert not any("testing machine" in note for note in notes)
    found = read_parameter_file(tmp_path / "results" / "measured.toml")
    error = found.uncertainties["friction.F_c"]
    # Either curve knows it to 0.0009 N (docs/parameters-from-measurements.md), both to 0.0006 N.
    assert 0.0004 < error < 0.001
    assert abs(found.joystick.friction.F_c - TRUTH) < 4.0 * error
    assert "hysteresis of synthetic_forward.csv and of synthetic_backward.csv" in found.sources["friction"]


def test_without_a_word_of_it_the_hysteresis_is_noted_and_left_to_the_machine(tmp_path: Path) -> None:
    notes = _curves_alone(tmp_path, "true", "false")
    [note] = [one for one in notes if "hysteresis" in one]
    assert "is attributed to friction in the testing machine" in note
    assert "friction = true in [load_curve.backward]" in note


def _measured(value: float, error: float) -> MeasuredValues:
    return MeasuredValues(values={"friction.F_c": value}, uncertainties={"friction.F_c": error}, sources={})


def test_two_values_are_weighted_and_their_difference_is_an_error() -> None:
    alike = one_friction([_measured(0.30, 0.01), _measured(0.31, 0.02)])
    assert alike.values["friction.F_c"] == pytest.approx(0.302, abs=1e-4)
    assert alike.uncertainties["friction.F_c"] == pytest.approx(5**-0.5 * 0.02)
    # Of equal errors, half the difference.
    apart = one_friction([_measured(0.2, 0.01), _measured(0.4, 0.01)])
    assert apart.values["friction.F_c"] == pytest.approx(0.3)
    assert apart.uncertainties["friction.F_c"] == pytest.approx(0.1)
    assert not one_friction([]).values
