"""Identities of geometry, springs, moments and energy that hold for all parameters."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from pyjoystick.model import (
    BACKWARD_TABLE,
    FORWARD_TABLE,
    NOMINAL,
    NOMINAL_POWER_LAW,
    ActuatorAssembly,
    ConstantDamping,
    JoystickParameters,
    RestrainedSpring,
    SegmentTable,
    angle_of_travel,
    assembly_energy,
    assembly_force,
    contact_force,
    contact_moment,
    contact_travel,
    contact_travel_slope,
    damping_coefficient,
    energy,
    gravity_moment,
    inverse_torque,
    spring_energy,
    spring_force,
    swing_frequency,
    table_force,
)
from pyjoystick.support import FloatArray, ParameterError
from tests.pyjoystick.random_parameters import random_cases

CAM_ANGLES = np.linspace(-1.5, 1.5, 601)
CAM_JOYSTICKS = [NOMINAL, *(case.parameters for case in random_cases(NOMINAL, 5))]


@pytest.mark.parametrize("parameters", CAM_JOYSTICKS)
def test_both_components_of_the_contact_point_agree(parameters: JoystickParameters) -> None:
    """Eqs. (2a, b) with the mirrored geometry for theta < 0: one length r satisfies both."""
    angle = np.abs(CAM_ANGLES)
    x = contact_travel(parameters, CAM_ANGLES)
    r_from_2a = (parameters.a - parameters.b * np.sin(angle)) / np.cos(angle)
    r_sine_from_2b = x - parameters.b + parameters.b * np.cos(angle)
    np.testing.assert_allclose(r_from_2a * np.sin(angle), r_sine_from_2b, rtol=1e-12, atol=1e-17)


def test_travel_is_eq_3_and_keeps_its_digits_near_zero() -> None:
    expected = NOMINAL.a * np.abs(np.tan(CAM_ANGLES)) + NOMINAL.b * (1.0 - 1.0 / np.cos(CAM_ANGLES))
    np.testing.assert_allclose(contact_travel(NOMINAL, CAM_ANGLES), expected, rtol=1e-13, atol=1e-17)
    tiny = np.array([1e-12, 1e-9, 1e-6])
    series = NOMINAL.a * (tiny + tiny**3 / 3.0) - NOMINAL.b * tiny**2 / 2.0
    np.testing.assert_allclose(contact_travel(NOMINAL, -tiny), series, rtol=1e-15)


def test_travel_at_the_stops_is_inside_the_last_segment() -> None:
    travel = contact_travel(NOMINAL, math.radians(20.0))
    assert NOMINAL.forward.kinks[3] < travel < 0.009


@pytest.mark.parametrize("parameters", CAM_JOYSTICKS)
def test_slope_is_the_derivative_of_travel(parameters: JoystickParameters) -> None:
    """Against a central difference of the sixth order, away from the corner at zero."""
    angles = CAM_ANGLES[np.abs(CAM_ANGLES) > 0.02]
    h = 2e-3
    weights = {1: 45.0 / 60.0, 2: -9.0 / 60.0, 3: 1.0 / 60.0}
    inner = angles[np.abs(angles) < 1.3]
    difference = sum(
        weight * (contact_travel(parameters, inner + i * h) - contact_travel(parameters, inner - i * h))
        for i, weight in weights.items()
    )
    np.testing.assert_allclose(contact_travel_slope(parameters, inner), difference / h, rtol=1e-9)


def test_slope_jumps_from_minus_a_to_a_at_zero() -> None:
    np.testing.assert_allclose(
        contact_travel_slope(NOMINAL, [-1e-300, 0.0, 1e-300]), [-NOMINAL.a, 0.0, NOMINAL.a]
    )


@pytest.mark.parametrize("parameters", CAM_JOYSTICKS)
@pytest.mark.parametrize("x", [0.0, 1e-12, 75e-6, 3e-3, 9e-3, 0.1, 10.0])
def test_angle_of_travel_inverts_travel(parameters: JoystickParameters, x: float) -> None:
    angle = angle_of_travel(parameters, x)
    assert 0.0 <= angle < math.pi / 2.0
    assert float(contact_travel(parameters, angle)) == pytest.approx(x, rel=1e-12, abs=1e-300)


def test_angles_beyond_the_geometry_are_refused_and_nan_passes() -> None:
    with pytest.raises(ParameterError, match=r"theta = -20\.0: .* -20 degrees are -0\.349066 rad"):
        contact_travel(NOMINAL, [0.1, -20.0, 30.0])
    with pytest.raises(ParameterError, match="theta = inf"):
        contact_travel_slope(NOMINAL, math.inf)
    for function in (contact_travel, contact_travel_slope, contact_moment, energy):
        arguments = (0.0,) if function is energy else ()
        for sign in (-1.0, 1.0):
            with pytest.raises(ParameterError, match=r"theta = -?1\.57079"):
                function(NOMINAL, sign * math.pi / 2.0, *arguments)
            inside = function(NOMINAL, sign * math.nextafter(math.pi / 2.0, 0.0), *arguments)
            assert np.all(np.isfinite(inside))
    assert np.isnan(contact_travel(NOMINAL, [0.1, math.nan])).tolist() == [False, True]


SPRING = NOMINAL.forward.return_spring
RANDOM = [case.parameters for case in random_cases(NOMINAL, 25)]
RANDOM_ASSEMBLIES = [assembly for joystick in RANDOM for assembly in (joystick.forward, joystick.backward)]


def around_kinks(assembly: ActuatorAssembly) -> FloatArray:
    """Travels from 0 to 10 mm, with every kink and points from rounding to a thousandth beside it."""
    kinks = np.array(assembly.kinks)
    beside = [kinks * (1.0 + part) for part in (-1e-3, -1e-9, -2e-16, 0.0, 2e-16, 1e-9, 1e-3)]
    return np.sort(np.concatenate([np.linspace(0.0, 0.01, 501), *beside]))


def test_contact_spring_and_restraint_are_in_equilibrium() -> None:
    """Eq. (6): f_spring = f_x + f_restraint; the spring carries k_s*(x_so + delta)."""
    x = around_kinks(NOMINAL.forward)
    compression = np.maximum(x - SPRING.x_0, 0.0)
    in_spring = SPRING.F_0 + SPRING.k_s * compression
    in_restraint = np.maximum(SPRING.F_0 - SPRING.k_h * compression, 0.0)
    np.testing.assert_allclose(spring_force(SPRING, x), in_spring - in_restraint, rtol=1e-12, atol=1e-12)


def test_nothing_is_felt_before_contact_and_a_kink_is_no_jump() -> None:
    assert spring_force(SPRING, [-1.0, 0.0, SPRING.x_0]).tolist() == [0.0, 0.0, 0.0]
    for kink in (SPRING.x_0, SPRING.x_release):
        below, above = spring_force(SPRING, [kink * (1.0 - 1e-12), kink * (1.0 + 1e-12)])
        assert above - below == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("assembly", RANDOM_ASSEMBLIES)
def test_an_assembly_of_springs_equals_its_table(assembly: ActuatorAssembly) -> None:
    x = around_kinks(assembly)
    by_springs = assembly_force(assembly, x)
    by_table = table_force(assembly.to_table(), x)
    # Where the force has only just left zero its digits are those of x - x_0, so they count against k_0*x_0.
    floor = 1e-12 * assembly.to_table().k[0] * assembly.kinks[0]
    np.testing.assert_allclose(by_springs, by_table, rtol=1e-12, atol=floor)


@pytest.mark.parametrize(
    ("assembly", "table"), [(NOMINAL.forward, FORWARD_TABLE), (NOMINAL.backward, BACKWARD_TABLE)]
)
def test_the_papers_table_gives_the_same_force_as_its_springs(
    assembly: ActuatorAssembly, table: SegmentTable
) -> None:
    x = np.linspace(0.0, 0.01, 1001)
    np.testing.assert_allclose(assembly_force(assembly, x), table_force(table, x), rtol=1e-12, atol=1e-12)


def test_a_table_may_have_any_number_of_segments() -> None:
    one = SegmentTable((1e-3,), (2000.0,))
    np.testing.assert_allclose(table_force(one, [0.0, 1e-3, 3e-3]), [0.0, 0.0, 4.0], rtol=1e-15)
    five = SegmentTable((0.0, 1.0, 2.0, 3.0, 4.0), (1.0, 2.0, 3.0, 4.0, 5.0))
    np.testing.assert_allclose(table_force(five, [-1.0, 0.5, 1.5, 4.0, 5.0]), [0.0, 0.5, 2.0, 10.0, 15.0])


@pytest.mark.parametrize("assembly", [NOMINAL.forward, NOMINAL.backward, *RANDOM_ASSEMBLIES[:4]])
def test_energy_is_the_integral_of_force(assembly: ActuatorAssembly) -> None:
    for x in (0.5 * assembly.kinks[0], *assembly.kinks, 1e-4, 2e-3, 8e-3):
        integral, _ = quad(
            lambda travel: float(assembly_force(assembly, travel)),
            0.0,
            x,
            points=assembly.kinks,
            epsabs=1e-15,
        )
        assert float(assembly_energy(assembly, x)) == pytest.approx(integral, rel=1e-12, abs=1e-17)


def test_a_spring_without_preload_or_restraint_effect_is_linear() -> None:
    plain = RestrainedSpring(k_s=1000.0, k_h=1e6, F_0=0.0, x_0=0.0)
    x = np.linspace(0.0, 0.01, 11)
    np.testing.assert_allclose(spring_force(plain, x), 1000.0 * x, rtol=1e-15)
    np.testing.assert_allclose(spring_energy(plain, x), 500.0 * x**2, rtol=1e-15)


def test_shapes_and_nan_pass_through() -> None:
    x = np.array([[1e-3, np.nan], [2e-3, 0.0]])
    force = assembly_force(NOMINAL.forward, x)
    assert force.shape == (2, 2)
    assert np.isnan(force).tolist() == [[False, True], [False, False]]
    assert np.isnan(table_force(FORWARD_TABLE, x)).tolist() == [[False, True], [False, False]]


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
