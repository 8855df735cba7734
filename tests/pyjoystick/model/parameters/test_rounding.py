"""Digits that are worth writing."""

from __future__ import annotations

import math

import pytest

from pyjoystick.model import rounded, rounded_error


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (0.044988249, 1.66e-5, 0.0449882),
        (52.78081250000001, 0.031, 52.7808),
        (1234567.0, 5600.0, 1234570.0),
        (0.1 + 0.2, 0.0, 0.1 + 0.2),
        (0.1 + 0.2, math.inf, 0.1 + 0.2),
    ],
)
def test_a_value_keeps_a_hundredth_of_its_error(value: float, error: float, expected: float) -> None:
    assert rounded(value, error) == expected


def test_an_error_has_two_digits() -> None:
    assert rounded_error(1.66e-5) == 1.7e-5
