"""Torque required for a given motion, eq. (13)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.moments import (
    contact_moment,
    damping_coefficient,
    gravity_moment,
    sliding_friction,
    static_friction,
)
from pyjoystick.support import FloatArray, ParameterError


def require_within_stops(joystick: JoystickParameters, theta: ArrayLike) -> None:
    """Raise `ParameterError` if some angle (rad) is beyond a stop, where eq. (13) does not hold."""
    farthest = float(np.nanmax(np.abs(theta), initial=0.0))
    if joystick.stops and farthest > joystick.stops.theta_stop:
        allowed = f"within the stops at {joystick.stops.theta_stop:.6g} rad"
        raise ParameterError("theta", farthest, allowed)


@dataclass(frozen=True, slots=True, eq=False)
class InverseTorque:
    """The driving torque about the pivot and its parts (N m), arrays of one shape; T is the sum of the parts.

    Attributes:
        T: driving torque, eq. (13)
        T_inertia: J*alpha
        T_damping: C(theta, omega)*omega
        T_stiffness: M_s - m*g*h*sin(theta)
        T_friction: dry friction, sign(omega) times its magnitude; 0 at rest
        T_band: at rest, the largest deviation from T, to either side, that friction balances; 0 in motion
    """

    T: FloatArray
    T_inertia: FloatArray
    T_damping: FloatArray
    T_stiffness: FloatArray
    T_friction: FloatArray
    T_band: FloatArray


def inverse_torque(
    joystick: JoystickParameters, theta: ArrayLike, omega: ArrayLike, alpha: ArrayLike
) -> InverseTorque:
    """Compute eq. (13) with dry friction: T = J*alpha + C*omega + M_s - m*g*h*sin(theta) + M_f.

    Args:
        joystick: parameters of the joystick
        theta: angle (rad), |theta| < pi/2
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2); the three may have any broadcastable shapes, NaN gives NaN

    Raises:
        ParameterError: some |theta| >= pi/2, or beyond a stop
    """
    angle, rate, acceleration = np.broadcast_arrays(
        *(np.asarray(series, np.float64) for series in (theta, omega, alpha))
    )
    require_within_stops(joystick, angle)
    inertia = joystick.J * acceleration
    damping = damping_coefficient(joystick.damping, angle, rate) * rate
    stiffness = contact_moment(joystick, angle) - gravity_moment(joystick, angle)
    friction = band = np.zeros_like(inertia)
    whole = inertia + damping + stiffness
    if joystick.friction:
        friction = np.sign(rate) * sliding_friction(joystick, angle, rate)
        band = np.where(rate == 0.0, static_friction(joystick, angle), 0.0)
        whole = whole + friction
    return InverseTorque(whole, inertia, damping, stiffness, friction, band)
