"""Equation of motion, split into smooth branches at kinks of the contact force, at theta = 0 and at stops.

The contact travel increases with |theta|, so each kink x = x_i of either side corresponds to one fixed angle,
and the branches are the intervals between these angles. Within a branch, the spring segment and the sign of
theta are frozen: the acceleration is smooth and continues smoothly a little beyond both ends, so that an
integrator can step over an end and then return to it. Beyond a stop, the moment is the maximum of zero and a
linear function; its kink, where the moment is continuous, is left to the step size control.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from pyjoystick.model.parameters.joystick import ConstantDamping, Damping, JoystickParameters
from pyjoystick.model.parameters.springs import RestrainedSpring
from pyjoystick.model.reference.moments import angle_of_travel, contact_travel
from pyjoystick.support import SimulationError, Torque

#: Angular acceleration (rad/s2) from time (s), angle (rad) and angular velocity (rad/s).
Acceleration = Callable[[float, float, float], float]
#: Deceleration by dry friction (rad/s2), 0 or more, from angle (rad) and angular velocity (rad/s).
Deceleration = Callable[[float, float], float]


@dataclass(frozen=True, slots=True)
class Boundary:
    """An angle (rad) at which two branches meet, and the names of its kinks, such as ``forward x_0``."""

    theta: float
    kinks: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Branch:
    """The equation of motion between two neighboring boundaries.

    Attributes:
        lower, upper: ends (rad), infinite for the first and the last branch
        steep: whether the restraint of an engaged spring is still in tension, or a stop is met
        acceleration: (T + m*g*h*sin(theta) - M_s - C*omega - M_stop)/J, without dry friction
        friction: magnitude of the dry friction moment while sliding, over J; at rest, its upper limit
    """

    lower: float
    upper: float
    steep: bool
    acceleration: Acceleration
    friction: Deceleration

    def sliding(self, direction: int) -> Acceleration:
        """Return the acceleration with dry friction while the joystick slides in a direction, 1 or -1."""
        others, friction = self.acceleration, self.friction

        def slowed(time: float, theta: float, omega: float) -> float:
            return others(time, theta, omega) - direction * friction(theta, omega)

        return slowed


class PiecewiseEquation:
    """The branches of eq. (1) with the torque of eq. (13), ordered by theta, and their boundaries."""

    def __init__(self, joystick: JoystickParameters, torque: Torque | None) -> None:
        self.torque = torque
        law = joystick.friction
        self.stribeck_velocity = law.omega_s if law.T_s > law.T_c else 0.0
        self.boundaries = _boundaries(joystick)
        self._angles = [boundary.theta for boundary in self.boundaries]
        ends = [-math.inf, *self._angles, math.inf]
        self.branches = [_branch(joystick, torque, lower, upper) for lower, upper in pairwise(ends)]

    def index(self, theta: float, heading: float) -> int:
        """Return the index of the branch that contains theta; on a boundary, of the branch to be entered."""
        return (bisect_right if heading >= 0.0 else bisect_left)(self._angles, theta)


def _boundaries(joystick: JoystickParameters) -> list[Boundary]:
    """Return the boundaries; kinks at the same angle share one, which names them in order of rising theta."""
    kinks_at: dict[float, list[str]] = {}
    if joystick.stops:
        kinks_at[-joystick.stops.theta_stop] = ["backward stop"]
    for i, x in reversed(list(enumerate(joystick.backward.kinks))):
        kinks_at.setdefault(0.0 - angle_of_travel(joystick, x), []).append(f"backward x_{i}")
    kinks_at.setdefault(0.0, []).append("theta = 0")
    for i, x in enumerate(joystick.forward.kinks):
        kinks_at.setdefault(angle_of_travel(joystick, x), []).append(f"forward x_{i}")
    if joystick.stops:
        kinks_at.setdefault(joystick.stops.theta_stop, []).append("forward stop")
    return [Boundary(theta, tuple(kinks)) for theta, kinks in sorted(kinks_at.items())]


def _branch(joystick: JoystickParameters, torque: Torque | None, lower: float, upper: float) -> Branch:
    assembly = joystick.backward if upper <= 0.0 else joystick.forward
    nearer, farther = sorted((abs(lower), abs(upper)))
    # Kinks at enormous travels are rounded to pi/2, where the travel is infinite.
    inside = min(nearer + 0.5 * (min(farther, 0.5 * math.pi) - nearer), math.nextafter(0.5 * math.pi, 0.0))
    x = float(contact_travel(joystick, inside))
    segments = [_segment(spring, x) for spring in (assembly.return_spring, assembly.balance_spring)]
    force = sum(segment[0] for segment in segments), sum(segment[1] for segment in segments)
    side = -1.0 if upper <= 0.0 else 1.0
    is_stopped = bool(joystick.stops) and inside > joystick.stops.theta_stop
    steep = is_stopped or any(segment[2] for segment in segments)
    in_contact = x > assembly.return_spring.x_0
    acceleration = _acceleration(joystick, torque, side, force)
    if is_stopped:
        acceleration = _stopped(joystick, side, acceleration)
    return Branch(lower, upper, steep, acceleration, _deceleration(joystick, side, in_contact=in_contact))


def _segment(spring: RestrainedSpring, x: float) -> tuple[float, float, bool]:
    """Return offset and stiffness of the line of eqs. (6)-(8) around travel x, and whether it is steep."""
    if x <= spring.x_0:
        return 0.0, 0.0, False
    if x <= spring.x_release:
        stiffness = spring.k_h + spring.k_s
        return -stiffness * spring.x_0, stiffness, True
    return spring.F_0 - spring.k_s * spring.x_0, spring.k_s, False


def _acceleration(
    joystick: JoystickParameters, torque: Torque | None, side: float, force: tuple[float, float]
) -> Acceleration:
    """Return the equations of `moments` for a frozen branch and floats; called some 20,000 times a run."""
    a, b, inertia = joystick.a, joystick.b, joystick.J
    weight_moment = joystick.m * joystick.g * joystick.h
    offset, stiffness = force
    damping = _damping(joystick.damping, side)
    tan = math.tan

    def free(_: float, theta: float, omega: float) -> float:
        t = tan(0.5 * side * theta)
        tangent = 2.0 * t / (1.0 - t * t)
        x = tangent * (a - b * t)
        contact = (offset + stiffness * x) * (a + (x - b) * tangent)
        weight = weight_moment * 2.0 * t / (1.0 + t * t)
        return (side * (weight - contact) - damping(theta, omega) * omega) / inertia

    if torque is None:
        return free

    def driven(time: float, theta: float, omega: float) -> float:
        driving = float(torque(time))
        if not math.isfinite(driving):
            raise SimulationError(time, f"the torque is {driving} N m")
        return free(time, theta, omega) + driving / inertia

    return driven


def _stopped(joystick: JoystickParameters, side: float, others: Acceleration) -> Acceleration:
    """Return the acceleration beyond a stop."""
    law, inertia = joystick.stops, joystick.J

    def stopped(time: float, theta: float, omega: float) -> float:
        push = law.K * (side * theta - law.theta_stop) + law.D * side * omega
        return others(time, theta, omega) - side * max(push, 0.0) / inertia

    return stopped


def _deceleration(joystick: JoystickParameters, side: float, *, in_contact: bool) -> Deceleration:
    law, a, b, inertia = joystick.friction, joystick.a, joystick.b, joystick.J
    force = law.F_c if in_contact else 0.0
    excess = max(law.T_s - law.T_c, 0.0)

    def deceleration(theta: float, omega: float) -> float:
        moment = law.T_c + force * (a - b * math.sin(side * theta)) / math.cos(theta) ** 2
        if excess > 0.0:
            moment += excess * math.exp(-((omega / law.omega_s) ** 2))
        return moment / inertia

    return deceleration


def _damping(law: Damping, side: float) -> Callable[[float, float], float]:
    if isinstance(law, ConstantDamping):
        constant = law.C
        return lambda theta, omega: constant
    coefficient, exponent = (law.A_pos, law.n_pos) if side > 0.0 else (law.A_neg, law.n_neg)
    of_angle, half_n, eps_theta_squared = law.alpha * coefficient, 0.5 * exponent, law.eps_theta**2
    of_rate, half_m, eps_omega_squared = law.beta * law.B, 0.5 * law.m, law.eps_omega**2

    def power_law(theta: float, omega: float) -> float:
        angle_term = of_angle * (theta * theta + eps_theta_squared) ** half_n
        rate_term = of_rate * (omega * omega + eps_omega_squared) ** half_m
        return float(angle_term + rate_term)

    return power_law
