"""The joystick's equations of motion in a few lines of SciPy, to check the Modelica models against.

Written from the paper's equations with magnitudes and signs as they stand there, and with the springs as
the segments of Table 1: neither the form of the Modelica components nor that of any other code here.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

J, MASS, H, GRAVITY, A, B = 0.01135, 0.87, 0.082, 9.80665, 0.02398, 0.005
TABLE_1 = {
    1: ([0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3], [430e3, 2625.0, 1028e3, 5600.0]),
    -1: ([0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3], [659e3, 1191.0, 1112e3, 4090.0]),
}
_SEGMENTS = {
    side: list(zip(x, np.diff([*x, np.inf]).tolist(), k, strict=True)) for side, (x, k) in TABLE_1.items()
}
Array = NDArray[np.float64]
Damping = Callable[[float, float], float]


def table_force(x: ArrayLike, x_i: list[float], k_i: list[float]) -> Array:
    """Force (N) at the travel x (m), added up segment by segment."""
    ends = [*x_i[1:], np.inf]
    segments = zip(x_i, ends, k_i, strict=True)
    contributions = [k * (np.clip(x, begin, end) - begin) for begin, end, k in segments]
    return np.asarray(np.sum(contributions, axis=0), dtype=float)


def travel(theta: ArrayLike) -> Array:
    """Contact travel (m) of eq. (3)."""
    return np.asarray(A * np.abs(np.tan(theta)) + B * (1.0 - 1.0 / np.cos(theta)))


def travel_slope(theta: ArrayLike) -> Array:
    """dx/dtheta (m/rad), by differentiating eq. (3)."""
    return np.asarray((A * np.sign(theta) - B * np.sin(theta)) / np.cos(theta) ** 2)


def constant_damping(_theta: float, _omega: float) -> float:
    """The paper's constant coefficient (N.m.s/rad)."""
    return 0.045


def power_law_damping(theta: float, omega: float) -> float:
    """Eq. (11) (N.m.s/rad) with the paper's coefficients, alpha = 0.9, smoothed."""
    coefficient, exponent = (0.086, 0.084) if theta > 0 else (0.032, -0.23)
    angle, speed = math.hypot(theta, 1e-4), math.hypot(omega, 1e-3)
    return 0.9 * coefficient * angle**exponent + 0.1 * 0.051 * speed**-0.26


def shaft_torque(theta: float, omega: float, damping: Damping) -> float:
    """What the joystick itself exerts on its shaft (N.m): weight, less the moments of springs and damping."""
    side = 1 if theta > 0 else -1
    tangent = math.tan(theta)
    x = A * abs(tangent) + B * (1.0 - math.sqrt(1.0 + tangent**2))  # as `travel`, but far faster for one x
    force = sum(k * min(max(x - begin, 0.0), length) for begin, length, k in _SEGMENTS[side])
    moment = (A * side + (x - B) * tangent) * force
    return MASS * GRAVITY * H * math.sin(theta) - moment - damping(theta, omega) * omega


def integrated(derivatives: Callable[[float, Array], list[float]], start: list[float], times: Array) -> Array:
    """States at `times` (s), a row for each; angles about 1e-9 rad accurate over 1.5 s.

    Not by events: the steps are too short for a kink to matter.
    """
    solution = solve_ivp(
        derivatives, (0.0, times[-1]), start, "DOP853", times, rtol=1e-10, atol=1e-12, max_step=2e-3
    )
    assert solution.success
    return np.asarray(solution.y)


def free_oscillation(theta_start: float, damping: Damping, times: Array) -> Array:
    """Angles (rad) at `times` (s) after a release from rest."""

    def derivatives(_time: float, state: Array) -> list[float]:
        theta, omega = state
        return [omega, shaft_torque(theta, omega, damping) / J]

    return np.asarray(integrated(derivatives, [theta_start, 0.0], times)[0])
