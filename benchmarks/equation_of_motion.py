"""The joystick's equation of motion as usually written for SciPy: scalars and `math`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from pyjoystick.model import ConstantDamping, JoystickParameters
from pyjoystick.support import FloatArray

#: The derivatives of theta (rad) and omega (rad/s) from the time (s) and their values.
RightHandSide = Callable[[float, FloatArray], tuple[float, float]]


def right_hand_side(parameters: JoystickParameters) -> RightHandSide:
    """Eqs. (1), (3), (5) corrected and Table 1, with constant damping or eq. (11)."""
    a, b = parameters.a, parameters.b
    weight_moment = parameters.m * parameters.g * parameters.h
    forward, backward = parameters.forward.to_table(), parameters.backward.to_table()
    coefficient = damping_coefficient(parameters)

    def derivatives(_: float, state: FloatArray) -> tuple[float, float]:
        theta, omega = state.tolist()  # Python is faster with its own numbers than with NumPy's
        tangent, sign = math.tan(theta), math.copysign(1.0, theta)
        x = a * abs(tangent) + b * (1.0 - 1.0 / math.cos(theta))
        table = forward if theta >= 0.0 else backward
        moment = (a * sign + (x - b) * tangent) * force(x, table.x, table.k)
        torque = weight_moment * math.sin(theta) - moment - coefficient(theta, omega) * omega
        return omega, torque / parameters.J

    return derivatives


def force(x: float, knots: Sequence[float], slopes: Sequence[float]) -> float:
    """Table 1: the force (N) at a travel x (m); it rises by slopes[i] (N/m) from knots[i] (m) on."""
    total = 0.0
    for i, knot in enumerate(knots):
        if x <= knot:
            break
        end = knots[i + 1] if i + 1 < len(knots) else x
        total += slopes[i] * (min(x, end) - knot)
    return total


def damping_coefficient(parameters: JoystickParameters) -> Callable[[float, float], float]:
    """The damping coefficient (N m s/rad) from theta (rad) and omega (rad/s)."""
    law = parameters.damping
    if isinstance(law, ConstantDamping):
        constant = law.C
        return lambda theta, omega: constant

    def coefficient(theta: float, omega: float) -> float:
        angle, rate = math.hypot(theta, law.eps_theta), math.hypot(omega, law.eps_omega)
        of_angle = law.A_pos * angle**law.n_pos if theta >= 0.0 else law.A_neg * angle**law.n_neg
        return float(law.alpha * of_angle + law.beta * law.B * rate**law.m)

    return coefficient
