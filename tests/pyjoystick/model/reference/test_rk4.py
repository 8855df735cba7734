"""The paper's integrator: correct where the motion is smooth, and its error at the kinks."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, simulate, simulate_rk4
from pyjoystick.support import ParameterError, SimulationError

RELEASE = math.radians(-20.0)


def error(parameters: JoystickParameters, **settings: Any) -> float:
    """Largest difference in theta (rad) from the reference over the paper's 1.5 s."""
    rough = simulate_rk4(parameters, duration=1.5, theta_start=RELEASE, **settings)
    exact = simulate(parameters, time=rough.time, theta_start=RELEASE)
    return float(np.max(np.abs(rough.theta - exact.theta)))


@pytest.mark.parametrize(
    ("parameters", "bound"),
    # Measured: 2.4e-5 rad (constant damping) and 9.7e-4 rad (eq. (11), which is sharp near omega = 0).
    [(NOMINAL, 4e-5), (NOMINAL_POWER_LAW, 1.5e-3)],
    ids=["constant", "power law"],
)
def test_the_papers_settings_agree_with_the_reference_to_their_own_accuracy(
    parameters: JoystickParameters, bound: float
) -> None:
    assert 1e-6 < error(parameters) < bound


def test_dividing_the_step_near_the_steep_slopes_pays() -> None:
    """Measured: 5.8e-3 rad without it, 2.4e-5 rad with it and with 0.1 ms everywhere."""
    assert error(NOMINAL, refinement=1) > 100.0 * error(NOMINAL)
    assert error(NOMINAL, step=1e-4, refinement=1) > 0.9 * error(NOMINAL)


def test_the_error_falls_with_the_step() -> None:
    """Steps that straddle kinks leave first to second order, far from the method's fourth."""
    errors = [error(NOMINAL, step=step) for step in (1e-3, 5e-4, 1.25e-4)]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.1 * errors[0]


def test_between_kinks_it_is_of_fourth_order() -> None:
    """The first 40 ms from 0.3 rad stay in the last segment."""

    def early_error(step: float) -> float:
        rough = simulate_rk4(NOMINAL, duration=0.04, theta_start=0.3, step=step)
        assert rough.accepted == round(0.04 / step)
        exact = simulate(NOMINAL, time=rough.time, theta_start=0.3)
        assert exact.events == ()
        return float(np.max(np.abs(rough.theta - exact.theta)))

    assert math.log2(early_error(4e-3) / early_error(2e-3)) == pytest.approx(4.0, abs=0.3)


def test_steps_are_divided_where_a_steep_segment_is_near() -> None:
    """From the middle at 0.1 rad/s, x_0 is 31 ms away: only the steps from there on are divided."""
    rough = simulate_rk4(NOMINAL, duration=0.020, theta_start=0.0, omega_start=0.1)
    assert rough.accepted == 20
    further = simulate_rk4(NOMINAL, duration=0.040, theta_start=0.0, omega_start=0.1)
    assert 40 < further.accepted <= 20 + 10 * 20
    within = simulate_rk4(NOMINAL, duration=0.005, theta_start=0.005)
    assert within.accepted == 50


def test_torque_and_time_grid() -> None:
    run = simulate_rk4(NOMINAL, duration=0.2, theta_start=0.3, torque=lambda t: 0.2 * math.sin(5.0 * t))
    np.testing.assert_allclose(run.time, 1e-3 * np.arange(201), rtol=1e-15)
    np.testing.assert_allclose(run.T, 0.2 * np.sin(5.0 * run.time), rtol=1e-14)
    exact = simulate(NOMINAL, time=run.time, theta_start=0.3, torque=lambda t: 0.2 * math.sin(5.0 * t))
    assert np.max(np.abs(run.theta - exact.theta)) < 1e-4
    assert (run.events, run.turning_points) == ((), ())


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"theta_start": 20.0}, "20 degrees are"),
        ({"omega_start": math.nan}, "^omega_start = nan"),
        ({"duration": 0.0}, r"^duration = 0\.0"),
        ({"step": -1e-3}, r"^step = -0\.001"),
        ({"refinement": 0}, "^refinement = 0: must be a whole number, 1 or more"),
        ({"refinement": 2.5}, r"^refinement = 2\.5"),
    ],
)
def test_bad_arguments_are_named(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        simulate_rk4(NOMINAL, **({"duration": 1.0, "theta_start": 0.1} | changes))


def test_a_motion_out_of_range_stops_with_its_time() -> None:
    with pytest.raises(SimulationError, match="outside -pi/2 to pi/2"):
        simulate_rk4(NOMINAL, duration=1.0, theta_start=0.1, torque=lambda t: 1e9)
    with pytest.raises(SimulationError, match="the torque is inf"):
        simulate_rk4(NOMINAL, duration=1.0, theta_start=0.1, torque=lambda t: math.inf)
