"""The joystick's motion and torque against the paper's equations."""

from __future__ import annotations

import numpy as np
import pytest
import rumoca

from tests.modelica import physics
from tests.modelica.library import MODELICA_PATH, Simulate
from tests.modelica.physics import Array

JOYSTICK = "PreloadedSprings.Joystick"
LAWS = {"Joystick": physics.constant_damping, "JoystickPowerLaw": physics.power_law_damping}
RELEASE = np.deg2rad(-20.0)


def _released(
    simulate: Simulate,
    model: str,
    theta_start: float,
    changes: str = "",
    stop_time: float = 1.5,
    step: float = 1e-3,
) -> dict[str, Array]:
    joystick = f"{JOYSTICK}.{model} j(T = 0, theta_start = {theta_start}{changes});"
    return simulate(joystick, stop_time, step)


@pytest.mark.parametrize("model", LAWS)
@pytest.mark.parametrize("theta_start", [RELEASE, 0.15])
def test_free_oscillation_is_that_of_the_equations(
    simulate: Simulate, model: str, theta_start: float
) -> None:
    result = _released(simulate, model, theta_start)
    times, at = np.unique(result["time"], return_index=True)
    expected = physics.free_oscillation(theta_start, LAWS[model], times)
    # The accuracy of rumoca's integrator, which does not locate every kink to rounding.
    np.testing.assert_allclose(result["j.theta"][at], expected, atol=2e-7)


