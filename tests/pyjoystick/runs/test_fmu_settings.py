"""Values with and without a unit."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import pytest

from pyjoystick.fmu import FmuDescription, Variable
from pyjoystick.motion import DisplayUnit
from pyjoystick.runs import amount_for, difference_of, number_of, value_of
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


def _fmus(*variables: Variable) -> list[FmuDescription]:
    found = [SimpleNamespace(variables={variable.name: variable}) for variable in variables]
    return cast("list[FmuDescription]", found)


def _named(name: str, unit: str, display: DisplayUnit | None = None) -> Variable:
    return replace(_variable(unit=unit, display=display), name=name)


@pytest.mark.parametrize(
    ("variable", "text", "value"),
    [
        (_named("a", "m"), "24.1mm", 0.0241),
        (_named("a", "mm"), "2mm", 2.0),
        (_named("a", "mm"), "2.4 cm", 24.0),
        (_named("J", "min"), "30s", 0.5),
        (_named("J", "kg*m^2"), "120kg.cm2", 0.012),
        (_named("stops.K", "N.m/rad"), "5N.m/rad", 5.0),
        (_named("g", "m/s2"), "1g", 9.80665),
        (_named("weight", "g"), "3g", 3.0),
        (_named("p", "rad"), "90deg", math.radians(90.0)),
        (_named("flow", "m3/s", DisplayUnit("l/h", 3.6e6)), "36l/h", 1e-5),
    ],
)
def test_the_declared_unit_decides(variable: Variable, text: str, value: float) -> None:
    assert amount_for(variable.name, text, _fmus(variable, variable)) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("variable", "text", "allowed"),
    [
        (_named("a", ""), "2mm", "a number without a unit"),
        (_named("a", "1"), "2mm", "a number without a unit"),
        (_named("a", "K", DisplayUnit("degC", 1.0, -273.15)), "2degC", "a number, or one with a unit: K"),
        (_named("J", "min"), "0.5kg.m2", "a number, or one with a unit: s, ms, us, min, h"),
        (_named("weight", "g"), "3m/s2", "a number, or one with a unit: g"),
    ],
)
def test_units_that_the_declared_one_does_not_allow(variable: Variable, text: str, allowed: str) -> None:
    with pytest.raises(ParameterError) as refused:
        amount_for(variable.name, text, _fmus(variable))
    assert refused.value.allowed == allowed


def test_two_fmus_with_different_units_take_none() -> None:
    with pytest.raises(ParameterError, match=r"without a unit .*the FMUs declare different ones: m and mm"):
        amount_for("a", "2mm", _fmus(_named("a", "m"), _named("a", "mm")))
    with pytest.raises(ParameterError, match="without a unit"):
        amount_for("a", "2mm", _fmus(_named("b", "m")))


def test_text_is_the_value_of_a_text_variable() -> None:
    assert value_of(_variable("String", ""), "20deg") == "20deg"


@pytest.mark.parametrize("given", [0.0, -1.0, "0deg", True, math.inf, None])
def test_a_difference_is_above_zero(given: object) -> None:
    with pytest.raises(ParameterError, match="above 0 rad"):
        difference_of(ANGLE, given)
