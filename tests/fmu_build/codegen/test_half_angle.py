"""Sines and cosines from the tangent of half the angle: where they are used, and their accuracy."""

from __future__ import annotations

import math
import random

import pytest

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression, binary, unary, y
from fmu_build.codegen.half_angle import from_half

ANGLE = y(0)
SINE, COSINE = unary("Sin", ANGLE), unary("Cos", ANGLE)
HALVES = [
    binary("Div", ANGLE, ex.number(2.0)),
    binary("Mul", ex.number(0.5), ANGLE),
    binary("Mul", ANGLE, ex.number(0.5)),
]


@pytest.mark.parametrize("half", HALVES)
def test_tangent_of_half_the_angle_is_found(half: Expression) -> None:
    tangent = unary("Tan", half)
    product = binary("Mul", SINE, COSINE)
    assert from_half([product, binary("Add", tangent, ex.ONE)]) == {SINE: tangent, COSINE: tangent}


@pytest.mark.parametrize(
    "others",
    [
        [unary("Tan", ANGLE)],
        [unary("Tan", binary("Div", y(1), ex.number(2.0)))],
        [unary("Tan", binary("Div", ex.number(2.0), ANGLE))],
    ],
    ids=["whole angle", "another angle", "two over the angle"],
)
def test_others_stay(others: list[Expression]) -> None:
    assert from_half([SINE, COSINE, *others]) == {}


def test_as_accurate_as_the_library() -> None:
    """Also beside the multiples of pi, where the tangent is tiny or huge."""
    source = random.Random(1)
    angles = [source.uniform(-10.0, 10.0) for _ in range(5000)]
    angles += [k * math.pi + sign * 10.0**-n for k in range(-3, 4) for n in range(1, 17) for sign in (-1, 1)]
    for angle in [*angles, math.pi, -math.pi, 2.0 * math.pi]:
        t = math.tan(angle / 2.0)
        assert 2.0 * t / (1.0 + t * t) == pytest.approx(math.sin(angle), rel=1e-15, abs=0.0)
        assert (1.0 - t) * (1.0 + t) / (1.0 + t * t) == pytest.approx(math.cos(angle), rel=0.0, abs=4e-16)