@pytest.mark.parametrize("model", LAWS)
def test_outputs_are_what_they_say(simulate: Simulate, model: str) -> None:
    result = _released(simulate, model, RELEASE)
    theta, omega = result["j.theta"], result["j.omega"]
    settled = np.abs(theta) > 1e-6  # at the instant of a change of sign, the side is the event's
    x, slope = physics.travel(theta), physics.travel_slope(theta)
    sides = (theta > 0.0, theta < 0.0)
    force = np.select(sides, [physics.table_force(x, *physics.TABLE_1[side]) for side in (1, -1)])
    coefficient = [LAWS[model](a, b) for a, b in zip(theta, omega, strict=True)]
    weight = physics.MASS * physics.GRAVITY * physics.H
    late = np.max(np.abs(omega)) * simulate.event_error  # how far beyond a kink its old branch may be taken
    np.testing.assert_allclose(result["j.x"], x, atol=1e-15 + 2.0 * physics.A * late)
    steepest = max(max(stiffnesses) for _, stiffnesses in physics.TABLE_1.values())
    np.testing.assert_allclose(result["j.f_x"], force, rtol=1e-12, atol=2e-9 + steepest * physics.A * late)
    np.testing.assert_allclose(result["j.M_s"], result["j.f_x"] * slope, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(result["j.C"][settled], np.asarray(coefficient)[settled], rtol=1e-12)
    np.testing.assert_allclose(result["j.M_d"], result["j.C"] * omega, rtol=1e-14)
    np.testing.assert_allclose(result["j.M_g"], weight * np.sin(theta), rtol=1e-14)
    torque = result["j.M_g"] - result["j.M_s"] - result["j.M_d"]
    np.testing.assert_allclose(physics.J * result["j.alpha"], torque, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("model", LAWS)
def test_energy_falls_by_the_work_of_the_damping(simulate: Simulate, model: str) -> None:
    result = _released(simulate, model, RELEASE, stop_time=0.5, step=1e-5)
    energy, power = result["j.E"], result["j.C"] * result["j.omega"] ** 2
    theta, x = result["j.theta"][0], float(physics.travel(result["j.theta"][0]))
    travel = np.linspace(0.0, x, 200_001)
    spring = np.trapezoid(physics.table_force(travel, *physics.TABLE_1[-1]), travel)
    weight = physics.MASS * physics.GRAVITY * physics.H
    assert energy[0] == pytest.approx(spring + weight * (np.cos(theta) - 1.0), rel=1e-7)
    assert np.max(np.diff(energy)) < 1e-9
    loss = np.trapezoid(power, result["time"])
    assert energy[0] - energy[-1] == pytest.approx(loss, rel=1e-5)  # trapezoids of 10 us


def test_energy_is_zero_at_rest_in_the_middle_and_constant_without_damping(simulate: Simulate) -> None:
    assert np.all(_released(simulate, "Joystick", 0.0)["j.E"] == 0.0)
    energy = _released(simulate, "Joystick", -0.3, ", damping(C = 0)")["j.E"]
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


def test_period_falls_as_the_amplitude_falls(simulate: Simulate) -> None:
    result = _released(simulate, "Joystick", RELEASE)
    theta, time = result["j.theta"], result["time"]
    rising = (theta[:-1] < 0.0) & (theta[1:] >= 0.0)
    periods = np.diff(time[1:][rising])[:5]
    assert len(periods) == 5
    assert np.all(np.diff(periods) < 0.0)


def test_parameters_reach_the_components(simulate: Simulate) -> None:
    """Twice every inertia, weight, spring and damping: the same motion with twice the energy."""
    scaled = ", J = 2*0.01135, m = 2*0.87, damping(C = 0.09)" + "".join(
        f", {side}(returnSpring(k_s = 2*{r[0]}, k_h = 2*{r[1]}, F_0 = 2*{r[2]}), "
        f"balanceSpring(k_s = 2*{b[0]}, k_h = 2*{b[1]}, F_0 = 2*{b[2]}))"
        for side, r, b in (
            ("forward", (2625, 427375, 52.7808125), (2975, 1022400, 11.2464)),
            ("backward", (1191, 657809, 55.5848605), (2899, 1107910, 9.97119)),
        )
    )
    one, two = _released(simulate, "Joystick", -0.2), _released(simulate, "Joystick", -0.2, scaled)
    np.testing.assert_allclose(one["j.theta"][::100], two["j.theta"][::100], atol=1e-7)
    np.testing.assert_allclose(2.0 * one["j.E"][0], two["j.E"][0], rtol=1e-14)


def test_damping_law_can_be_replaced(simulate: Simulate) -> None:
    replaced = _released(
        simulate, "Joystick", RELEASE, ", redeclare PreloadedSprings.Damping.PowerLaw damping(alpha = 0.9)"
    )
    np.testing.assert_allclose(
        replaced["j.C"], _released(simulate, "JoystickPowerLaw", RELEASE)["j.C"], rtol=1e-6
    )
    base = f"{JOYSTICK}.Joystick(redeclare PreloadedSprings.Damping.PowerLaw damping)"
    source = f"model Own extends {base}; end Own;"
    own = rumoca.Session(roots=[str(MODELICA_PATH)]).loads(source, model="Own")
    names = {parameter.name for parameter in own.parameters}
    assert "damping.A_pos" in names
    assert "damping.C" not in names


def test_weights_of_the_power_laws_add_up_to_one(simulate: Simulate) -> None:
    coefficients = []
    for alpha in (0.0, 0.25, 1.0):
        start = f", omega_start = 2, damping(alpha = {alpha})"
        coefficients.append(_released(simulate, "JoystickPowerLaw", 0.2, start, stop_time=0.01)["j.C"][0])
    assert coefficients[0] == pytest.approx(0.051 * 2.0**-0.26, rel=1e-6)
    assert coefficients[2] == pytest.approx(0.086 * 0.2**0.084, rel=1e-6)
    assert coefficients[1] == pytest.approx(0.75 * coefficients[0] + 0.25 * coefficients[2], rel=1e-12)


def test_torque_of_a_motion_makes_that_motion(simulate: Simulate) -> None:
    result = simulate("extends PreloadedSprings.Examples.ForcedMotion;", 0.6)
    shares = [result[f"inverse.T_{share}"] for share in ("stiffness", "damping", "inertia")]
    np.testing.assert_allclose(result["inverse.T"], np.sum(shares, axis=0), atol=1e-14)
    np.testing.assert_allclose(result["inverse.T_inertia"], physics.J * result["motion.alpha"], rtol=1e-14)
    np.testing.assert_allclose(result["inverse.T_damping"], 0.045 * result["motion.omega"], rtol=1e-14)
    assert np.max(result["motion.theta"]) == pytest.approx(np.deg2rad(15.0), rel=1e-4)
    # rumoca's own solver leaves 4e-9 rad.
    np.testing.assert_allclose(result["deviation"], 0.0, atol=1e-7)
    stiffness, damping, inertia = (np.max(np.abs(share)) for share in shares)
    assert 0.3 < inertia / stiffness < 1.5
    assert 0.03 < damping / (stiffness + inertia) < 0.15
    assert 1.2 < np.max(np.abs(result["inversePowerLaw.T_damping"])) / damping < 2.5


def test_prescribed_motion_is_consistent_with_its_derivatives(simulate: Simulate) -> None:
    result = simulate(
        "PreloadedSprings.Examples.Utilities.ForwardAndReturn c(theta_max = 0.3, duration = 0.5);", 0.6, 1e-4
    )
    time, at = np.unique(result["time"], return_index=True)
    for value, rate in (("theta", "omega"), ("omega", "alpha")):
        change = np.gradient(result[f"c.{value}"][at], time)
        # Central differences over 0.1 ms are off by up to 3e-5, a sixth of the third derivative times h^2.
        np.testing.assert_allclose(change[1:-1], result[f"c.{rate}"][at][1:-1], atol=1e-4)


def test_swing_test_gives_the_moment_of_inertia(simulate: Simulate) -> None:
    result = simulate("extends PreloadedSprings.Examples.SwingTest;", 3.0)
    assert result["f_n"][-1] == pytest.approx(1.25, abs=0.005)
    amplitude_error = np.deg2rad(3.0) ** 2 / 8.0
    assert result["J_swing"][-1] / 0.01135 - 1.0 == pytest.approx(amplitude_error, rel=0.02)
