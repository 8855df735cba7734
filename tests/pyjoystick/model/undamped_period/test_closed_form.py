"""The closed form for piecewise linear moments against quadrature and known properties."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest

from pyjoystick.model import (
    NOMINAL,
    JoystickParameters,
    LineOscillator,
    LineSide,
    NoOscillationError,
    RestrainedSpring,
    linearized_joystick,
    undamped_oscillation,
)
from pyjoystick.support import ParameterError


@dataclass(frozen=True, slots=True)
class LinearGeometry:
    """Lowest order in theta: x = a*theta, hence dx/dtheta = a, and cos(theta) = 1 - theta^2/2.

    The contact moment is then a*f_x(a*theta) and that of the weight m*g*h*theta: straight lines between the
    kinks.
    """

    joystick: JoystickParameters

    def angle_of_travel(self, x: float) -> float:
        return x / self.joystick.a

    def advance(self, outer: float, gap: float) -> float:
        return self.joystick.a * gap

    def lowering(self, outer: float, gap: float) -> float:
        return (outer - 0.5 * gap) * gap


AMPLITUDES = [0.2, 0.3, 0.45, 0.6, 1.0, 2.0, 5.0, 7.2, 7.5, 10.0, 15.0, 20.0]


@pytest.mark.parametrize("gravity", [9.80665, 0.0, -9.80665])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("degrees", AMPLITUDES)
def test_quadrature_with_linearized_geometry_agrees(degrees: float, side: float, gravity: float) -> None:
    """Slopes of the clearance below, at and above 0."""
    joystick = NOMINAL.replace({"g": gravity})
    release = math.radians(side * degrees)
    closed = linearized_joystick(joystick).oscillation(release)
    quadrature = undamped_oscillation(joystick, release, geometry=LinearGeometry(joystick))
    # Asked for is 1e-9.
    assert closed.period == pytest.approx(quadrature.period, rel=1e-12)
    for ours, theirs in zip(closed.spans, quadrature.spans, strict=True):
        assert (ours.side, ours.segment) == (theirs.side, theirs.segment)
        assert ours.duration == pytest.approx(theirs.duration, rel=1e-11)
        assert ours.outer == pytest.approx(theirs.outer, rel=1e-12)


@pytest.mark.parametrize("release", [1e-6, 0.5, -7.0])
def test_one_slope_is_the_linear_oscillator(release: float) -> None:
    side = LineSide((0.0,), (2.0,))
    found = LineOscillator(0.5, side, side).oscillation(release)
    assert found.period == pytest.approx(2.0 * math.pi * math.sqrt(0.5 / 2.0), rel=1e-15)
    assert found.forward == pytest.approx(found.backward, rel=1e-15)


def test_a_preload_alone_is_a_constant_force() -> None:
    """Restraints almost rigid and no stiffness to speak of: a ball that bounces, 4*sqrt(2*m*A/F)."""
    spring = RestrainedSpring(k_s=1e-6, k_h=1e15, F_0=40.0, x_0=0.0)
    side = LineSide.of_spring(spring)
    found = LineOscillator(0.5, side, side).oscillation(4e-3)
    assert found.period == pytest.approx(4.0 * math.sqrt(2.0 * 0.5 * 4e-3 / 40.0), rel=1e-7)


def test_the_force_of_a_spring_is_that_of_its_lines() -> None:
    spring = RestrainedSpring(k_s=2000.0, k_h=4e5, F_0=40.0, x_0=5e-4)
    lines = list(LineSide.of_spring(spring).lines())
    assert [line[0] for line in lines] == [0.0, 5e-4, pytest.approx(6e-4)]
    assert lines[2][2] == pytest.approx(40.0 + 2000.0 * 1e-4)


def test_a_side_that_does_not_turn_it_back() -> None:
    strong, weak = LineSide((0.0,), (2.0,)), LineSide((0.0, 1.0), (1.0, -1.0))
    with pytest.raises(NoOscillationError, match="the other side does not turn it back"):
        LineOscillator(1.0, strong, weak).oscillation(3.0)
    assert LineOscillator(1.0, strong, weak).oscillation(0.5).backward == pytest.approx(math.sqrt(0.5))


def test_a_release_that_falls_outward_or_stays() -> None:
    falls = LineSide((0.0, 1.0), (1.0, -1.0))
    with pytest.raises(NoOscillationError, match="stops or turns back"):
        LineOscillator(1.0, falls, falls).oscillation(2.5)
    with pytest.raises(NoOscillationError, match="does not let it rise"):
        LineOscillator(1.0, LineSide((0.0,), (-1.0,)), falls).oscillation(0.1)


@pytest.mark.parametrize("release", [0.0, math.inf, math.nan])
def test_what_is_no_release_is_refused(release: float) -> None:
    with pytest.raises(ParameterError, match="release"):
        linearized_joystick(NOMINAL).oscillation(release)
