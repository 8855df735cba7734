"""Inputs that an FMI 3 FMU asks for within its steps."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from pyjoystick.fmu import read_description
from pyjoystick.fmu.drive import Drive, IntermediateUpdate, inputs_asked_for
from pyjoystick.fmu.inputs import InputSeries
from pyjoystick.fmu.stepping.program import POINT
from tests.pyjoystick.fmu.doctored import doctored

POINTS = np.array([0.0, 0.5, 1.0])
#: 0 until 0.5 s, where it jumps to 1; then it rises to 2.
VALUES, SLOPES = np.array([0.0, 1.0, 2.0]), np.array([0.0, 2.0])


@pytest.mark.parametrize(
    ("point", "time", "value"),
    [(0, 0.0, 0.0), (0, 0.3, 0.0), (0, 0.5, 0.0), (1, 0.5, 1.0), (1, 0.7, 1.4), (1, 1.0, 2.0)],
)
def test_both_sides_of_a_jump(joystick_fmus3: Path, point: int, time: float, value: float) -> None:
    """A step that ends at the jump has the value before it, one that begins there the value after it."""
    variable = read_description(joystick_fmus3 / "Joystick.fmu").variables["T"]
    found: list[float] = []
    update = IntermediateUpdate(SimpleNamespace(setFloat64=lambda _, values: found.extend(values)))
    update.drive = Drive(POINTS, [InputSeries(variable, VALUES, SLOPES)])
    update.place[POINT] = point
    update.answer(None, time, True, False, False, False, None, None)
    assert update.failure is None
    assert found == pytest.approx([value])


def test_only_inputs_that_may_be_set_within_steps(joystick_fmus3: Path, tmp_path: Path) -> None:
    path = joystick_fmus3 / "Joystick.fmu"
    assert [one.name for one in inputs_asked_for(read_description(path))] == ["T"]
    other = doctored(
        path,
        tmp_path / "held.fmu",
        description=lambda text: re.sub(r'(name="T" [^>]*?) intermediateUpdate="true"', r"\1", text),
    )
    assert inputs_asked_for(read_description(other)) == []
