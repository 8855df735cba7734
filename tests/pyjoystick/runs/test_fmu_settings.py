"""Values with and without a unit."""

from __future__ import annotations

import math

import pytest

from pyjoystick.fmu import Variable
from pyjoystick.motion import DisplayUnit
from pyjoystick.runs import difference_of, number_of, value_of
from pyjoystick.support import ParameterError


def _variable(kind: str = "Real", unit: str = "rad", display: DisplayUnit | None = None) -> Variable:
    return Variable(
        name="p",
        type=kind,
        causality="parameter",
        variability="fixed",
        initial="exact",
        value_reference=1,
        description="",
        unit=unit,
        display_unit=display,
        start="0",
        minimum=-1.5 if kind == "Real" else None,
        maximum=None,
    )


ANGLE = _variable(display=DisplayUnit("deg", math.degrees(1.0)))
TEMPERATURE = _variable(unit="K", display=DisplayUnit("degC", 1.0, -273.15))


@pytest.mark.parametrize(
    ("given", "value"),
    [
        (-0.25, -0.25),
        (1, 1.0),
        ("-0.25 rad", -0.25),
        ("-20deg", math.radians(-20.0)),
        (" +9e1 deg ", math.radians(90.0)),
        (".5rad", 0.5),
    ],
)
def test_numbers_and_units(given: object, value: float) -> None:
    assert number_of(ANGLE, given) == pytest.approx(value, rel=1e-15)


def test_an_offset_holds_for_values_and_not_for_differences() -> None:
    assert number_of(TEMPERATURE, "20degC") == pytest.approx(293.15, rel=1e-15)
    assert difference_of(TEMPERATURE, "20degC") == 20.0


@pytest.mark.parametrize(
    ("variable", "given", "allowed"),
    [
        (ANGLE, "steep", "a number in rad, or text with the unit rad or deg"),
        (ANGLE, "20", "a number in rad, or text with the unit rad or deg"),
        (ANGLE, "20grad", "a number in rad, or text with the unit rad or deg"),
        (ANGLE, "-2rad", "a finite number, -1.5 rad or more"),
        (ANGLE, True, "a finite number, -1.5 rad or more"),
        (ANGLE, math.nan, "a finite number, -1.5 rad or more"),
        (_variable(unit=""), "1 m", "a number: the FMU gives no unit"),
        (_variable("Integer", ""), 1.5, "an integer"),
        (_variable("Boolean", ""), 1, "True or False"),
    ],
)
def test_other_values_are_refused(variable: Variable, given: object, allowed: str) -> None:
    with pytest.raises(ParameterError) as refused:
        value_of(variable, given)
    assert refused.value.allowed == allowed


def test_text_is_the_value_of_a_text_variable() -> None:
    assert value_of(_variable("String", ""), "20deg") == "20deg"


@pytest.mark.parametrize("given", [0.0, -1.0, "0deg", True, math.inf, None])
def test_a_difference_is_above_zero(given: object) -> None:
    with pytest.raises(ParameterError, match="above 0 rad"):
        difference_of(ANGLE, given)
