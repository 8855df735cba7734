"""The period of the undamped joystick from its energy alone, by quadrature.

Without damping J*omega^2/2 + U(theta) keeps its value, with U = integral of f_x dx + m*g*h*(cos(theta) - 1).
Released at rest at theta_0 the joystick swings to the angle theta_1 on the other side where U is the same,
and the period is

    T = 2 * integral from theta_1 to theta_0 of dtheta/sqrt(2*(U(theta_0) - U(theta))/J).

The integrand is infinite at both ends and has kinks where U has, at theta = 0 and at each x_i of Table 1. So
the path is cut at the kinks, and on each piece theta = outer end - s^2: with dtheta = -2*s*ds the integrand
is smooth up to the turning point. No equation of motion is integrated, and U(theta_0) - U(theta) is a sum of
differences in which nothing cancels.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Protocol

from scipy.integrate import quad
from scipy.optimize import brentq

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.parameters.springs import ActuatorAssembly
from pyjoystick.model.reference.moments import angle_of_travel
from pyjoystick.model.undamped_period.oscillation import (
    NoOscillationError,
    Side,
    Span,
    UndampedOscillation,
    other_side,
    side_of,
)
from pyjoystick.support import ParameterError, angle


class Geometry(Protocol):
    """The two differences on which the potential energy depends, and the inverse of the travel.

    Angles are distances from the middle, 0 or more (rad). The difference between an angle and one that lies
    `gap` further in is computed from the gap, so that nothing cancels near a turning point.
    """

    def angle_of_travel(self, x: float) -> float:
        """The angle (rad) at which the contact travel is x (m)."""

    def advance(self, outer: float, gap: float) -> float:
        """x(outer) - x(outer - gap) (m)."""

    def lowering(self, outer: float, gap: float) -> float:
        """cos(outer - gap) - cos(outer): how far the center of mass sinks, in parts of h."""


@dataclass(frozen=True, slots=True)
class CamGeometry:
    """Eq. (3): x = a*tan(theta) + b*(1 - 1/cos(theta))."""

    joystick: JoystickParameters

    def angle_of_travel(self, x: float) -> float:
        """The inverse of eq. (3)."""
        return angle_of_travel(self.joystick, x)

    def advance(self, outer: float, gap: float) -> float:
        """(a*sin(gap) - b*lowering)/(cos(outer)*cos(outer - gap)), by the addition theorems."""
        a, b = self.joystick.a, self.joystick.b
        change = a * math.sin(gap) - b * self.lowering(outer, gap)
        return change / (math.cos(outer) * math.cos(outer - gap))

    def lowering(self, outer: float, gap: float) -> float:
        """2*sin(outer - gap/2)*sin(gap/2)."""
        return 2.0 * math.sin(outer - 0.5 * gap) * math.sin(0.5 * gap)


_RELATIVE_TOLERANCE: Final = 1e-12
_MOST_INTERVALS: Final = 500
#: The cam has no contact from here on (rad).
_LARGEST_ANGLE: Final = math.nextafter(0.5 * math.pi, 0.0)


def undamped_oscillation(
    joystick: JoystickParameters, release_angle: float, *, geometry: Geometry | None = None
) -> UndampedOscillation:
    """The joystick without its damping and its dry friction, released at rest.

    Args:
        joystick: the joystick, whose damping and dry friction do not count
        release_angle: angle of release (rad), positive forward, not 0
        geometry: how its travel and its height depend on the angle; `CamGeometry`, eq. (3), where not given

    Raises:
        ParameterError: the angle is 0, or its magnitude pi/2 or more
        NoOscillationError: it does not come back through the middle, as when its weight holds it in the
            clearance, or it reaches a stop
    """
    start = angle("release_angle", release_angle)
    if start == 0.0:
        raise ParameterError("release_angle", release_angle, "an angle other than 0")
    used = CamGeometry(joystick) if geometry is None else geometry
    side = side_of(start)
    sides: dict[Side, _Well] = {
        "forward": _Well(joystick, joystick.forward, used),
        "backward": _Well(joystick, joystick.backward, used),
    }
    energy = sides[side].energy(abs(start))
    if energy <= 0.0:
        raise NoOscillationError(start, "its weight does not let it rise to the middle")
    turns = {side: abs(start), other_side(side): sides[other_side(side)].turning_angle(energy, start)}
    if joystick.stops and max(turns.values()) > joystick.stops.theta_stop:
        reason = f"it reaches the stops at {joystick.stops.theta_stop:.6g} rad, which turn it back"
        raise NoOscillationError(start, reason)
    spans, error = [], 0.0
    for name, well in sides.items():
        for segment, piece, duration, uncertainty in well.durations(turns[name], start):
            spans.append(Span(name, segment, piece.inner, piece.outer, duration))
            error += 2.0 * uncertainty
    return UndampedOscillation(turns["forward"], turns["backward"], tuple(spans), error)


@dataclass(frozen=True, slots=True)
class _Piece:
    """Between two angles (rad) the force is a straight line of travel: force at the inner end, stiffness."""

    inner: float
    outer: float
    force: float
    stiffness: float


class _Well:
    """The potential energy on one side as a function of the distance from the middle (rad)."""

    def __init__(self, joystick: JoystickParameters, assembly: ActuatorAssembly, geometry: Geometry) -> None:
        self._inertia = joystick.J
        self._weight_moment = joystick.m * joystick.g * joystick.h
        self._geometry = geometry
        self._pieces = list(_pieces(assembly, geometry))

    def energy(self, at: float) -> float:
        """U at a distance (rad) less U in the middle (J)."""
        return sum(self._drop(piece, piece.outer - piece.inner) for piece in self._up_to(at))

    def turning_angle(self, energy: float, release: float) -> float:
        """The distance (rad) at which U is `energy` (J), which is above 0."""
        left = energy
        for piece in self._pieces:
            climb = self._drop(piece, piece.outer - piece.inner)
            if climb >= left:
                break
            left -= climb
        else:
            raise NoOscillationError(release, "the other side does not turn it back")

        def missing(at: float) -> float:
            part = _Piece(piece.inner, at, piece.force, piece.stiffness)
            return self._drop(part, at - piece.inner) - left

        return float(brentq(missing, piece.inner, piece.outer, xtol=1e-17, rtol=1e-15))

    def durations(self, turn: float, release: float) -> Iterator[tuple[int, _Piece, float, float]]:
        """Number, piece, time over it and its error estimate (s), from the turning point (rad) inward."""
        passed = 0.0
        pieces = self._up_to(turn)
        for segment in reversed(range(len(pieces))):
            piece = pieces[segment]
            duration, uncertainty = self._duration(piece, passed, release)
            yield segment, piece, duration, uncertainty
            passed += self._drop(piece, piece.outer - piece.inner)

    def _duration(self, piece: _Piece, passed: float, release: float) -> tuple[float, float]:
        """Time over a piece that is entered with the kinetic energy `passed` (J), and its error (s)."""

        def slowness(s: float) -> float:
            kinetic = passed + self._drop(piece, s * s)
            if kinetic <= 0.0:
                raise NoOscillationError(release, "it stops or turns back before the middle")
            return 2.0 * s * math.sqrt(0.5 * self._inertia / kinetic)

        end = math.sqrt(piece.outer - piece.inner)
        value, error, *_ = quad(
            slowness, 0.0, end, epsabs=0.0, epsrel=_RELATIVE_TOLERANCE, limit=_MOST_INTERVALS, full_output=1
        )
        return float(value), float(error)

    def _drop(self, piece: _Piece, gap: float) -> float:
        """U at the outer end of a piece less U at `gap` (rad) further in, both in the piece (J)."""
        outer = piece.outer
        advance = self._geometry.advance(outer, gap)
        whole = self._geometry.advance(outer, outer - piece.inner)
        # The line of the force, at the middle of the travel between the two angles.
        force = piece.force + piece.stiffness * (whole - 0.5 * advance)
        return force * advance - self._weight_moment * self._geometry.lowering(outer, gap)

    def _up_to(self, at: float) -> list[_Piece]:
        """The pieces from the middle to a distance (rad), the last one cut there."""
        inside = [piece for piece in self._pieces if piece.inner < at]
        last = inside.pop()
        return [*inside, _Piece(last.inner, at, last.force, last.stiffness)]


def _pieces(assembly: ActuatorAssembly, geometry: Geometry) -> Iterator[_Piece]:
    """From the middle outward: the clearance, then the segments of Table 1; some may have no length."""
    table = assembly.to_table()
    ends: Sequence[float] = [0.0, *map(geometry.angle_of_travel, table.x), _LARGEST_ANGLE]
    force = 0.0
    for (inner, outer), (x, after), k in zip(
        pairwise(ends), pairwise([0.0, *table.x, math.inf]), [0.0, *table.k], strict=True
    ):
        yield _Piece(inner, outer, force, k)
        force += k * (after - x)
