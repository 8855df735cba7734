"""One step of the method against closed forms."""

from __future__ import annotations

import math

import pytest

from pyjoystick.model.reference.dormand_prince import Step


def oscillator(length: float) -> tuple[float, float]:
    """Error and its estimate after one step of theta'' = -4*theta + cos(t) from 0.7, 0.2 at t = 0.3."""
    start, theta, omega = 0.3, 0.7, 0.2

    def acceleration(time: float, angle: float, rate: float) -> float:
        return -4.0 * angle + math.cos(time)

    step = Step(acceleration, start, theta, omega, acceleration(start, theta, omega), math.inf)
    # The particular solution is cos(t)/3; the rest swings at 2 rad/s.
    cosine, sine = theta - math.cos(start) / 3.0, (omega + math.sin(start) / 3.0) / 2.0
    end, swing = start + length, 2.0 * length
    exact = math.cos(end) / 3.0 + cosine * math.cos(swing) + sine * math.sin(swing)
    exact_rate = -math.sin(end) / 3.0 + 2.0 * (sine * math.cos(swing) - cosine * math.sin(swing))
    found, found_rate, estimate = step.with_error(length)
    assert step.at(length) == (found, found_rate)
    return max(abs(found - exact), abs(found_rate - exact_rate)), estimate


def test_method_and_estimate_are_of_eighth_order() -> None:
    """The error of one step falls as length^9 and its estimate as length^8, over four halvings."""
    coarse, fine = oscillator(1.6), oscillator(0.1)
    assert math.log2(coarse[0] / fine[0]) / 4.0 == pytest.approx(9.0, abs=0.5)
    assert math.log2(coarse[1] / fine[1]) / 4.0 == pytest.approx(8.0, abs=0.5)


@pytest.mark.parametrize("length", [1.6, 0.8, 0.4, 0.2, 0.1])
def test_the_estimate_is_above_the_error(length: float) -> None:
    error, estimate = oscillator(length)
    assert error < estimate


def test_polynomials_up_to_the_eighth_power_are_exact() -> None:
    omega = Step(lambda t, theta, omega: 8.0 * t**7, 0.0, 0.0, 0.0, 0.0, math.inf).at(1.5)[1]
    assert omega == pytest.approx(1.5**8, rel=1e-14)
    theta, omega = Step(lambda t, theta, omega: 56.0 * t**6, 0.0, 0.0, 0.0, 0.0, math.inf).at(1.5)
    assert (theta, omega) == pytest.approx((1.5**8, 8.0 * 1.5**7), rel=1e-14)


def test_the_acceleration_is_never_asked_for_later_than_allowed() -> None:
    asked = []

    def acceleration(time: float, theta: float, omega: float) -> float:
        asked.append(time)
        return 0.0

    step = Step(acceleration, 1.0, 0.0, 1.0, 0.0, math.nextafter(1.1, 0.0))
    step.at(0.1)
    step.alpha_at(0.1, 0.0, 0.0)
    assert max(asked) == math.nextafter(1.1, 0.0)


def test_a_motion_without_acceleration_has_no_error() -> None:
    step = Step(lambda time, theta, omega: 0.0, 0.0, 0.1, 2.0, 0.0, math.inf)
    theta, omega, error = step.with_error(0.5)
    assert theta == pytest.approx(1.1, rel=1e-15)
    assert omega == 2.0
    assert error < 1e-13
