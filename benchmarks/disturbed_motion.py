"""The joystick with effects that its model may lack: dry friction and stops.

Independent of the package's integrators: fixed steps of the classical Runge-Kutta method, short enough for
kinks to be harmless. A change of sign of the velocity is located within its step; there the joystick sticks,
or continues with reversed friction.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numba import njit

from pyjoystick.model import ConstantDamping, JoystickParameters
from pyjoystick.support import FloatArray

#: Longest step (s).
_STEP: Final = 4e-5


@dataclass(frozen=True, slots=True)
class Disturbance:
    """Effects in addition to eq. (1).

    Attributes:
        T_c: dry friction at the pivot (N m)
        F_c: dry friction along the plunger in contact (N); its lever is dx/dtheta
        stop: angle (rad) of an elastic stop on either side
        stop_stiffness: its stiffness (N m/rad)
    """

    T_c: float = 0.0
    F_c: float = 0.0
    stop: float = math.inf
    stop_stiffness: float = 60.0


def disturbed_motion(
    joystick: JoystickParameters,
    disturbance: Disturbance,
    *,
    time: FloatArray,
    theta_start: float,
    omega_start: float = 0.0,
    torque: FloatArray | None = None,
) -> FloatArray:
    """Return the angle (rad) at increasing times that begin at the release, shape (n,).

    Args:
        joystick: with constant or power-law damping
        disturbance: the additional effects
        time: times (s), shape (n,)
        theta_start: initial angle (rad)
        omega_start: initial velocity (rad/s)
        torque: driving torque (N m) at these times, linear in between, shape (n,)
    """
    law = joystick.damping
    damping = (
        np.array([law.C, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        if isinstance(law, ConstantDamping)
        else np.array(
            [
                *(0.0, law.alpha * law.A_pos, law.n_pos, law.alpha * law.A_neg, law.n_neg, law.beta * law.B),
                *(law.m, law.eps_theta, law.eps_omega),
            ]
        )
    )
    forward, backward = joystick.forward.to_table(), joystick.backward.to_table()
    curves = np.array([forward.x, forward.k, backward.x, backward.k])
    body = np.array([joystick.J, joystick.m * joystick.g * joystick.h, joystick.a, joystick.b])
    extra = np.array([disturbance.T_c, disturbance.F_c, disturbance.stop, disturbance.stop_stiffness])
    drive = np.zeros(len(time)) if torque is None else np.asarray(torque)
    return np.asarray(_integrated(time, theta_start, omega_start, drive, body, curves, damping, extra))


@njit(cache=True)  # type: ignore[untyped-decorator]
def _contact(theta: float, body: FloatArray, curves: FloatArray) -> tuple[float, float]:
    """The contact moment (N m) and the lever |dx/dtheta| (m), 0 within the clearance."""
    a, b = body[2], body[3]
    angle = abs(theta)
    x = a * math.tan(angle) + b * (1.0 - 1.0 / math.cos(angle))
    lever = (a - b * math.sin(angle)) / math.cos(angle) ** 2
    knots, slopes = (curves[0], curves[1]) if theta >= 0.0 else (curves[2], curves[3])
    force = 0.0
    for i in range(4):
        if x > knots[i]:
            end = min(x, knots[i + 1]) if i < 3 else x
            force += slopes[i] * (end - knots[i])
    side = 1.0 if theta >= 0.0 else -1.0
    return side * lever * force, lever if x > knots[0] else 0.0


@njit(cache=True)  # type: ignore[untyped-decorator]
def _moments(
    theta: float,
    omega: float,
    torque: float,
    body: FloatArray,
    curves: FloatArray,
    damping: FloatArray,
    extra: FloatArray,
) -> tuple[float, float]:
    """Return the moment without friction (N m), and the largest moment of friction (N m)."""
    contact, lever = _contact(theta, body, curves)
    coefficient = damping[0]
    if coefficient == 0.0:
        size = math.sqrt(theta**2 + damping[7] ** 2)
        own, power = (damping[1], damping[2]) if theta >= 0.0 else (damping[3], damping[4])
        coefficient = own * size**power + damping[5] * math.sqrt(omega**2 + damping[8] ** 2) ** damping[6]
    beyond = abs(theta) - extra[2]
    stop = math.copysign(extra[3] * beyond, theta) if beyond > 0.0 else 0.0
    moment = torque + body[1] * math.sin(theta) - contact - coefficient * omega - stop
    return moment, extra[0] + extra[1] * lever


@njit(cache=True)  # type: ignore[untyped-decorator]
def _integrated(
    time: FloatArray,
    theta: float,
    omega: float,
    drive: FloatArray,
    body: FloatArray,
    curves: FloatArray,
    damping: FloatArray,
    extra: FloatArray,
) -> FloatArray:
    found = np.empty(len(time))
    found[0] = theta
    for i in range(1, len(time)):
        span = time[i] - time[i - 1]
        slope = (drive[i] - drive[i - 1]) / span
        steps = math.ceil(span / _STEP)
        left = span
        length = span / steps
        while left > 1e-12:
            h = min(length, left)
            torque = drive[i] - slope * left
            if omega == 0.0:
                moment, friction = _moments(theta, 0.0, torque, body, curves, damping, extra)
                if abs(moment) <= friction:
                    left -= h
                    continue
                sign = 1.0 if moment > 0.0 else -1.0
            else:
                sign = 1.0 if omega > 0.0 else -1.0
            k_theta, k_omega = np.zeros(4), np.zeros(4)
            for stage in range(4):
                part = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
                rate = omega if stage == 0 else omega + part * h * k_omega[stage - 1]
                angle = theta if stage == 0 else theta + part * h * k_theta[stage - 1]
                moment, friction = _moments(
                    angle, rate, torque + slope * part * h, body, curves, damping, extra
                )
                k_theta[stage] = rate
                k_omega[stage] = (moment - sign * friction) / body[0]
            change = h * (k_omega[0] + 2.0 * k_omega[1] + 2.0 * k_omega[2] + k_omega[3]) / 6.0
            moved = h * (k_theta[0] + 2.0 * k_theta[1] + 2.0 * k_theta[2] + k_theta[3]) / 6.0
            if (omega + change) * sign < 0.0 and omega != 0.0:
                # Within 40 us the acceleration is practically constant.
                part = -omega / change
                theta += 0.5 * part * h * omega
                omega = 0.0
                left -= part * h
            else:
                theta += moved
                omega += change
                left -= h
        found[i] = theta
    return found
