"""Moments and energy against what they must satisfy, whatever the parameters."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    ConstantDamping,
    JoystickParameters,
    contact_force,
    contact_moment,
    contact_travel,
    contact_travel_slope,
    damping_coefficient,
    energy,
    gravity_moment,
    inverse_torque,
    swing_frequency,
)
from pyjoystick.support import ParameterError
from tests.pyjoystick.random_parameters import random_cases

JOYSTICKS = [NOMINAL, *(case.parameters for case in random_cases(NOMINAL, 25))]
ANGLES = np.concatenate([np.linspace(-1.2, 1.2, 481), [1e-3, -1e-3, 3.2e-3, -3.2e-3, 1e-9]])


@pytest.mark.parametrize("parameters", JOYSTICKS)
def test_contact_moment_is_conservative(parameters: JoystickParameters) -> None:
    """M_s = f_x*dx/dtheta: the work of the moment is the work of the force."""
    expected = contact_force(parameters, ANGLES) * contact_travel_slope(parameters, ANGLES)
    np.testing.assert_allclose(contact_moment(parameters, ANGLES), expected, rtol=1e-12)


def test_eq_5_as_printed_is_not_conservative() -> None:
    """{a*(sign(theta) + d*tan(theta))}*f_x adds a length to a number; at 20 degrees it is off by percents."""
    theta = np.radians([-20.0, 20.0])
    force = contact_force(NOMINAL, theta)
    d = contact_travel(NOMINAL, theta) - NOMINAL.b
    printed = NOMINAL.a * (np.sign(theta) + d * np.tan(theta)) * force
    expected = force * contact_travel_slope(NOMINAL, theta)
    assert np.all(np.abs(printed / expected - 1.0) > 0.01)
    np.testing.assert_allclose(contact_moment(NOMINAL, theta), expected, rtol=1e-12)


def test_each_side_feels_its_own_actuator() -> None:
    mirrored = NOMINAL.replace({"backward.returnSpring.k_s": 2.0 * NOMINAL.backward.return_spring.k_s})
    np.testing.assert_array_equal(contact_moment(mirrored, [0.1, 0.0]), contact_moment(NOMINAL, [0.1, 0.0]))
    assert contact_moment(mirrored, -0.1) < contact_moment(NOMINAL, -0.1) < 0.0
    assert contact_moment(NOMINAL, 0.0) == 0.0


@pytest.mark.parametrize("parameters", JOYSTICKS[:5])
def test_energy_falls_by_the_work_of_the_moments(parameters: JoystickParameters) -> None:
    """-dE/dtheta at constant omega is M_g - M_s, and dE/domega is J*omega."""
    theta = np.linspace(-0.35, 0.35, 71) + 1e-4
    h = 1e-6
    slope = (energy(parameters, theta + h, 3.0) - energy(parameters, theta - h, 3.0)) / (2.0 * h)
    moment = gravity_moment(parameters, theta) - contact_moment(parameters, theta)
    # A kink within h of a point makes the difference a mean of two slopes: good to k*a^2*h.
    np.testing.assert_allclose(-slope, moment, atol=1e6 * parameters.a**2 * h, rtol=1e-6)
    kinetic = energy(parameters, theta, 3.0) - energy(parameters, theta, 0.0)
    np.testing.assert_allclose(kinetic, 4.5 * parameters.J, rtol=1e-12)


def test_energy_is_zero_at_rest_in_the_middle() -> None:
    assert energy(NOMINAL, 0.0, 0.0) == 0.0
    assert energy(NOMINAL, -1e-3, 0.0) < 0.0  # in the clearance only gravity acts


def test_constant_damping_fills_the_shape_of_the_motion() -> None:
    np.testing.assert_array_equal(
        damping_coefficient(ConstantDamping(C=0.05), [[0.1], [0.2]], [1.0, 2.0]), 0.05
    )


def test_power_law_by_hand_far_from_zero() -> None:
    law = NOMINAL_POWER_LAW.damping
    forward = 0.9 * 0.086 * 0.2**0.084 + 0.1 * 0.051 * 5.0**-0.26
    backward = 0.9 * 0.032 * 0.2**-0.23 + 0.1 * 0.051 * 5.0**-0.26
    # Rounding off changes |theta| by eps^2/(2*theta^2) = 1.25e-7 of itself, and C by a quarter of that.
    np.testing.assert_allclose(
        damping_coefficient(law, [0.2, -0.2], [-5.0, 5.0]), [forward, backward], rtol=1e-7
    )


def test_power_law_at_zero_is_finite() -> None:
    law = NOMINAL_POWER_LAW.replace({"damping.alpha": 0.5}).damping
    expected = 0.5 * 0.086 * 1e-4**0.084 + 0.5 * 0.051 * 1e-3**-0.26
    assert damping_coefficient(law, 0.0, 0.0) == pytest.approx(expected, rel=1e-14)


def test_damping_of_the_two_laws_at_typical_motion_is_alike() -> None:
    """Section 4: C = 0.045 approximates an average of eq. (11)."""
    theta, omega = np.meshgrid(np.linspace(-0.3, 0.3, 31), np.linspace(-6.0, 6.0, 31))
    mean = float(np.mean(damping_coefficient(NOMINAL_POWER_LAW.damping, theta, omega)))
    assert 0.03 < mean < 0.09


def test_swing_frequency_of_table_2() -> None:
    assert swing_frequency(NOMINAL) == pytest.approx(1.25, abs=0.01)
    frequency = swing_frequency(NOMINAL)
    inertia = NOMINAL.m * NOMINAL.g * NOMINAL.h / (2.0 * math.pi * frequency) ** 2
    assert inertia == pytest.approx(NOMINAL.J, rel=1e-14)


def test_inverse_torque_is_the_sum_of_its_parts() -> None:
    theta, omega, alpha = np.array([0.1, -0.2, 0.0]), np.array([1.0, -3.0, 0.0]), np.array([5.0, 50.0, 0.0])
    torque = inverse_torque(NOMINAL, theta, omega, alpha)
    np.testing.assert_array_equal(torque.T, torque.T_inertia + torque.T_damping + torque.T_stiffness)
    np.testing.assert_allclose(torque.T_inertia, 0.01135 * alpha, rtol=1e-15)
    np.testing.assert_allclose(torque.T_damping, 0.045 * omega, rtol=1e-15)
    # By hand at 0.1 rad: x = a*tan + b*(1 - 1/cos), f = F_0 + k_s*(x - x_0), lever a + (x - b)*tan.
    x = 0.02398 * math.tan(0.1) + 0.005 * (1.0 - 1.0 / math.cos(0.1))
    force = 427375.0 * 0.1235e-3 + 2625.0 * (x - 0.075e-3)
    contact = (0.02398 + (x - 0.005) * math.tan(0.1)) * force
    assert torque.T_stiffness[0] == pytest.approx(contact - 0.87 * 9.80665 * 0.082 * math.sin(0.1), rel=1e-13)
    assert torque.T[2] == 0.0


def test_inverse_torque_broadcasts_passes_nan_and_refuses_degrees() -> None:
    torque = inverse_torque(NOMINAL, [0.1, math.nan], 0.0, [[0.0], [1.0]])
    assert torque.T.shape == torque.T_damping.shape == (2, 2)
    assert np.isnan(torque.T).tolist() == [[False, True], [False, True]]
    with pytest.raises(ParameterError, match="degrees"):
        inverse_torque(NOMINAL, [15.0], [0.0], [0.0])
