"""The reference with dry friction: closed forms, energy balance, and where it sticks and slips."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    JoystickParameters,
    Trajectory,
    contact_travel_slope,
    inverse_torque,
    simulate,
    simulate_rk4,
    sliding_friction,
    static_friction,
)
from pyjoystick.model.reference.stick_slip import first_excess
from pyjoystick.support import ParameterError

TIME = np.linspace(0.0, 1.5, 1501)
#: Out of reach of the springs, without weight and damping.
BARE = NOMINAL.replace(
    {"g": 0.0, "damping.C": 0.0, "friction.T_c": 0.02}
    | {f"{side}.returnSpring.x_0": 10.0 for side in ("forward", "backward")}
    | {f"{side}.balanceSpring.x_0": 20.0 for side in ("forward", "backward")}
)
LAWS = {
    "pivot": {"friction.T_c": 0.05},
    "plungers": {"friction.F_c": 1.0},
    "Stribeck": {"friction.T_c": 0.03, "friction.T_s": 0.06, "friction.omega_s": 0.1, "friction.F_c": 0.2},
}


def _kinds(motion: Trajectory) -> list[str]:
    return [event.kind for event in motion.events if event.kind in ("sticks", "slips")]


def test_it_slides_to_a_stop_on_a_parabola() -> None:
    motion = simulate(BARE, time=TIME, theta_start=0.1, omega_start=-0.8)
    stop, way = 0.8 * BARE.J / 0.02, 0.5 * 0.8**2 * BARE.J / 0.02
    (stick,) = (event for event in motion.events if event.kind == "sticks")
    assert stick.time == pytest.approx(stop, rel=1e-13)
    assert stick.theta == pytest.approx(0.1 - way, abs=1e-14)
    assert stick.direction == -1
    away = np.abs(TIME - stop) > 1e-9  # whether it has stopped at that very instant is rounding
    assert (motion.is_stuck == (stop < TIME))[away].all()
    assert (motion.theta[motion.is_stuck] == stick.theta).all()


def test_a_growing_torque_breaks_it_away_in_closed_form() -> None:
    """T = 0.1*t exceeds 0.02 N m at 0.2 s; from there on theta = 0.1*(t - 0.2)^3/(6*J)."""
    time = TIME[:1000]
    motion = simulate(BARE, time=time, theta_start=0.1, torque=lambda time: 0.1 * time)
    (slip,) = (event for event in motion.events if event.kind == "slips")
    assert slip.time == pytest.approx(0.2, rel=1e-14)
    expected = 0.1 + 0.1 / BARE.J * np.maximum(time - 0.2, 0.0) ** 3 / 6.0
    assert np.abs(motion.theta - expected).max() < 1e-12


def test_static_friction_holds_longer_than_it_slides() -> None:
    joystick = BARE.replace({"friction.T_s": 0.05, "friction.omega_s": 0.01})
    time = TIME[:800]
    motion = simulate(joystick, time=time, theta_start=0.0, torque=lambda time: 0.1 * time)
    assert next(event.time for event in motion.events if event.kind == "slips") == pytest.approx(
        0.5, rel=1e-13
    )
    # Beyond the Stribeck velocity it slides under T - T_c.
    late = time > 0.6
    assert motion.M_f[late] == pytest.approx(0.02, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("nominal", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_energy_falls_by_damping_and_friction(law: str, nominal: JoystickParameters) -> None:
    joystick = nominal.replace(LAWS[law])
    time = np.linspace(0.0, 0.3, 3001)
    motion = simulate(joystick, time=time, theta_start=-0.3)
    lost = cumulative_simpson((motion.M_d + motion.M_f) * motion.omega, x=time, initial=0.0)
    # The sum over samples is rough where C jumps or is steep, in the middle; friction is some 5 % or more.
    assert np.abs(motion.E - motion.E[0] + lost).max() < 3e-3 * lost[-1]
    assert (motion.M_f * motion.omega >= 0.0).all()


@pytest.mark.parametrize("law", LAWS)
def test_it_comes_to_rest_anywhere_in_a_band_and_stays(law: str) -> None:
    joystick = NOMINAL.replace(LAWS[law])
    rests = []
    for start in (0.05, 0.11, 0.2):
        motion = simulate(joystick, time=[0.0, 5.0, 1e6], theta_start=float(start))
        assert _kinds(motion) == ["sticks"]
        rests.append(motion.theta[-1])
        assert motion.theta[1] == motion.theta[2] == motion.events[-1].theta
        assert abs(motion.M_f[-1]) <= static_friction(joystick, motion.theta[-1])
        assert motion.M_f[-1] == motion.M_g[-1] - motion.M_s[-1]
    assert np.ptp(rests) > 1e-5


def test_a_hundredfold_tighter_tolerance_changes_nothing_that_counts() -> None:
    joystick = NOMINAL.replace(LAWS["Stribeck"])
    runs = [
        simulate(
            joystick,
            time=TIME[:800],
            theta_start=0.3,
            torque=lambda time: math.sin(20.0 * time),
            tolerance=tolerance,
        )
        for tolerance in (1e-13, 1e-15)
    ]
    assert np.abs(runs[0].theta - runs[1].theta).max() < 1e-10
    assert _kinds(runs[0]) == _kinds(runs[1])


def test_sticking_and_slipping_alternate() -> None:
    joystick = NOMINAL.replace({"friction.T_c": 0.3})
    motion = simulate(joystick, time=TIME, theta_start=0.0, torque=lambda time: 2.0 * math.sin(9.0 * time))
    kinds = _kinds(motion)
    assert kinds.count("slips") >= 3
    assert all(a != b for a, b in pairwise(kinds))


def test_friction_of_the_plungers_follows_the_lever_of_the_contact() -> None:
    joystick = NOMINAL.replace({"friction.F_c": 0.3})
    theta = np.array([-0.3, -0.001, 0.0, 0.001, 0.2])
    expected = 0.3 * np.abs(contact_travel_slope(joystick, theta)) * np.array([1, 0, 0, 0, 1])
    assert sliding_friction(joystick, theta, np.ones(5)) == pytest.approx(expected, rel=1e-14)
    assert 0.3 * joystick.a == pytest.approx(0.0072, rel=1e-2)


def test_the_torque_of_a_motion_has_friction_and_at_rest_a_band() -> None:
    joystick = NOMINAL.replace(LAWS["Stribeck"])
    theta, omega = np.array([0.2, 0.2, 0.2]), np.array([-1.0, 0.0, 2.0])
    found, plain = inverse_torque(joystick, theta, omega, 0.0), inverse_torque(NOMINAL, theta, omega, 0.0)
    magnitude = sliding_friction(joystick, theta, omega)
    assert found.T_friction == pytest.approx(np.array([-1.0, 0.0, 1.0]) * magnitude)
    assert found.T - found.T_friction == pytest.approx(plain.T, abs=1e-15)
    assert found.T_band == pytest.approx([0.0, static_friction(joystick, 0.2), 0.0])


def test_the_papers_integrator_has_no_friction() -> None:
    with pytest.raises(ParameterError, match="the paper's integrator has no dry friction"):
        simulate_rk4(BARE, duration=0.1, theta_start=0.1)


@pytest.mark.parametrize("height", [1.001, 1.0 + 1e-7])
def test_a_peak_that_hardly_exceeds_the_bound_is_found(height: float) -> None:
    when = first_excess(lambda time: height * math.sin(time), 1.0, 0.0, 10.0, 0.05)
    assert when == pytest.approx(math.asin(1.0 / height), rel=1e-9)


def test_a_bound_that_is_not_exceeded() -> None:
    assert first_excess(math.sin, 1.0, 0.0, 10.0, 0.05) is None
    assert first_excess(lambda time: 1.0, 1.0, 0.0, 10.0, 0.1) is None


def test_a_jump_of_the_torque_is_located_though_it_is_not_announced() -> None:
    assert first_excess(lambda time: float(time > 0.7), 0.5, 0.0, 1.0, 0.05) == math.nextafter(0.7, 1.0)
