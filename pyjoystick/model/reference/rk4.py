"""Integrator of the paper (section 4): classical Runge-Kutta with small steps near the steep slopes.

It does not locate events, so that a kink within a step reduces the order of the method. It serves to
reproduce the paper's numbers and to show this loss of accuracy, not as a reference.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.branches import Acceleration, PiecewiseEquation
from pyjoystick.model.reference.trajectory import Trajectory, trajectory
from pyjoystick.support import ParameterError, SimulationError, Torque, angle, finite, positive, whole_number

#: Section 4: time step (s), and the number by which it is divided near the steep slopes.
PAPER_STEP: Final = 1e-3
PAPER_REFINEMENT: Final = 10


def simulate_rk4(
    joystick: JoystickParameters,
    *,
    duration: float,
    theta_start: float,
    omega_start: float = 0.0,
    torque: Torque | None = None,
    step: float = PAPER_STEP,
    refinement: int = PAPER_REFINEMENT,
) -> Trajectory:
    """Integrate the equation of motion from time 0 as the paper did.

    The paper does not define "near the steep slopes". Here, a step is near if the angles that it would sweep,
    theta to theta + omega*step + alpha*step^2/2, touch a segment in which a restraint is still in tension
    (x_0 to x_1 or x_2 to x_3 of either side). Such a step is replaced by `refinement` steps of equal length.

    Args:
        joystick: parameters of the joystick, without dry friction, which the paper does not have
        duration: length of the run (s), rounded to a whole number of steps, at least one
        theta_start: angle at the start (rad), |theta_start| < pi/2
        omega_start: angular velocity at the start (rad/s)
        torque: driving torque (N m) as a function of time (s); None for free oscillation
        step: time step (s), also the spacing of the output
        refinement: number of steps that replace each step near the steep slopes

    Returns:
        the motion at 0, step, 2*step, ...; without events and turning points

    Raises:
        ParameterError: an argument is not finite or outside its range
        SimulationError: the motion reaches pi/2, or the torque is not finite
    """
    if joystick.friction:
        allowed = "none: the paper's integrator has no dry friction"
        raise ParameterError("friction", joystick.friction, allowed)
    theta, omega = angle("theta_start", theta_start), finite("omega_start", omega_start, "rad/s")
    step = positive("step", step, "s")
    whole_number("refinement", refinement, 1)
    count = max(1, round(positive("duration", duration, "s") / step))
    equation = PiecewiseEquation(joystick, torque)
    steep = [(branch.lower, branch.upper) for branch in equation.branches if branch.steep]

    def acceleration(time: float, theta: float, omega: float) -> float:
        return equation.branches[equation.index(theta, omega)].acceleration(time, theta, omega)

    motion = [(theta, omega)]
    taken = 0
    for i in range(count):
        swept = theta + omega * step + 0.5 * acceleration(i * step, theta, omega) * step * step
        first, last = min(theta, swept), max(theta, swept)
        parts = refinement if any(first <= upper and last >= lower for lower, upper in steep) else 1
        for part in range(parts):
            theta, omega = _step(acceleration, (i + part / parts) * step, theta, omega, step / parts)
        if not abs(theta) < 0.5 * math.pi:
            raise SimulationError((i + 1) * step, f"the angle is {theta} rad, outside -pi/2 to pi/2")
        motion.append((theta, omega))
        taken += parts
    columns = np.array(motion)
    time = step * np.arange(count + 1, dtype=np.float64)
    return trajectory(joystick, time, columns[:, 0], columns[:, 1], torque, accepted=taken)


def _step(
    acceleration: Acceleration, time: float, theta: float, omega: float, length: float
) -> tuple[float, float]:
    """Take one step of the classical fourth-order method."""
    half = 0.5 * length
    alpha_1 = acceleration(time, theta, omega)
    omega_2 = omega + half * alpha_1
    alpha_2 = acceleration(time + half, theta + half * omega, omega_2)
    omega_3 = omega + half * alpha_2
    alpha_3 = acceleration(time + half, theta + half * omega_2, omega_3)
    omega_4 = omega + length * alpha_3
    alpha_4 = acceleration(time + length, theta + length * omega_3, omega_4)
    theta += length * (omega + 2.0 * omega_2 + 2.0 * omega_3 + omega_4) / 6.0
    omega += length * (alpha_1 + 2.0 * alpha_2 + 2.0 * alpha_3 + alpha_4) / 6.0
    return theta, omega
