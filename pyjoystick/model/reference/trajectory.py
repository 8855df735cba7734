"""Result of a run: the motion at the requested instants, and the quantities that follow from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.integration import Event, TurningPoint
from pyjoystick.model.reference.moments import (
    contact_force,
    contact_moment,
    contact_travel,
    damping_coefficient,
    energy,
    gravity_moment,
    sliding_friction,
    stop_moment,
)
from pyjoystick.support import FloatArray, Torque


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trajectory:
    """A motion of the joystick; every array has the shape (n,) of `time`.

    Attributes:
        time: instants (s)
        theta: angle (rad), positive forward
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2), from eq. (1)
        x: contact travel (m)
        f_x: contact force (N)
        M_s: contact moment (N m)
        M_d: damping moment C*omega (N m)
        M_g: gravity moment m*g*h*sin(theta) (N m)
        C: damping coefficient (N m s/rad)
        E: energy (J)
        T: driving torque (N m)
        M_f: dry friction moment (N m)
        M_stop: moment of a stop, against positive angles (N m)
        is_stuck: True while dry friction holds the joystick
        events: events, such as passages of kinks and of the middle, in order; empty if the method does not
            locate them
        turning_points: sign changes of omega, in order; empty if the method does not locate them
        accepted, rejected: numbers of accepted and rejected integration steps
    """

    time: FloatArray
    theta: FloatArray
    omega: FloatArray
    alpha: FloatArray
    x: FloatArray
    f_x: FloatArray
    M_s: FloatArray
    M_d: FloatArray
    M_g: FloatArray
    C: FloatArray
    E: FloatArray
    T: FloatArray
    M_f: FloatArray
    M_stop: FloatArray
    is_stuck: NDArray[np.bool_]
    events: tuple[Event, ...] = ()
    turning_points: tuple[TurningPoint, ...] = ()
    accepted: int = 0
    rejected: int = 0


def trajectory(
    joystick: JoystickParameters,
    time: FloatArray,
    theta: FloatArray,
    omega: FloatArray,
    torque: Torque | None,
    mode: FloatArray | None = None,
    *,
    events: tuple[Event, ...] = (),
    turning_points: tuple[TurningPoint, ...] = (),
    accepted: int = 0,
    rejected: int = 0,
) -> Trajectory:
    """Return the trajectory of a computed motion: time (s), theta (rad) and omega (rad/s), all of shape (n,).

    With dry friction, `mode` is 1 or -1 while the joystick slides forward or backward, 0 while it sticks.
    """
    driving = np.zeros_like(time) if torque is None else np.array([torque(float(t)) for t in time])
    coefficient = damping_coefficient(joystick.damping, theta, omega)
    contact, weight = contact_moment(joystick, theta), gravity_moment(joystick, theta)
    damping = coefficient * omega
    stop = stop_moment(joystick, theta, omega)
    others = driving + weight - contact - damping - stop
    friction, is_stuck = np.zeros_like(others), np.zeros(others.shape, dtype=np.bool_)
    if joystick.friction and mode is not None:
        is_stuck = mode == 0.0
        friction = np.where(is_stuck, others, mode * sliding_friction(joystick, theta, omega))
    return Trajectory(
        time=time,
        theta=theta,
        omega=omega,
        alpha=(others - friction) / joystick.J,
        x=contact_travel(joystick, theta),
        f_x=contact_force(joystick, theta),
        M_s=contact,
        M_d=damping,
        M_g=weight,
        C=coefficient,
        E=energy(joystick, theta, omega),
        T=driving,
        M_f=friction,
        M_stop=stop,
        is_stuck=is_stuck,
        events=events,
        turning_points=turning_points,
        accepted=accepted,
        rejected=rejected,
    )
