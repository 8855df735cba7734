"""The period of a mass between springs with straight-line characteristics, in closed form.

On each side of the middle the restoring moment M (N m; or force, N) is a chain of straight lines of slopes K
over the distance q from the middle (rad; or m). On one line the motion inward, J*q'' = -M, is a piece of a
sine, a parabola or a hyperbolic sine, as K is above, at or below 0. If v is the speed there (v = 0 at the
turning point) and 1 and 2 are the outer and the inner end of the piece,

    J*v_2^2 = J*v_1^2 + (M_1 + M_2)*(q_1 - q_2),

and with p = sqrt(|K|/J) the time over the piece is

    (atan2(p*J*v_2, M_2) - atan2(p*J*v_1, M_1))/p             K > 0
    2*(q_1 - q_2)/(v_1 + v_2)                                 K = 0
    ln((p*J*v_2 + M_2)/(p*J*v_1 + M_1))/p                     K < 0.

The period is twice the sum over the pieces of both sides. Fig. 1's system is of this kind as it stands; the
joystick is where its geometry is linearized: x = a*|theta|, dx/dtheta = a*sign(theta), sin(theta) = theta.
Then M = a*f_x(a*q) - m*g*h*q, so that K = a^2*k_i - m*g*h.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.parameters.springs import ActuatorAssembly, RestrainedSpring
from pyjoystick.model.undamped_period.oscillation import (
    NoOscillationError,
    Side,
    Span,
    UndampedOscillation,
    other_side,
    side_of,
)
from pyjoystick.support import ParameterError, finite, positive


@dataclass(frozen=True, slots=True)
class LineSide:
    """One side: slope K[i] from the distance q[i] to q[i + 1]; the last line has no end. M(0) = 0.

    Attributes:
        q: distances from the middle at which a line begins (rad, or m), not decreasing, the first 0
        K: their slopes (N m/rad, or N/m), any sign
    """

    q: tuple[float, ...]
    K: tuple[float, ...]

    @classmethod
    def of_spring(cls, spring: RestrainedSpring) -> LineSide:
        """One restrained spring in translation (Fig. 1): clearance, restrained, released."""
        q = (0.0, spring.x_0, spring.x_release)
        return cls(q, (0.0, spring.k_h + spring.k_s, spring.k_s))

    def lines(self, until: float = math.inf) -> Iterator[tuple[float, float, float, float]]:
        """Inner end, outer end, moment at the inner end and slope of each line that begins before `until`."""
        moment = 0.0
        for (inner, outer), slope in zip(pairwise((*self.q, math.inf)), self.K, strict=True):
            if inner >= until:
                break
            yield inner, min(outer, until), moment, slope
            moment += slope * (outer - inner)


@dataclass(frozen=True, slots=True)
class LineOscillator:
    """A mass between two sides.

    Attributes:
        inertia: moment of inertia (kg m2), or mass (kg), above 0
        forward, backward: the sides
    """

    inertia: float
    forward: LineSide
    backward: LineSide

    def oscillation(self, release: float) -> UndampedOscillation:
        """The motion after a release at rest.

        Args:
            release: where (rad, or m), positive forward, not 0

        Raises:
            ParameterError: the release is 0 or not finite, or the inertia is not above 0
            NoOscillationError: it does not come back through the middle
        """
        inertia = positive("inertia", self.inertia)
        start = finite("release", release)
        if start == 0.0:
            raise ParameterError("release", release, "a number other than 0")
        near = side_of(start)
        sides: dict[Side, LineSide] = {"forward": self.forward, "backward": self.backward}
        energy = _energy(sides[near], abs(start))
        if energy <= 0.0:
            raise NoOscillationError(start, "what drives it outward does not let it rise to the middle")
        turns = {near: abs(start), other_side(near): _turning_point(sides[other_side(near)], energy, start)}
        spans = tuple(
            Span(name, segment, inner, outer, duration)
            for name, side in sides.items()
            for segment, inner, outer, duration in _durations(inertia, side, turns[name], start)
        )
        return UndampedOscillation(turns["forward"], turns["backward"], spans)


def linearized_joystick(joystick: JoystickParameters) -> LineOscillator:
    """The joystick with x = a*|theta|, dx/dtheta = a*sign(theta), sin(theta) = theta, without damping."""
    weight = joystick.m * joystick.g * joystick.h

    def side(assembly: ActuatorAssembly) -> LineSide:
        table = assembly.to_table()
        q = (0.0, *(x / joystick.a for x in table.x))
        return LineSide(q, (-weight, *(joystick.a**2 * k - weight for k in table.k)))

    return LineOscillator(joystick.J, side(joystick.forward), side(joystick.backward))


def _energy(side: LineSide, at: float) -> float:
    """Potential energy at a distance less that in the middle (J)."""
    return math.fsum(
        (outer - inner) * (moment + 0.5 * slope * (outer - inner))
        for inner, outer, moment, slope in side.lines(at)
    )


def _turning_point(side: LineSide, energy: float, release: float) -> float:
    """The first distance at which the potential energy is `energy` (J), which is above 0."""
    left = energy
    for inner, outer, moment, slope in side.lines():
        length = outer - inner
        climb = math.inf if math.isinf(length) else length * (moment + 0.5 * slope * length)
        if climb < left:
            left -= climb
            continue
        # M*length + K*length^2/2 = left, by the root without cancellation.
        squared = moment**2 + 2.0 * slope * left
        reach = moment + math.sqrt(squared) if squared >= 0.0 else 0.0
        if reach > 0.0:
            return inner + 2.0 * left / reach
    raise NoOscillationError(release, "the other side does not turn it back")


def _durations(
    inertia: float, side: LineSide, turn: float, release: float
) -> Iterator[tuple[int, float, float, float]]:
    """Number of the line, its ends and the time over it (s), from the turning point inward."""
    speed = 0.0
    lines: Sequence[tuple[float, float, float, float]] = list(side.lines(turn))
    for segment in reversed(range(len(lines))):
        inner, outer, last, slope = lines[segment]
        first = last + slope * (outer - inner)
        squared = speed**2 + (first + last) * (outer - inner) / inertia
        if squared < 0.0 or (speed == 0.0 and first <= 0.0):
            raise NoOscillationError(release, "it stops or turns back before the middle")
        slower, speed = speed, math.sqrt(squared)
        yield segment, inner, outer, _time(inertia, slope, outer - inner, (slower, first), (speed, last))


def _time(
    inertia: float, slope: float, length: float, outer: tuple[float, float], inner: tuple[float, float]
) -> float:
    """Time over one line from the speeds and moments at its ends (s)."""
    (v_1, moment_1), (v_2, moment_2) = outer, inner
    if slope == 0.0:
        return 2.0 * length / (v_1 + v_2)
    p = math.sqrt(abs(slope) / inertia)
    w_1, w_2 = p * inertia * v_1, p * inertia * v_2
    if slope > 0.0:
        return (math.atan2(w_2, moment_2) - math.atan2(w_1, moment_1)) / p
    if moment_1 + moment_2 < 0.0:
        # The same time from (w - M)*exp(p*t), which is constant too and does not cancel here.
        return math.log((w_1 - moment_1) / (w_2 - moment_2)) / p
    return math.log((w_2 + moment_2) / (w_1 + moment_1)) / p
