"""Zeros of a monotone function, easy and awkward ones."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from pyjoystick.model.reference.location import first_zero

Function = Callable[[float], tuple[float, float]]


@pytest.mark.parametrize(
    ("function", "end", "zero"),
    [
        (lambda s: (s - 0.3, 1.0), 1.0, 0.3),
        (lambda s: (math.cos(s), -math.sin(s)), 3.0, math.pi / 2.0),
        (lambda s: (s**9 - 1e-9, 9.0 * s**8), 1.0, 0.1),  # Newton from a flat start overshoots
        (
            lambda s: (math.atan(1e6 * (s - 0.7)), 1e6 / (1.0 + (1e6 * (s - 0.7)) ** 2)),
            1.0,
            0.7,
        ),  # a near jump
        (lambda s: (s - 0.3, 0.0), 1.0, 0.3),  # no slope: bisection
        (lambda s: (s - 0.3, -1.0), 1.0, 0.3),  # a wrong slope: bisection
        (lambda s: (s * s - 1e-20, 2.0 * s), 1e-3, 1e-10),
    ],
)
def test_the_zero_is_found_to_rounding(function: Function, end: float, zero: float) -> None:
    found = first_zero(function, function(0.0)[0], end, function(end)[0], 0.0)
    assert found == pytest.approx(zero, rel=1e-14)


def test_an_end_at_zero_is_the_zero() -> None:
    assert first_zero(lambda s: (s - 1.0, 1.0), -1.0, 1.0, 0.0, 0.0) == 1.0


def test_values_below_the_resolution_end_the_search() -> None:
    calls = []

    def function(s: float) -> tuple[float, float]:
        calls.append(s)
        return s**3 - 1e-3, 3.0 * s * s

    rough = first_zero(function, -1e-3, 1.0, 0.999, 1e-5)
    assert abs(rough**3 - 1e-3) <= 1e-5
    needed = len(calls)
    first_zero(function, -1e-3, 1.0, 0.999, 0.0)
    assert len(calls) - needed > needed
