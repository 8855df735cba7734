"""Parsing of option values."""

from __future__ import annotations

import math

import pytest
from typer import BadParameter

from pyjoystick.cli.joystick_choice import joystick_of
from pyjoystick.cli.parsing import parse_angle, parse_assignments
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.support import ParameterError, UnknownParameterError


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("-20", -20.0),
        ("-20deg", -20.0),
        (" 15 deg ", 15.0),
        ("+1.5e1deg", 15.0),
        ("0", 0.0),
        ("89.999", 89.999),
        ("-0.35rad", math.degrees(-0.35)),
        (".5 rad", math.degrees(0.5)),
        ("-20°", -20.0),
        ("350 mrad", math.degrees(0.35)),
    ],
)
def test_angles(text: str, degrees: float) -> None:
    assert parse_angle(text) == pytest.approx(math.radians(degrees), rel=1e-15)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("90", "'90' must lie between -90deg and 90deg$"),
        ("-350deg", "must lie between -90deg and 90deg$"),
        ("-20rad", "'-20rad' must lie between -90deg and 90deg; did you mean -20deg?"),
        ("1.5708rad", "did you mean 1.5708deg?"),
        ("", "'' is not an angle; write -20deg or -0.35rad"),
        ("20 grad", "is not an angle"),
        ("nan", "is not an angle"),
        ("inf", "is not an angle"),
        ("1e999", "is not an angle"),
        ("1-2", "is not an angle"),
        ("twenty", "is not an angle"),
    ],
)
def test_angles_that_are_refused(text: str, message: str) -> None:
    with pytest.raises(BadParameter, match=message.replace("?", r"\?")):
        parse_angle(text)


def test_assignments() -> None:
    texts = ["J=0.012", " damping.C = 5e-2 ", "x=nan"]
    values = parse_assignments(texts, "--set")
    assert list(values) == ["J", "damping.C", "x"]
    assert (values["J"], values["damping.C"]) == (0.012, 0.05)
    assert math.isnan(values["x"])  # refused later, where the name is known
    assert parse_assignments([], "--set") == {}


@pytest.mark.parametrize("text", ["J", "J=", "=1", "J=1=2", "J=one", ""])
def test_assignments_that_are_refused(text: str) -> None:
    with pytest.raises(BadParameter, match="must be NAME=NUMBER"):
        parse_assignments([text], "--set")


@pytest.mark.parametrize(
    "text", ["9007199254740993", "9007199254740993.0", "9.007199254740993e15", "-9007199254740993."]
)
def test_whole_numbers_keep_every_digit_however_they_are_written(text: str) -> None:
    (number,) = parse_assignments([f"big={text}"], "--set").values()
    assert isinstance(number, int)
    assert abs(number) == 2**53 + 1


@pytest.mark.parametrize("text", ["9007199254740991", "1.5", "1e300", "9007199254740993.5"])
def test_other_numbers_are_floats(text: str) -> None:
    (number,) = parse_assignments([f"big={text}"], "--set").values()
    assert isinstance(number, float)


def test_a_name_given_twice_is_refused() -> None:
    with pytest.raises(BadParameter, match="J is given twice"):
        parse_assignments(["J=1", "J=2"], "--set")


def test_the_joystick_of_a_law() -> None:
    assert joystick_of("constant", {}) == NOMINAL
    changed = joystick_of("power-law", {"damping.alpha": 0.5})
    assert changed == NOMINAL_POWER_LAW.replace({"damping.alpha": 0.5})
    with pytest.raises(UnknownParameterError, match=r"damping\.alpha"):
        joystick_of("constant", {"damping.alpha": 0.5})
    with pytest.raises(ParameterError, match=r"theta_start = 0\.1: must be left out .*--release-angle"):
        joystick_of("constant", {"theta_start": 0.1})


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a=24.1mm", 0.0241),
        ("a = 2.41 cm", 0.0241),
        ("h=81e-3m", 0.081),
        ("J=118.5 g.m2", 0.1185),
        ("J=0.012 kg m^2", 0.012),
        ("m=910g", 0.91),
        ("g=1 g", 9.80665),
        ("forward.returnSpring.k_s=2.625N/mm", 2625.0),
        ("backward.balanceSpring.x_0=75um", 75e-6),
        ("backward.returnSpring.F_0=52.5 N", 52.5),
        ("damping.C=45 mN.m.s/rad", 0.045),
        ("damping.eps_theta=0.1mrad", 1e-4),
        ("theta=1e-3deg", math.radians(1e-3)),
        ("x=5", 5.0),
    ],
)
def test_values_with_units_are_the_same_as_in_si_units(text: str, value: float) -> None:
    (number,) = parse_assignments([text], "--set").values()
    assert number == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a=24.1kg", "a = 24.1kg: must be a number, or one with a unit: m, cm, mm, um"),
        ("a=24.1mmm", "a = 24.1mmm: must be a number, or one with a unit: m, cm, mm, um"),
        ("J=1 kg", "J = 1 kg: must be a number, or one with a unit: kg.m2"),
        ("damping.alpha=0.9deg", r"damping\.alpha = 0\.9deg: must be a number without a unit"),
        ("nothing=3mm", "nothing = 3mm: must be a number without a unit"),
    ],
)
def test_units_of_another_dimension_are_refused(text: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        parse_assignments([text], "--set")
