"""Unit strings against exponents derived by hand from the SI definitions."""

from __future__ import annotations

import math

import pytest

from fmu_build.packaging.units import BASE_UNITS, UnitError, conversion, parse_unit

# unit: exponents of kg, m, s, A, K, mol, cd, rad; factor
MEANINGS = {
    "1": ((0, 0, 0, 0, 0, 0, 0, 0), 1.0),
    "kg": ((1, 0, 0, 0, 0, 0, 0, 0), 1.0),
    "g": ((1, 0, 0, 0, 0, 0, 0, 0), 1e-3),
    "m": ((0, 1, 0, 0, 0, 0, 0, 0), 1.0),
    "mm": ((0, 1, 0, 0, 0, 0, 0, 0), 1e-3),
    "um": ((0, 1, 0, 0, 0, 0, 0, 0), 1e-6),
    "s": ((0, 0, 1, 0, 0, 0, 0, 0), 1.0),
    "ms": ((0, 0, 1, 0, 0, 0, 0, 0), 1e-3),
    "min": ((0, 0, 1, 0, 0, 0, 0, 0), 60.0),
    "1/s": ((0, 0, -1, 0, 0, 0, 0, 0), 1.0),
    "Hz": ((0, 0, -1, 0, 0, 0, 0, 0), 1.0),
    "s-1": ((0, 0, -1, 0, 0, 0, 0, 0), 1.0),
    "s+2": ((0, 0, 2, 0, 0, 0, 0, 0), 1.0),
    "N": ((1, 1, -2, 0, 0, 0, 0, 0), 1.0),
    "kN": ((1, 1, -2, 0, 0, 0, 0, 0), 1e3),
    "N/m": ((1, 0, -2, 0, 0, 0, 0, 0), 1.0),
    "N/mm": ((1, 0, -2, 0, 0, 0, 0, 0), 1e3),
    "N.m": ((1, 2, -2, 0, 0, 0, 0, 0), 1.0),
    "J": ((1, 2, -2, 0, 0, 0, 0, 0), 1.0),
    "W": ((1, 2, -3, 0, 0, 0, 0, 0), 1.0),
    "Pa": ((1, -1, -2, 0, 0, 0, 0, 0), 1.0),
    "bar": ((1, -1, -2, 0, 0, 0, 0, 0), 1e5),
    "kg.m2": ((1, 2, 0, 0, 0, 0, 0, 0), 1.0),
    "g.cm2": ((1, 2, 0, 0, 0, 0, 0, 0), 1e-7),
    "kg.m2/s2": ((1, 2, -2, 0, 0, 0, 0, 0), 1.0),
    "m/s": ((0, 1, -1, 0, 0, 0, 0, 0), 1.0),
    "km/h": ((0, 1, -1, 0, 0, 0, 0, 0), 1 / 3.6),
    "m/s2": ((0, 1, -2, 0, 0, 0, 0, 0), 1.0),
    "rad": ((0, 0, 0, 0, 0, 0, 0, 1), 1.0),
    "deg": ((0, 0, 0, 0, 0, 0, 0, 1), math.pi / 180),
    "rad/s": ((0, 0, -1, 0, 0, 0, 0, 1), 1.0),
    "rev/min": ((0, 0, -1, 0, 0, 0, 0, 1), 2 * math.pi / 60),
    "rad/s2": ((0, 0, -2, 0, 0, 0, 0, 1), 1.0),
    "N.m.s/rad": ((1, 2, -1, 0, 0, 0, 0, -1), 1.0),
    "N.m.s/deg": ((1, 2, -1, 0, 0, 0, 0, -1), 180 / math.pi),
    "N.m/rad": ((1, 2, -2, 0, 0, 0, 0, -1), 1.0),
    "V": ((1, 2, -3, -1, 0, 0, 0, 0), 1.0),
    "Ohm": ((1, 2, -3, -2, 0, 0, 0, 0), 1.0),
    "kOhm": ((1, 2, -3, -2, 0, 0, 0, 0), 1e3),
    "F": ((-1, -2, 4, 2, 0, 0, 0, 0), 1.0),
    "H": ((1, 2, -2, -2, 0, 0, 0, 0), 1.0),
    "Wb": ((1, 2, -2, -1, 0, 0, 0, 0), 1.0),
    "W/(m2.K)": ((1, 0, -3, 0, -1, 0, 0, 0), 1.0),
    "(N.m)/(kg/s)": ((0, 2, -1, 0, 0, 0, 0, 0), 1.0),
    "J/(mol.K)": ((1, 2, -2, 0, -1, -1, 0, 0), 1.0),
    "kat": ((0, 0, -1, 0, 0, 1, 0, 0), 1.0),
    "cd": ((0, 0, 0, 0, 0, 0, 1, 0), 1.0),
    "lm": ((0, 0, 0, 0, 0, 0, 1, 2), 1.0),
    "dam": ((0, 1, 0, 0, 0, 0, 0, 0), 10.0),
}


@pytest.mark.parametrize("text", MEANINGS)
def test_meaning_of_a_unit(text: str) -> None:
    exponents, factor = MEANINGS[text]
    unit = parse_unit(text)
    assert dict(zip(BASE_UNITS, unit.exponents, strict=True)) == dict(zip(BASE_UNITS, exponents, strict=True))
    assert float(unit.factor) == pytest.approx(factor, rel=1e-15)
    assert unit.offset == 0


def test_celsius_has_an_offset_but_its_multiples_do_not_exist() -> None:
    assert float(parse_unit("degC").offset) == 273.15
    assert conversion("K", "degC") == (1.0, -273.15)
    assert conversion("degC", "K") == (1.0, 273.15)
    assert parse_unit("W/(m.degC)").offset == 0  # a difference of temperatures
    with pytest.raises(UnitError, match="mdegC"):
        parse_unit("mdegC")


def test_boiling_water_in_fahrenheit() -> None:
    factor, offset = conversion("degC", "degF")
    assert factor * 100 + offset == pytest.approx(212.0, abs=1e-12)


@pytest.mark.parametrize(
    ("unit", "display", "factor"),
    [
        ("rad", "deg", 180 / math.pi),
        ("m", "mm", 1e3),
        ("s", "ms", 1e3),
        ("rad/s", "rev/min", 60 / (2 * math.pi)),
        ("N.m.s/rad", "N.m.s/deg", math.pi / 180),
        ("m/s", "km/h", 3.6),
    ],
)
def test_display_factor(unit: str, display: str, factor: float) -> None:
    assert conversion(unit, display)[0] == pytest.approx(factor, rel=1e-15)
    assert conversion(unit, display)[1] == 0.0


@pytest.mark.parametrize(
    "text", ["", "foo", "N m", "N*m", "m^2", "m/s/s", "N.", "/s", "(m", "m)", "2", "1.m", "m2.5", "Nm.", "µm"]
)
def test_not_a_unit(text: str) -> None:
    with pytest.raises(UnitError, match="is not a unit"):
        parse_unit(text)


def test_units_of_different_quantities_do_not_convert() -> None:
    with pytest.raises(UnitError, match=r"'N' cannot display values in 'N\.m'"):
        conversion("N.m", "N")
    with pytest.raises(UnitError, match="'1' cannot display values in 'rad'"):
        conversion("rad", "1")
