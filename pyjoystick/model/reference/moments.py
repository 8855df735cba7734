"""Moments about the pivot and energy, eqs. (1), (5) corrected, (11) and Fig. 12, as functions of the motion.

Every function takes arrays of any broadcastable shape in SI units and returns that shape; NaN gives NaN.
Angles with |theta| >= pi/2 raise ParameterError.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.damping import ConstantDamping, Damping
from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.cam import contact_travel
from pyjoystick.model.reference.springs import assembly_energy, assembly_force
from pyjoystick.support import FloatArray


def contact_force(parameters: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Force f_x (N) on the actuator that resists theta (rad): forward for theta > 0, else backward."""
    x = contact_travel(parameters, theta)
    forward = assembly_force(parameters.forward, x)
    return np.where(np.asarray(theta) >= 0.0, forward, assembly_force(parameters.backward, x))


def contact_moment(parameters: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Moment M_s (N m) of the contact force at theta (rad): (a*sign(theta) + d*tan(theta))*f_x, d = x - b.

    Eq. (5) as printed has a*d*tan(theta), a product of two lengths; the sum of moments about the pivot,
    eq. (4), gives the form used here, which equals f_x*dx/dtheta.
    """
    angle = np.asarray(theta, dtype=np.float64)
    arm_of_horizontal_force = contact_travel(parameters, angle) - parameters.b
    lever = parameters.a * np.sign(angle) + arm_of_horizontal_force * np.tan(angle)
    return np.asarray(lever * contact_force(parameters, angle))


def gravity_moment(parameters: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Moment M_g = m*g*h*sin(theta) (N m) at theta (rad); it drives the joystick away from the middle."""
    return np.asarray(parameters.m * parameters.g * parameters.h * np.sin(theta))


def damping_coefficient(damping: Damping, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Damping coefficient C (N m s/rad) at theta (rad) and omega (rad/s): constant, or eq. (11).

    The displacement term of eq. (11) takes the coefficients of positive theta for theta >= 0.
    """
    angle, rate = np.broadcast_arrays(np.asarray(theta, np.float64), np.asarray(omega, np.float64))
    if isinstance(damping, ConstantDamping):
        return np.where(np.isnan(angle) | np.isnan(rate), np.nan, damping.C)
    squared_angle = angle**2 + damping.eps_theta**2
    squared_rate = rate**2 + damping.eps_omega**2
    ahead = damping.A_pos * squared_angle ** (damping.n_pos / 2.0)
    behind = damping.A_neg * squared_angle ** (damping.n_neg / 2.0)
    of_angle = np.where(angle >= 0.0, ahead, behind)
    of_rate = damping.B * squared_rate ** (damping.m / 2.0)
    return np.asarray(damping.alpha * of_angle + damping.beta * of_rate)


def energy(parameters: JoystickParameters, theta: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Energy of Fig. 12 (J): J*omega^2/2 + integral of f_x dx + m*g*h*(cos(theta) - 1)."""
    angle, rate = np.asarray(theta, np.float64), np.asarray(omega, np.float64)
    x = contact_travel(parameters, angle)
    forward = assembly_energy(parameters.forward, x)
    stored = np.where(angle >= 0.0, forward, assembly_energy(parameters.backward, x))
    kinetic = 0.5 * parameters.J * rate**2
    lifted = -2.0 * parameters.m * parameters.g * parameters.h * np.sin(angle / 2.0) ** 2
    return np.asarray(kinetic + stored + lifted)


def swing_frequency(parameters: JoystickParameters) -> float:
    """Section 3.2: frequency (Hz) of small swings upside down and out of contact, sqrt(m*g*h/J)/(2*pi)."""
    return math.sqrt(parameters.m * abs(parameters.g) * parameters.h / parameters.J) / (2.0 * math.pi)
