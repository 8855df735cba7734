"""Events: every crossing, in order, exactly at its kink, also if the motion is slow, grazes or rests."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    Event,
    JoystickParameters,
    angle_of_travel,
    contact_moment,
    gravity_moment,
    simulate,
)
from pyjoystick.model.reference.branches import PiecewiseEquation
from pyjoystick.model.reference.integration import first_zero

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


UNDAMPED = NOMINAL.replace({"damping.C": 0.0})
NO_CLEARANCE = NOMINAL.replace({"forward.returnSpring.x_0": 0.0, "backward.returnSpring.x_0": 0.0})
TOUCHING = NOMINAL.replace({f"{side}.returnSpring.F_0": 0.0 for side in ("forward", "backward")})


def assert_a_walk(parameters: JoystickParameters, theta_start: float, events: tuple[Event, ...]) -> None:
    """Each event passes the boundary next to where the one before it has led."""
    boundaries = PiecewiseEquation(parameters, None).boundaries
    ladder = [(kind, boundary.theta) for boundary in boundaries for kind in boundary.kinks]
    position: int | None = None
    for event in events:
        rung = ladder.index((event.kind, event.theta))
        above = rung + 1 if event.direction > 0 else rung
        if position is None:
            below_start = sum(theta < theta_start for _, theta in ladder)
            at_start = sum(theta == theta_start for _, theta in ladder)
            assert below_start <= rung + (event.direction < 0) <= below_start + at_start
        else:
            assert rung == (position if event.direction > 0 else position - 1)
        assert event.omega * event.direction >= 0.0
        position = above
    times = [event.time for event in events]
    assert times == sorted(times)


@settings(max_examples=40, derandomize=True, deadline=None)
@given(
    st.sampled_from([NOMINAL, NOMINAL_POWER_LAW, UNDAMPED, NO_CLEARANCE, TOUCHING]),
    st.floats(-0.35, 0.35) | st.floats(-0.01, 0.01) | st.just(0.0),
    st.floats(-8.0, 8.0) | st.floats(-0.1, 0.1) | st.just(0.0),
)
def test_events_are_a_walk_from_kink_to_kink(
    parameters: JoystickParameters, theta: float, omega: float
) -> None:
    run = simulate(parameters, time=[0.0, 0.4], theta_start=theta, omega_start=omega, tolerance=1e-10)
    assert_a_walk(parameters, theta, run.events)
    # Between two turning points theta is monotone: all passages have one direction, and the next the other.
    turns = np.array([turn.time for turn in run.turning_points])
    for event in run.events:
        swing = int(np.searchsorted(turns, event.time))
        same = [other.direction for other in run.events if int(np.searchsorted(turns, other.time)) == swing]
        assert len(set(same)) == 1


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_an_event_lies_on_its_kink(parameters: JoystickParameters) -> None:
    """The motion is run again with the events as output times: it must be at the kinks."""
    first = simulate(parameters, time=[0.0, 1.0], theta_start=-0.349)
    times = [event.time for event in first.events]
    again = simulate(parameters, time=[0.0, *times, 1.0], theta_start=-0.349)
    np.testing.assert_allclose(again.theta[1:-1], [event.theta for event in first.events], atol=1e-14)
    np.testing.assert_allclose(again.omega[1:-1], [event.omega for event in first.events], atol=1e-11)


def turning_amplitude(kink: float) -> float:
    """The backward angle from which the undamped joystick just reaches a forward angle."""
    level = float(gravity_energy(kink))
    return float(
        brentq(lambda theta: float(gravity_energy(theta)) - level, -0.6, -0.00314, xtol=1e-17, rtol=1e-15)
    )


def gravity_energy(theta: float) -> float:
    return float(simulate(UNDAMPED, time=[0.0, 1e-9], theta_start=theta).E[0])


@pytest.mark.parametrize("beyond", [-1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-6])
@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_motion_that_grazes_a_kink_passes_it_both_ways_or_not_at_all(number: int, beyond: float) -> None:
    kink = angle_of_travel(UNDAMPED, UNDAMPED.forward.kinks[number])
    start = turning_amplitude(kink + beyond)
    run = simulate(UNDAMPED, time=np.linspace(0.0, 0.5, 201), theta_start=start)
    assert_a_walk(UNDAMPED, start, run.events)
    turn = run.turning_points[0]
    assert turn.theta == pytest.approx(kink + beyond, abs=1e-11)
    passed = [
        event for event in run.events if event.kind == f"forward x_{number}" and event.time < 1.5 * turn.time
    ]
    assert [event.direction for event in passed] in ([], [1, -1])
    if abs(beyond) > 1e-11:
        assert bool(passed) == (beyond > 0.0)
    # The force is continuous, so a grazed kink must not show in the motion.
    neighbor = simulate(UNDAMPED, time=run.time, theta_start=turning_amplitude(kink + beyond + 1e-9))
    assert np.max(np.abs(neighbor.theta - run.theta)) < 3e-7


def test_a_start_on_a_kink_is_no_passage() -> None:
    for i, kink in enumerate(NOMINAL.forward.kinks):
        angle = angle_of_travel(NOMINAL, kink)
        outward = simulate(NOMINAL, time=[0.0, 1e-3], theta_start=angle, omega_start=1e-3)
        inward = simulate(NOMINAL, time=[0.0, 1e-5], theta_start=angle, omega_start=-1e-3)
        assert all(event.time > 0.0 for event in outward.events)
        assert inward.events == ()
        assert_a_walk(NOMINAL, angle, outward.events)
        at_rest = simulate(NOMINAL, time=[0.0, 1e-6], theta_start=angle)
        assert at_rest.events == (), i


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW, NO_CLEARANCE])
def test_at_rest_in_the_middle_nothing_happens(parameters: JoystickParameters) -> None:
    run = simulate(parameters, time=[0.0, 1.0], theta_start=0.0)
    assert run.theta.tolist() == run.omega.tolist() == [0.0, 0.0]
    assert (run.events, run.turning_points) == ((), ())


@pytest.mark.parametrize("torque", [lambda t: 1.0, math.sin, lambda t: t * t, lambda t: max(0.0, t - 0.1)])
def test_leaving_the_middle_from_rest_is_the_same_either_way(torque: Callable[[float], float]) -> None:
    """Mirrored joysticks; the branch at rest on theta = 0 must not matter, nor be an event."""
    mirrored = NOMINAL.replace(
        {
            name.replace("forward", "backward"): value
            for name, value in NOMINAL.to_names().items()
            if "forward" in name
        }
    )
    arguments: dict[str, Any] = {
        "time": np.linspace(0.0, 0.3, 31),
        "theta_start": 0.0,
        "torque_breakpoints": [0.1],
    }
    ahead = simulate(mirrored, torque=torque, **arguments)
    behind = simulate(mirrored, torque=lambda t: -torque(t), **arguments)
    np.testing.assert_allclose(ahead.theta, -behind.theta, atol=1e-15)
    assert len(ahead.events) > 0
    for event, mirror in zip(ahead.events, behind.events, strict=True):
        assert mirror.kind == event.kind.replace("forward", "backward")
        assert mirror.direction == -event.direction


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_the_joystick_rests_against_either_plunger_and_not_between(
    parameters: JoystickParameters, side: float
) -> None:
    """Gravity pushes it through the clearance to where M_s = m*g*h*sin(theta), in the first steep segment."""
    clear, slack = (angle_of_travel(parameters, x) for x in parameters.forward.kinks[:2])

    def moment(theta: float) -> float:
        return (
            float(contact_moment(parameters, side * theta) - gravity_moment(parameters, side * theta)) * side
        )

    rest = side * float(brentq(moment, clear, slack, xtol=1e-17, rtol=1e-15))
    still = simulate(parameters, time=np.linspace(0.0, 2.0, 5), theta_start=rest)
    np.testing.assert_allclose(still.theta, rest, atol=1e-14)
    assert still.events == ()
    pushed = simulate(parameters, time=[0.0, 8.0], theta_start=side * 1e-5, tolerance=1e-9)
    assert pushed.theta[-1] == pytest.approx(rest, abs=1e-5)


@pytest.mark.parametrize("degrees", [-12.0, 0.5, 5.0])
def test_a_torque_that_balances_the_start_holds_it_there(degrees: float) -> None:
    """To the last bit: there is no heading, and no boundary ahead."""
    start = math.radians(degrees)
    hold = float(contact_moment(NOMINAL, start) - gravity_moment(NOMINAL, start))
    run = simulate(NOMINAL, time=np.linspace(0.0, 1.0, 11), theta_start=start, torque=lambda time: hold)
    assert np.abs(run.theta - start).max() <= 4.0 * math.ulp(start)
    assert run.events == ()
