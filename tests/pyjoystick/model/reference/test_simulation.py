"""The function that users call: its arguments, output, torque and errors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    contact_force,
    contact_moment,
    contact_travel,
    damping_coefficient,
    energy,
    gravity_moment,
    simulate,
)
from pyjoystick.support import ParameterError, SimulationError, Torque

TOPPLING = NOMINAL.replace(
    {f"{side}.returnSpring.x_0": 1e30 for side in ("forward", "backward")}
    | {f"{side}.balanceSpring.x_0": 2e30 for side in ("forward", "backward")}
)


def test_output_follows_from_angle_and_velocity() -> None:
    time = np.linspace(0.2, 0.7, 101)
    run = simulate(NOMINAL_POWER_LAW, time=time, theta_start=0.3, omega_start=-1.0, torque=math.sin)
    np.testing.assert_array_equal(run.time, time)
    assert run.theta[0] == 0.3
    assert run.omega[0] == -1.0
    np.testing.assert_array_equal(run.x, contact_travel(NOMINAL_POWER_LAW, run.theta))
    np.testing.assert_array_equal(run.f_x, contact_force(NOMINAL_POWER_LAW, run.theta))
    np.testing.assert_array_equal(run.M_s, contact_moment(NOMINAL_POWER_LAW, run.theta))
    np.testing.assert_array_equal(run.M_g, gravity_moment(NOMINAL_POWER_LAW, run.theta))
    np.testing.assert_array_equal(run.C, damping_coefficient(NOMINAL_POWER_LAW.damping, run.theta, run.omega))
    np.testing.assert_array_equal(run.M_d, run.C * run.omega)
    np.testing.assert_array_equal(run.E, energy(NOMINAL_POWER_LAW, run.theta, run.omega))
    np.testing.assert_allclose(run.T, np.sin(time), rtol=1e-15)
    balance = NOMINAL_POWER_LAW.J * run.alpha + run.M_d + run.M_s - run.M_g
    np.testing.assert_allclose(balance, run.T, atol=1e-12)
    assert run.accepted > len(run.events) > 0


def test_derivatives_are_derivatives() -> None:
    """Fourth-order differences of the output, away from the steep segments, where alpha is smooth."""
    h = 1e-4
    run = simulate(NOMINAL, time=np.arange(0.0, 0.03, h), theta_start=0.3)
    assert run.x[-1] > NOMINAL.forward.kinks[3]
    for series, derivative in ((run.theta, run.omega), (run.omega, run.alpha)):
        difference = (8.0 * (series[3:-1] - series[1:-3]) - (series[4:] - series[:-4])) / (12.0 * h)
        np.testing.assert_allclose(difference, derivative[2:-2], rtol=1e-8, atol=1e-8)


def test_the_choice_of_output_times_does_not_touch_the_motion() -> None:
    fine = simulate(NOMINAL_POWER_LAW, time=np.linspace(0.0, 0.6, 6001), theta_start=-0.3)
    coarse = simulate(NOMINAL_POWER_LAW, time=[0.0, 0.3, 0.6], theta_start=-0.3)
    np.testing.assert_array_equal(fine.theta[[0, 3000, 6000]], coarse.theta)
    assert fine.events == coarse.events


def test_a_jump_of_torque_equals_a_run_that_stops_and_goes_on() -> None:
    time = np.linspace(0.0, 1.0, 11)
    whole = simulate(
        NOMINAL,
        time=time,
        theta_start=0.1,
        torque=lambda t: 0.3 if t < 0.4 else -0.5,
        torque_breakpoints=[0.4, -1.0, 7.0, 0.4],
    )
    first = simulate(NOMINAL, time=time[:5], theta_start=0.1, torque=lambda t: 0.3)
    second = simulate(
        NOMINAL,
        time=time[4:],
        theta_start=first.theta[-1],
        omega_start=first.omega[-1],
        torque=lambda t: -0.5,
    )
    np.testing.assert_allclose(whole.theta, [*first.theta, *second.theta[1:]], atol=1e-13)
    assert len(whole.events) == len(first.events) + len(second.events)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"theta_start": -20.0}, r"^theta_start = -20\.0: .* -20 degrees are"),
        ({"theta_start": math.nan}, "^theta_start = nan"),
        ({"omega_start": math.inf}, "^omega_start = inf"),
        ({"tolerance": 0.0}, r"^tolerance = 0\.0"),
        ({"torque_breakpoints": [math.nan]}, "^torque_breakpoints = nan"),
        ({"time": [0.0]}, "^time = array of shape"),
        ({"time": 1.0}, "^time = array of shape"),
        ({"time": [[0.0, 1.0]]}, "^time = array of shape"),
        ({"time": [0.0, math.nan, 1.0]}, r"^time\[1\] = nan"),
        ({"time": [0.0, 0.5, 0.5]}, r"^time\[2\] = 0\.5: must be above time\[1\] = 0\.5 s"),
        ({"time": [0.0, "x"]}, "^time = "),
    ],
)
def test_bad_arguments_are_named(changes: dict[str, Any], message: str) -> None:
    arguments: dict[str, Any] = {"time": [0.0, 1.0], "theta_start": 0.1}
    with pytest.raises(ParameterError, match=message):
        simulate(NOMINAL, **(arguments | changes))


def test_a_motion_that_reaches_a_right_angle_stops_with_its_time() -> None:
    with pytest.raises(SimulationError, match="the angle has reached pi/2") as caught:
        simulate(TOPPLING, time=[0.0, 5.0], theta_start=0.1)
    before = simulate(TOPPLING, time=[0.0, 0.9 * caught.value.time], theta_start=0.1)
    assert 0.5 < before.theta[-1] < math.pi / 2.0


def test_a_torque_that_is_no_number_stops_the_run() -> None:
    with pytest.raises(SimulationError, match="the torque is nan N m"):
        simulate(NOMINAL, time=[0.0, 1.0], theta_start=0.1, torque=lambda t: math.nan if t > 0.5 else 0.0)


@pytest.mark.parametrize(
    ("torque", "tolerance"),
    [(lambda t: 0.3 if t < 0.5 else -0.5, 1e-13), (lambda t: 1.0 / (t - 0.5), 1e-9)],
    ids=["jump", "pole"],
)
def test_a_torque_that_is_not_smooth_where_no_breakpoint_is_stops_the_run(
    torque: Torque, tolerance: float
) -> None:
    with pytest.raises(SimulationError, match="does the torque jump here") as caught:
        simulate(NOMINAL, time=[0.0, 1.0], theta_start=0.1, torque=torque, tolerance=tolerance)
    assert caught.value.time == pytest.approx(0.5, abs=1e-4)


def test_the_errors_of_a_torque_pass_through() -> None:
    def torque(time: float) -> float:
        raise LookupError("no torque")

    with pytest.raises(LookupError, match="no torque"):
        simulate(NOMINAL, time=[0.0, 1.0], theta_start=0.1, torque=torque)
