"""The joystick's equations of motion in a few lines of SciPy, to check the Modelica models against.

Written from the paper's equations with magnitudes and signs as they stand there, and with the springs as
the segments of Table 1: neither the form of the Modelica components nor that of any other code here.
"""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from tests.hybrid import integrate

J, MASS, H, GRAVITY, A, B = 0.01135, 0.87, 0.082, 9.80665, 0.02398, 0.005
TABLE_1 = {
    1: ([0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3], [430e3, 2625.0, 1028e3, 5600.0]),
    -1: ([0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3], [659e3, 1191.0, 1112e3, 4090.0]),
}
_SEGMENTS = {
    side: list(zip(x, np.diff([*x, np.inf]).tolist(), k, strict=True)) for side, (x, k) in TABLE_1.items()
}
Array = NDArray[np.float64]
#: A coefficient of damping (N.m.s/rad) by angle, angular velocity and, if given, side of the middle (1, -1).
Damping = Callable[..., float]


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


def _angle_of(x: float) -> float:
    return float(brentq(lambda theta: float(travel(theta)) - x, 0.0, 0.6, xtol=1e-16))


#: The sides change here, so that a joystick that rests at 0 is on one of them.
_MIDDLE = -1e-15
#: Angles (rad) at which the equations change: the middle, and where a segment of the springs begins.
KINKS = sorted([_MIDDLE, *(side * _angle_of(x) for side, (begins, _) in TABLE_1.items() for x in begins)])


def branch_of(theta: float) -> int:
    """Number of kinks below an angle: the equations are smooth on each branch."""
    return bisect(KINKS, theta)


def constant_damping(_theta: float, _omega: float, _side: int = 0) -> float:
    """The paper's constant coefficient (N.m.s/rad)."""
    return 0.045


def power_law_damping(theta: float, omega: float, side: int = 0) -> float:
    """Eq. (11) (N.m.s/rad) with the paper's coefficients, alpha = 0.9, smoothed."""
    coefficient, exponent = (0.086, 0.084) if (side or theta) > 0 else (0.032, -0.23)
    angle, speed = math.hypot(theta, 1e-4), math.hypot(omega, 1e-3)
    return 0.9 * coefficient * angle**exponent + 0.1 * 0.051 * speed**-0.26


def shaft_torque(theta: float, omega: float, damping: Damping, branch: int | None = None) -> float:
    """What the joystick itself exerts on its shaft (N.m): weight, less the moments of springs and damping.

    A branch goes on smoothly beyond its ends; by default it is that of the angle.
    """
    if branch is None:
        branch = branch_of(theta)
    beyond = branch - branch_of(_MIDDLE)
    side, begun = (1, beyond) if beyond >= 0 else (-1, -1 - beyond)
    tangent = math.tan(theta)
    x = A * side * tangent + B * (1.0 - math.sqrt(1.0 + tangent**2))  # as `travel`, but far faster for one x
    segments = _SEGMENTS[side][:begun]
    force = sum(k * length for _, length, k in segments[:-1])
    force += sum(k * (x - begin) for begin, _, k in segments[-1:])
    moment = (A * side + (x - B) * tangent) * force
    return MASS * GRAVITY * H * math.sin(theta) - moment - damping(theta, omega, side) * omega


def to_the_ends(position: float, branch: int, kinks: list[float] = KINKS) -> list[float]:
    """How far it is to the lower and to the upper end of a branch: in rad, for angles."""
    ends = [-math.inf, *kinks, math.inf]
    return [position - ends[branch], ends[branch + 1] - position]


def integrated(
    derivatives: Callable[[float, Array, int], list[float]],
    start: list[float],
    times: Array,
    position: Callable[[float, Array], float] = lambda _, state: float(state[0]),
    kinks: list[float] = KINKS,
) -> Array:
    """States at `times` (s), a row for each; angles about 1e-10 rad accurate over 1.5 s.

    `derivatives(time, state, branch)` are smooth on a branch, for the end of each is located: the kinks that
    `position(time, state)` passes. An error estimate does not always notice a kink, and whether it does
    depends on rounding, so on the machine.
    """
    return integrate(
        derivatives,
        start,
        bisect(kinks, position(0.0, np.array(start))),
        lambda time, state, branch: to_the_ends(position(time, state), branch, kinks),
        lambda _, state, branch, end: (state, branch + (1 if end else -1)),
        times[-1],
        max_step=2e-3,
    )(times)


def free_oscillation(theta_start: float, damping: Damping, times: Array) -> Array:
    """Angles (rad) at `times` (s) after a release from rest."""

    def derivatives(_: float, state: Array, branch: int) -> list[float]:
        theta, omega = state
        return [omega, shaft_torque(theta, omega, damping, branch) / J]

    return np.asarray(integrated(derivatives, [theta_start, 0.0], times)[0])
