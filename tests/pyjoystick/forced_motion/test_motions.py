"""Motions in closed form."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, strategies as st

from pyjoystick.forced_motion import SHAPES, ForwardAndReturn, Shape
from pyjoystick.support import ParameterError
from tests.pyjoystick.forced_motion.cases import MOTIONS

A = 0.3


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_velocity_and_acceleration_are_the_derivatives(motion: ForwardAndReturn) -> None:
    """Central differences of fourth order inside each smooth span."""
    for start, end in pairwise(motion.breakpoints):
        h = 1e-3 * (end - start)
        time = np.linspace(start + 3.0 * h, end - 3.0 * h, 101)
        at = [motion.at(time + k * h) for k in (-2, -1, 1, 2)]
        exact = motion.at(time)
        for value, derivative in (("theta", "omega"), ("omega", "alpha")):
            before2, before, after, after2 = (getattr(one, value) for one in at)
            found = (8.0 * (after - before) - (after2 - before2)) / (12.0 * h)
            expected = getattr(exact, derivative)
            assert np.abs(found - expected).max() <= 1e-8 * max(1.0, np.abs(expected).max())


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_angle_and_velocity_do_not_jump_and_the_amplitude_is_met(motion: ForwardAndReturn) -> None:
    corners = motion.breakpoints
    before, after = motion.at(corners, "before"), motion.at(corners, "after")
    np.testing.assert_allclose(before.theta, after.theta, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(before.omega, after.omega, rtol=0.0, atol=1e-13)
    top = motion.at(motion.rest + motion.rise)
    assert top.theta == pytest.approx(motion.amplitude, rel=1e-15)
    assert abs(top.omega) < 1e-13
    assert corners[0] == 0.0
    assert corners[-1] == pytest.approx(motion.duration, rel=1e-15)
    for end in (motion.at(0.0), motion.at(motion.duration)):
        assert (end.theta, end.omega) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("shape", "velocity", "acceleration", "jumps"),
    [
        ("minimum-jerk", 15.0 / 8.0, 10.0 / math.sqrt(3.0), 0),
        ("raised-cosine", math.pi / 2.0, math.pi**2 / 2.0, 3),
        ("trapezoid", 3.0 / 2.0, 9.0 / 2.0, 7),
    ],
)
def test_peaks_and_jumps_are_those_of_the_shape(
    shape: Shape, velocity: float, acceleration: float, jumps: int
) -> None:
    """The trapezoid is a third flat. Where stroke and return meet there is no jump: the force goes on."""
    time = 0.2
    motion = ForwardAndReturn(amplitude=A, rise=time, rest=0.1, shape=shape)
    fine = motion.at(np.linspace(0.0, motion.duration, 200_001))
    assert np.abs(fine.omega).max() == pytest.approx(velocity * A / time, rel=1e-8)
    assert np.abs(fine.alpha).max() == pytest.approx(acceleration * A / time**2, rel=1e-8)
    before, after = motion.at(motion.breakpoints, "before"), motion.at(motion.breakpoints, "after")
    found = np.count_nonzero(np.abs(after.alpha - before.alpha) > 1e-6 * acceleration * A / time**2)
    assert found == {"minimum-jerk": 0, "raised-cosine": 2, "trapezoid": 6}[shape]


@given(shape=st.sampled_from(SHAPES), u=st.floats(0.0, 1.0))
def test_the_return_is_the_stroke_in_reverse(shape: Shape, u: float) -> None:
    motion = ForwardAndReturn(amplitude=A, rise=1.0, shape=shape)
    there, back = motion.at(u, "before"), motion.at(2.0 - u, "after")
    assert back.theta == pytest.approx(float(there.theta), abs=1e-15)
    assert back.omega == pytest.approx(-float(there.omega), abs=1e-14)
    if abs(u - 1.0) > 1e-9:  # at the top itself both instants are one
        assert back.alpha == pytest.approx(float(there.alpha), abs=1e-12)


def test_small_angles_at_the_end_keep_their_digits() -> None:
    motion = ForwardAndReturn(amplitude=A, rise=1.0)
    left = 2.0**-20
    assert float(motion.at(2.0 - left).theta) == pytest.approx(10.0 * A * left**3, rel=2e-6)


def test_a_trapezoid_without_flat_part_is_a_triangle() -> None:
    motion = ForwardAndReturn(amplitude=A, rise=1.0, shape="trapezoid", flat=0.0)
    assert motion.breakpoints == (0.0, 0.5, 1.0, 1.5, 2.0)
    assert float(motion.at(0.5).omega) == pytest.approx(2.0 * A, rel=1e-15)
    assert float(motion.at(0.25).alpha) == pytest.approx(4.0 * A, rel=1e-15)


def test_outside_it_is_at_rest() -> None:
    at = ForwardAndReturn(amplitude=A, rise=1.0, shape="raised-cosine").at([-1e-9, 2.0 + 1e-9])
    np.testing.assert_array_equal(np.stack((at.theta, at.omega, at.alpha)), 0.0)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"amplitude": 0.0}, "amplitude = 0.0: must be an angle other than 0 rad"),
        ({"amplitude": 15.0}, "amplitude = 15.0: .* 15 degrees are 0.261799 rad"),
        ({"amplitude": math.nan}, "amplitude = nan"),
        ({"rise": 0.0}, "rise = 0.0: must be a finite number above 0 s"),
        ({"fall": -1.0}, "fall = -1.0"),
        ({"dwell": -0.1}, "dwell = -0.1: must be a finite number, 0 s or more"),
        ({"rest": math.inf}, "rest = inf"),
        ({"shape": "square"}, "shape = square: must be one of minimum-jerk, raised-cosine, trapezoid"),
        ({"flat": 1.0}, "flat = 1.0: must be 0 or more and below 1"),
    ],
)
def test_what_is_refused(settings: dict[str, object], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        ForwardAndReturn(**{"amplitude": A, "rise": 0.2, **settings})  # type: ignore[arg-type]
