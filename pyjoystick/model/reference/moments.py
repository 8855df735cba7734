"""Geometry, springs, moments and energy of a given motion: eqs. (1), (3), (5) as corrected, (6)-(8), (11).

Every function takes arrays of any broadcastable shapes in SI units and returns the common shape; NaN gives
NaN. Angles with |theta| >= pi/2 raise ParameterError.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.joystick import ConstantDamping, Damping, Friction, JoystickParameters
from pyjoystick.model.parameters.springs import ActuatorAssembly, RestrainedSpring, SegmentTable
from pyjoystick.support import FloatArray, angle


def contact_travel(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the travel of the contact point, eq. (3): x = a*|tan(theta)| + b*(1 - 1/cos(theta)).

    With t = tan(|theta|/2), this is 2*t*(a - b*t)/(1 - t^2), which has no cancellation near theta = 0.

    Args:
        joystick: the joystick
        theta: angle (rad), any shape, |theta| < pi/2; NaN gives NaN

    Returns:
        x (m), 0 or more, same shape

    Raises:
        ParameterError: some |theta| >= pi/2
    """
    t = np.tan(np.abs(_checked(theta)) / 2.0)
    return np.asarray(2.0 * t * (joystick.a - joystick.b * t) / ((1.0 - t) * (1.0 + t)))


