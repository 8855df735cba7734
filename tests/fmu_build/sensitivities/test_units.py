"""Units of derivatives, against the arithmetic of parsed units."""

from __future__ import annotations

import itertools

import pytest

from fmu_build.codegen.sensitivities.declared import quotient_unit
from fmu_build.packaging.units import parse_unit

UNITS = ("1", "rad", "kg.m2", "rad/s", "N.m.s/rad", "m/s2", "W/(m2.K)", "1/s", "kg.m2/(s2.A)")


@pytest.mark.parametrize(("variable", "parameter"), list(itertools.product(UNITS, UNITS)))
def test_the_dimension_is_the_quotient(variable: str, parameter: str) -> None:
    found = parse_unit(quotient_unit(variable, parameter))
    assert found == parse_unit(variable) * parse_unit(parameter) ** -1


@pytest.mark.parametrize(
    ("variable", "parameter", "expected"),
    [
        ("rad", "kg.m2", "rad/(kg.m2)"),
        ("rad", "rad", "1"),
        ("rad/s", "rad", "1/s"),
        ("rad", "N.m.s/rad", "rad.rad/(N.m.s)"),
        ("rad", "", "rad"),
        ("", "rad", ""),
    ],
)
def test_equal_factors_cancel(variable: str, parameter: str, expected: str) -> None:
    assert quotient_unit(variable, parameter) == expected
