"""Ranges of sliders."""

from __future__ import annotations

import math

import pytest

from fmu_build.explore.ranges import Range, range_of


@pytest.mark.parametrize(
    ("start", "minimum", "maximum", "nominal", "expected"),
    [
        (10.0, None, None, None, Range(2.0, 50.0, "log")),
        (-10.0, None, None, None, Range(-50.0, -2.0, "log")),
        (10.0, 1e-60, math.inf, None, Range(2.0, 50.0, "log")),  # "positive" is no end of a slider
        (0.8, 0.0, 1.0, None, Range(0.16, 1.0, "log")),
        (10.0, 9.0, 12.0, None, Range(9.0, 12.0, "linear")),
        (0.0, -1.5, 1.5, None, Range(-1.5, 1.5, "linear")),
        (0.0, 0.0, None, None, Range(0.0, 1.0, "linear")),
        (0.0, 0.0, None, 20.0, Range(0.0, 20.0, "linear")),
        (0.0, None, None, None, Range(-1.0, 1.0, "linear")),
        (0.0, 1e-60, 1e60, None, Range(0.0, 1.0, "linear")),
    ],
)
def test_range(
    start: float, minimum: float | None, maximum: float | None, nominal: float | None, expected: Range
) -> None:
    assert range_of(start, minimum, maximum, nominal) == expected


def test_bounds_without_room_still_give_a_slider() -> None:
    assert range_of(2.0, 2.0, 2.0, None) == Range(0.0, 4.0, "linear")
