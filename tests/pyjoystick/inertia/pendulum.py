"""A synthetic swing test: the nonlinear damped pendulum, sampled with noise and a shifted zero."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from pyjoystick.parameters import NOMINAL
from pyjoystick.records import Record

WEIGHT = NOMINAL.m * NOMINAL.g * NOMINAL.h
DAMPING = 0.002


def swing(
    seed: int | None, *, amplitude: float = math.radians(25.0), offset: float = 0.0, duration: float = 20.0
) -> Record:
    """J*theta'' + C*theta' + m*g*h*sin(theta) = 0 at 60 Hz; noise of 0.05 degrees unless `seed` is None."""

    def right_hand_side(_: float, state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
        theta, omega = state
        return [omega, (-WEIGHT * math.sin(theta) - DAMPING * omega) / NOMINAL.J]

    time = np.arange(0.0, duration, 1.0 / 60.0)
    solution = solve_ivp(
        right_hand_side, (0.0, duration), [amplitude, 0.0], t_eval=time, rtol=1e-10, atol=1e-12
    )
    theta = solution.y[0] + offset
    if seed is not None:
        theta = theta + math.radians(0.05) * np.random.default_rng(seed).standard_normal(time.size)
    return Record("synthetic swing", time, theta)
