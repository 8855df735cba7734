"""What a camera would have seen of a swing test: the joystick as a damped pendulum, upside down."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from pyjoystick.model import JoystickParameters
from pyjoystick.motion import Record


def synthetic_swing(
    joystick: JoystickParameters,
    *,
    random: np.random.Generator,
    amplitude: float = math.radians(25.0),
    damping: float = 0.002,
    offset: float = 0.0,
    duration: float = 20.0,
    rate: float = 60.0,
    noise: float = math.radians(0.05),
) -> Record:
    """J*theta'' + C*theta' + m*g*h*sin(theta) = 0 from rest, sampled with noise.

    Args:
        joystick: J, m, h and g count
        random: where the noise comes from
        amplitude: angle of release (rad)
        damping: C of the pivot and the air (N m s/rad)
        offset: what the record shows at rest (rad)
        duration: of the record (s)
        rate: samples a second (Hz)
        noise: standard deviation of the angle's independent normal noise (rad), 0 for none
    """
    weight = joystick.m * joystick.g * joystick.h

    def right_hand_side(_: float, state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
        theta, omega = state
        return [omega, (-weight * math.sin(theta) - damping * omega) / joystick.J]

    time = np.arange(0.0, duration, 1.0 / rate)
    solution = solve_ivp(
        right_hand_side, (0.0, duration), [amplitude, 0.0], t_eval=time, rtol=1e-10, atol=1e-12
    )
    theta = solution.y[0] + offset + noise * random.standard_normal(time.size)
    return Record("synthetic swing", time, theta)
