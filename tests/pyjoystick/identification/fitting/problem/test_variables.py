"""The variables of a fit."""

from __future__ import annotations

import math

import pytest

from pyjoystick.identification.fitting.problem.instrument import RELEASE_TIME
from pyjoystick.identification.fitting.problem.variables import Variable


@pytest.mark.parametrize(
    ("name", "start", "bounds", "scale"),
    [
        ("damping.C", -0.05, (-1.0, 1.0), 0.05),
        ("zero_offset", 0.0, (-1.0, 4.0), 0.5),
        ("omega_start", 0.0, (-math.inf, math.inf), 1.0),
        ("omega_start", 0.0, (0.0, math.inf), 1.0),
        (RELEASE_TIME, 12.0, (11.5, 12.5), 0.1),
    ],
)
def test_what_is_a_large_change(name: str, start: float, bounds: tuple[float, float], scale: float) -> None:
    assert Variable(name, None, name, "", start, *bounds).scale == scale
