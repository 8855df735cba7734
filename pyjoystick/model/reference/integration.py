"""Integration along smooth branches; each passage to the next branch is located and restarted from."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from pyjoystick.model.reference.branches import Acceleration, Branch, PiecewiseEquation
from pyjoystick.model.reference.dormand_prince import ERROR_ORDER, Step
from pyjoystick.support import SimulationError

_FIRST_LENGTH = 1e-6
#: Smooth torques and sensible parameters need no steps this short (s); a jump of the torque does.
_SHORTEST_LENGTH = 1e-12
_SAFETY, _SMALLEST_FACTOR, _LARGEST_FACTOR = 0.9, 0.2, 6.0
#: Dips of omega shorter than this (s) are not searched for sign changes.
_SHORTEST_DIP = 1e-6


@dataclass(frozen=True, slots=True)
class Event:
    """Passage of a kink of the contact force, the middle or a stop, or the start or end of sticking.

    Attributes:
        time: instant (s)
        kind: ``forward x_0`` to ``forward x_3``, ``backward x_0`` to ``backward x_3`` or ``theta = 0``; with
            dry friction also ``sticks`` and ``slips``; with stops ``forward stop`` and ``backward stop``
        direction: 1 if theta rises, -1 if it falls; when the joystick sticks, its direction before
        theta: angle (rad)
        omega: angular velocity (rad/s)
    """

    time: float
    kind: str
    direction: int
    theta: float
    omega: float


@dataclass(frozen=True, slots=True)
class TurningPoint:
    """An instant (s) at which omega changes sign, and the angle there (rad)."""

    time: float
    theta: float


class Rest(NamedTuple):
    """A span in which the joystick does not move, from `time` (s) on, at `theta` (rad)."""

    time: float
    theta: float
    mode: int = 0

    def at(self, length: float) -> tuple[float, float]:
        """Return angle (rad) and angular velocity (rad/s) `length` (s) after its start."""
        return self.theta, 0.0


class Integration:
    """Step-by-step integration of a motion.

    A step ends early where the motion passes a boundary of its branch or reverses. Theta is therefore
    monotonic within a step, so that no boundary can be passed twice in it.

    Attributes:
        events: events so far, in order
        turning_points: sign changes of omega so far, in order
        accepted, rejected: numbers of accepted and rejected steps
        mode: with dry friction, the direction in which the joystick slides; 0 without, and while it sticks
    """

    def __init__(
        self, equation: PiecewiseEquation, time: float, theta: float, omega: float, tolerance: float
    ) -> None:
        self.events: list[Event] = []
        self.turning_points: list[TurningPoint] = []
        self.accepted = 0
        self.rejected = 0
        self._equation = equation
        self._tolerance = tolerance
        self._time, self._theta, self._omega = time, theta, omega
        self._length = _FIRST_LENGTH
        self.mode = 0
        self._switched_at = -math.inf
        self._index = equation.index(theta, omega)
        if omega == 0.0:
            self._index = equation.index(theta, self._branch.acceleration(time, theta, omega))

    def steps(self, end: float) -> Iterator[tuple[Step | Rest, float]]:
        """Integrate to time `end` (s); yields each step with the time (s) up to which it was used.

        Raises:
            SimulationError: the angle reaches pi/2, the torque is not finite, or steps become too short
        """
        latest = math.nextafter(end, -math.inf)
        while self._time < end:
            taken = self._advance(end, latest)
            if taken is not None:
                self.accepted += 1
                yield taken

    @property
    def _branch(self) -> Branch:
        return self._equation.branches[self._index]

    def _acceleration(self) -> Acceleration:
        return self._branch.acceleration

    def _advance(self, end: float, latest: float) -> tuple[Step | Rest, float] | None:
        """Take a step; None if the motion is on a boundary and only the branch has to be changed."""
        time, acceleration = self._time, self._acceleration()
        alpha = acceleration(time, self._theta, self._omega)
        step = Step(acceleration, time, self._theta, self._omega, alpha, latest, self.mode)
        heading = _sign(step.omega) or _sign(alpha)
        if self._leaves(heading):
            self._switch(heading, recorded=True)
            return None
        length, theta, omega = _without_hidden_turn(step, heading, *self._controlled(step, end))
        if step.omega == 0.0 and omega * heading <= 0.0:
            # At rest, with an acceleration of zero except for rounding: the step itself shows the heading.
            heading = _sign(omega)
            if self._leaves(heading):
                self._switch(heading, recorded=False)
                return None
        self._take(step, heading, length, theta, omega, end)
        return step, self._time

    def _take(self, step: Step, heading: int, length: float, theta: float, omega: float, end: float) -> None:
        """Advance to the end of the step, or to where the motion reverses or passes the boundary ahead."""
        time = end if step.time + length >= end else step.time + length
        turns = omega * heading < 0.0
        if turns:
            length = _until_turn(step, length, omega)
            time, theta, omega = step.time + length, step.at(length)[0], 0.0
        boundary = self._branch.upper if heading > 0 else self._branch.lower
        passes = heading != 0 and (theta - boundary) * heading >= 0.0 and step.theta != boundary
        if passes:
            length = _until_angle(step, length, theta, boundary)
            # If the motion only touches the boundary, rounding may reverse the sign of omega.
            omega = max(0.0, step.at(length)[1] * heading) * heading
            time, theta = step.time + length, boundary
        if abs(theta) >= 0.5 * math.pi:
            raise SimulationError(time, "the angle has reached pi/2")
        self._time, self._theta, self._omega = time, theta, omega
        if passes:
            self._enter_next(heading, recorded=True)
        elif turns:
            self._turned()

    def _turned(self) -> None:
        self.turning_points.append(TurningPoint(self._time, self._theta))

    def _controlled(self, step: Step, end: float) -> tuple[float, float, float]:
        """Return length (s), final theta and final omega of a step whose error is within the tolerance."""
        length = min(self._length, end - step.time)
        cause = None
        while True:
            try:
                theta, omega, error = step.with_error(length)
            except ArithmeticError as overflow:  # a trial step that overshoots pi/2 by far
                error, cause = math.inf, overflow
            ratio = error / self._tolerance
            if ratio <= 1.0:
                break
            self.rejected += 1
            length *= max(_SMALLEST_FACTOR, _factor(ratio)) if math.isfinite(ratio) else _SMALLEST_FACTOR
            if length < _SHORTEST_LENGTH:
                reason = "the steps have become too short; does the torque jump here without a breakpoint?"
                raise SimulationError(step.time, reason) from cause
        self._length = length * min(_LARGEST_FACTOR, _factor(ratio))
        return length, theta, omega

    def _leaves(self, heading: int) -> bool:
        """Return whether the motion is on a boundary of its branch and heads out of the branch.

        At rest on a kink, rounding may send the motion of either branch into the other: only one change is
        allowed per instant.
        """
        if heading == 0 or self._switched_at == self._time:
            return False
        return self._theta >= self._branch.upper if heading > 0 else self._theta <= self._branch.lower

    def _switch(self, heading: int, *, recorded: bool) -> None:
        self._switched_at = self._time
        self._enter_next(heading, recorded=recorded)

    def _enter_next(self, heading: int, *, recorded: bool) -> None:
        boundary = self._equation.boundaries[self._index if heading > 0 else self._index - 1]
        self._index += heading
        if recorded:
            self.events.extend(
                Event(self._time, kind, heading, boundary.theta, self._omega)
                for kind in boundary.kinks[::heading]
            )


def _without_hidden_turn(
    step: Step, heading: int, length: float, theta: float, omega: float
) -> tuple[float, float, float]:
    """Halve a step until omega can change sign at most once within it."""
    while length > _SHORTEST_DIP and _may_turn_twice(step, heading, length, theta, omega):
        length *= 0.5
        theta, omega = step.at(length)
    return length, theta, omega


def _may_turn_twice(step: Step, heading: int, length: float, theta: float, omega: float) -> bool:
    """Return whether omega starts at zero and returns past it, or its cubic interpolant dips to zero."""
    start, end = step.omega * heading, omega * heading
    if end < 0.0:
        return start == 0.0
    start_slope = step.alpha * heading * length
    end_slope = step.alpha_at(length, theta, omega) * heading * length
    if start_slope >= 0.0 or end_slope <= 0.0:
        return False
    # The cubic start + start_slope*s + b*s^2 + a*s^3 through both ends has its minimum at slope zero.
    a = 2.0 * (start - end) + start_slope + end_slope
    b = 3.0 * (end - start) - 2.0 * start_slope - end_slope
    s = -start_slope / (b + math.sqrt(b * b - 3.0 * a * start_slope))
    return start + s * (start_slope + s * (b + s * a)) <= 0.0


def _until_turn(step: Step, length: float, end_omega: float) -> float:
    """Return the part (s) of a step of `length` after which omega is zero."""

    def omega_and_slope(part: float) -> tuple[float, float]:
        theta, omega = step.at(part)
        return omega, step.alpha_at(part, theta, omega)

    return first_zero(omega_and_slope, step.omega, length, end_omega, 4.0 * math.ulp(step.omega))


def _until_angle(step: Step, length: float, end_theta: float, boundary: float) -> float:
    """Return the part (s) of a step of `length` after which theta is at `boundary`."""

    def distance_and_slope(part: float) -> tuple[float, float]:
        theta, omega = step.at(part)
        return theta - boundary, omega

    resolution = 4.0 * math.ulp(max(abs(step.theta), abs(boundary)))
    return first_zero(distance_and_slope, step.theta - boundary, length, end_theta - boundary, resolution)


def _factor(ratio: float) -> float:
    """Return the factor for the length of a step whose error is `ratio` times the tolerance."""
    return float(_SAFETY * ratio ** (-1.0 / ERROR_ORDER)) if ratio > 0.0 else math.inf


def _sign(value: float) -> int:
    return (value > 0.0) - (value < 0.0)


_MOST_ITERATIONS = 100


def first_zero(
    function: Callable[[float], tuple[float, float]],
    start_value: float,
    end: float,
    end_value: float,
    resolution: float,
) -> float:
    """Find a zero by Newton's method, kept inside a shrinking bracket.

    Every value comes from a step of the integrator that ends exactly there, not from an interpolant, so
    the zero is as accurate as the integration itself.

    Args:
        function: value and derivative at a point of [0, end]
        start_value: value at 0, not zero
        end: end of the bracket, above 0
        end_value: value at `end`, zero or of the opposite sign to `start_value`
        resolution: values up to this magnitude are rounding errors

    Returns:
        the point in [0, end] at which the value is zero to within `resolution`, or at which the bracket
        contains no more floating-point numbers
    """
    lower, upper = 0.0, end
    if end_value == 0.0:
        return end
    point = end * start_value / (start_value - end_value)
    for _ in range(_MOST_ITERATIONS):
        value, slope = function(point)
        if abs(value) <= resolution:
            break
        if (value > 0.0) == (start_value > 0.0):
            lower = point
        else:
            upper = point
        newton = point - value / slope if slope != 0.0 else lower
        following = newton if lower < newton < upper else 0.5 * (lower + upper)
        if following in (point, lower, upper):
            break
        point = following
    return point