def contact_travel_slope(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the derivative of eq. (3): dx/dtheta = (a*sign(theta) - b*sin(theta))/cos(theta)^2.

    Args:
        joystick: the joystick
        theta: angle (rad), any shape, |theta| < pi/2; NaN gives NaN

    Returns:
        dx/dtheta (m/rad), same shape; 0 at theta = 0, halfway between the one-sided slopes -a and a

    Raises:
        ParameterError: some |theta| >= pi/2
    """
    theta = _checked(theta)
    return np.asarray((joystick.a * np.sign(theta) - joystick.b * np.sin(theta)) / np.cos(theta) ** 2)


def angle_of_travel(joystick: JoystickParameters, x: float) -> float:
    """Compute the angle |theta| (rad) at which the contact travel is x (m): the inverse of eq. (3).

    In t = tan(theta/2), eq. (3) is (2*b - x)*t^2 - 2*a*t + x = 0. The root that vanishes with x is used in
    the form without cancellation. The angle is real and below pi/2 for every x >= 0 because b < a.
    """
    a, b = joystick.a, joystick.b
    return 2.0 * math.atan(x / (a + math.sqrt(a * a - x * (2.0 * b - x))))


def _checked(theta: ArrayLike) -> FloatArray:
    angles = np.asarray(theta, dtype=np.float64)
    for value in angles[np.abs(angles) >= np.pi / 2.0][:1]:
        angle("theta", value)
    return angles


def spring_force(spring: RestrainedSpring, x: ArrayLike) -> FloatArray:
    """Compute the force (N) of one restrained spring at travel x (m, any shape), same shape: eqs. (6)-(8)."""
    compression = np.asarray(x, dtype=np.float64) - spring.x_0
    restrained = (spring.k_h + spring.k_s) * compression
    released = spring.F_0 + spring.k_s * compression
    force = np.where(spring.k_h * compression <= spring.F_0, restrained, released)
    return np.where(compression <= 0.0, 0.0, force)


def spring_energy(spring: RestrainedSpring, x: ArrayLike) -> FloatArray:
    """Compute the energy (J) of one restrained spring at travel x (m), same shape: integral of its force."""
    compression = np.asarray(x, dtype=np.float64) - spring.x_0
    restrained = 0.5 * (spring.k_h + spring.k_s) * compression**2
    # The restraint releases F_0^2/(2*k_h) while it goes slack.
    released = (spring.F_0 + 0.5 * spring.k_s * compression) * compression - 0.5 * spring.F_0**2 / spring.k_h
    energy = np.where(spring.k_h * compression <= spring.F_0, restrained, released)
    return np.where(compression <= 0.0, 0.0, energy)


def assembly_force(assembly: ActuatorAssembly, x: ArrayLike) -> FloatArray:
    """Compute the force (N) of return and balance spring in parallel (Fig. 7) at travel x (m), same shape."""
    return spring_force(assembly.return_spring, x) + spring_force(assembly.balance_spring, x)


def assembly_energy(assembly: ActuatorAssembly, x: ArrayLike) -> FloatArray:
    """Compute the energy (J) stored in an assembly at travel x (m), same shape: the integral of its force."""
    return spring_energy(assembly.return_spring, x) + spring_energy(assembly.balance_spring, x)


def table_force(table: SegmentTable, x: ArrayLike) -> FloatArray:
    """Compute the force (N) of a curve of straight segments (Fig. 7c) at contact travel x (m), same shape."""
    travel = np.asarray(x, dtype=np.float64)
    starts, stiffnesses = np.asarray(table.x), np.asarray(table.k)
    at_start = np.concatenate(([0.0], np.cumsum(stiffnesses[:-1] * np.diff(starts))))
    segment = np.maximum(np.searchsorted(starts, travel, side="right") - 1, 0)
    force = at_start[segment] + stiffnesses[segment] * (travel - starts[segment])
    return np.where(travel <= starts[0], 0.0, force)


def contact_force(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the force f_x (N) on the actuator that resists theta (rad).

    This is the forward actuator for theta > 0, else the backward one.
    """
    x = contact_travel(joystick, theta)
    forward = assembly_force(joystick.forward, x)
    return np.where(np.asarray(theta) >= 0.0, forward, assembly_force(joystick.backward, x))


def contact_moment(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the moment M_s (N m) of the contact force at theta (rad).

    It is (a*sign(theta) + d*tan(theta))*f_x with d = x - b. Eq. (5) as printed has a*d*tan(theta), a product
    of two lengths; the sum of moments about the pivot, eq. (4), gives the form used here, which equals
    f_x*dx/dtheta.
    """
    theta = np.asarray(theta, dtype=np.float64)
    arm_of_horizontal_force = contact_travel(joystick, theta) - joystick.b
    lever = joystick.a * np.sign(theta) + arm_of_horizontal_force * np.tan(theta)
    return np.asarray(lever * contact_force(joystick, theta))


def gravity_moment(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the gravity moment M_g = m*g*h*sin(theta) (N m) at theta (rad), away from the middle."""
    return np.asarray(joystick.m * joystick.g * joystick.h * np.sin(theta))


def damping_coefficient(damping: Damping, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Compute the damping coefficient C (N m s/rad) at theta (rad) and omega (rad/s): constant, or eq. (11).

    The displacement term of eq. (11) uses the coefficients of positive theta for theta >= 0.
    """
    position, rate = np.broadcast_arrays(np.asarray(theta, np.float64), np.asarray(omega, np.float64))
    if isinstance(damping, ConstantDamping):
        return np.where(np.isnan(position) | np.isnan(rate), np.nan, damping.C)
    squared_angle = position**2 + damping.eps_theta**2
    squared_rate = rate**2 + damping.eps_omega**2
    ahead = damping.A_pos * squared_angle ** (damping.n_pos / 2.0)
    behind = damping.A_neg * squared_angle ** (damping.n_neg / 2.0)
    of_angle = np.where(position >= 0.0, ahead, behind)
    of_rate = damping.B * squared_rate ** (damping.m / 2.0)
    return np.asarray(damping.alpha * of_angle + damping.beta * of_rate)


def sliding_friction(joystick: JoystickParameters, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Compute the magnitude (N m) of the dry friction moment while sliding, at theta (rad) and omega (rad/s).

    It is T_c + (T_s - T_c)*exp(-(omega/omega_s)^2) + F_c*|dx/dtheta|: Coulomb friction, Stribeck effect, and
    friction of the plunger in contact.
    """
    law = joystick.friction
    rate = np.asarray(omega, dtype=np.float64)
    return np.asarray(law.T_c + _static_excess(law, rate) + _plunger_friction(joystick, theta))


def static_friction(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute the largest dry friction moment (N m) while the joystick sticks at theta (rad), same shape."""
    return sliding_friction(joystick, theta, np.zeros_like(np.asarray(theta, dtype=np.float64)))


def _static_excess(law: Friction, omega: FloatArray) -> FloatArray:
    if law.T_s <= law.T_c:
        return np.zeros_like(omega)
    return np.asarray((law.T_s - law.T_c) * np.exp(-((omega / law.omega_s) ** 2)))


def _plunger_friction(joystick: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Compute F_c times the lever arm of the plunger in contact; zero within the clearance."""
    position = np.asarray(theta, dtype=np.float64)
    x = contact_travel(joystick, position)
    first = [side.return_spring.x_0 for side in (joystick.forward, joystick.backward)]
    in_contact = x > np.where(position >= 0.0, *first)
    lever = np.abs(contact_travel_slope(joystick, position))
    return np.where(in_contact, joystick.friction.F_c * lever, 0.0)


def stop_moment(joystick: JoystickParameters, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Compute the moment M_stop (N m) of a stop, against positive angles, at theta (rad) and omega (rad/s).

    sign(theta)*max(0, K*delta + D*sign(theta)*omega) if delta = |theta| - theta_stop is above 0, else 0.
    """
    law = joystick.stops
    position, rate = np.broadcast_arrays(np.asarray(theta, np.float64), np.asarray(omega, np.float64))
    if not law:
        return np.zeros_like(position)
    side = np.sign(position)
    delta = np.abs(position) - law.theta_stop
    push = law.K * delta + law.D * side * rate
    return np.where((delta > 0.0) & (push > 0.0), side * push, 0.0)


def energy(joystick: JoystickParameters, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Compute the energy (J) of Fig. 12, without that of stops.

    It is J*omega^2/2 + integral of f_x dx + m*g*h*(cos(theta) - 1).
    """
    position, rate = np.asarray(theta, np.float64), np.asarray(omega, np.float64)
    x = contact_travel(joystick, position)
    forward = assembly_energy(joystick.forward, x)
    stored = np.where(position >= 0.0, forward, assembly_energy(joystick.backward, x))
    kinetic = 0.5 * joystick.J * rate**2
    lifted = -2.0 * joystick.m * joystick.g * joystick.h * np.sin(position / 2.0) ** 2
    return np.asarray(kinetic + stored + lifted)


def swing_frequency(joystick: JoystickParameters) -> float:
    """Compute the frequency (Hz) of small swings upside down, out of contact (section 3.2).

    It is sqrt(m*g*h/J)/(2*pi).
    """
    return math.sqrt(joystick.m * abs(joystick.g) * joystick.h / joystick.J) / (2.0 * math.pi)
