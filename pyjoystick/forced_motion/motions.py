"""Strokes and returns in closed form: exact angle, angular velocity and acceleration."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.support import FloatArray, ParameterError, angle, finite, not_negative, positive

Shape = Literal["minimum-jerk", "raised-cosine", "trapezoid"]
SHAPES: Final[tuple[Shape, ...]] = get_args(Shape)

#: Position and its first and second derivative at times u, shape (3, n) for u of shape (n,).
Travel = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """A stroke of unit length in unit time, with smooth pieces.

    Attributes:
        corners: times at the ends of the pieces, from 0 to 1, shape (k + 1,)
        pieces: the k functions for the position within each piece
    """

    corners: tuple[float, ...]
    pieces: tuple[Travel, ...]


def minimum_jerk() -> Profile:
    """Minimum mean square jerk from rest to rest (Flash and Hogan, 1985): s = 10 u^3 - 15 u^4 + 6 u^5.

    The acceleration is continuous and zero at both ends, so that the torque has no jumps. The largest
    velocity is 15/8, the largest acceleration 10/sqrt(3).
    """

    def travel(u: FloatArray) -> FloatArray:
        left = 1.0 - u
        return np.stack(
            (
                u**3 * (10.0 + u * (6.0 * u - 15.0)),
                30.0 * (u * left) ** 2,
                60.0 * u * left * (left - u),
            )
        )

    return Profile((0.0, 1.0), (travel,))


def raised_cosine() -> Profile:
    """Half a period of a harmonic motion: s = (1 - cos(pi u))/2.

    The acceleration is largest, pi^2/2, at both ends and jumps there; the torque jumps by J times that.
    The largest velocity is pi/2.
    """

    def travel(u: FloatArray) -> FloatArray:
        return np.stack(
            (
                np.sin(0.5 * math.pi * u) ** 2,
                0.5 * math.pi * np.sin(math.pi * u),
                0.5 * math.pi**2 * np.cos(math.pi * u),
            )
        )

    return Profile((0.0, 1.0), (travel,))


def trapezoid(flat: float) -> Profile:
    """Trapezoidal velocity: linear rise, constant, linear fall.

    The acceleration is constant in each of the three pieces, v/r with the largest velocity v = 1/(1 - r) and
    the rise time r = (1 - flat)/2, and jumps at all four corners; the torque jumps by J times that.

    Args:
        flat: fraction of the time at constant velocity, 0 (a triangle) or more, below 1
    """
    rise = (1.0 - flat) / 2.0
    velocity = 1.0 / (1.0 - rise)
    acceleration = velocity / rise

    def speeding(u: FloatArray) -> FloatArray:
        return np.stack((0.5 * acceleration * u**2, acceleration * u, np.full_like(u, acceleration)))

    def steady(u: FloatArray) -> FloatArray:
        return np.stack((velocity * (u - 0.5 * rise), np.full_like(u, velocity), np.zeros_like(u)))

    def slowing(u: FloatArray) -> FloatArray:
        travel, speed, change = speeding(1.0 - u)
        return np.stack((1.0 - travel, speed, -change))

    if flat == 0.0:
        return Profile((0.0, 0.5, 1.0), (speeding, slowing))
    return Profile((0.0, rise, 1.0 - rise, 1.0), (speeding, steady, slowing))


def profile(shape: Shape, *, flat: float) -> Profile:
    """Return the profile by name; only the trapezoid uses `flat`."""
    made: Mapping[Shape, Callable[[], Profile]] = {
        "minimum-jerk": minimum_jerk,
        "raised-cosine": raised_cosine,
        "trapezoid": lambda: trapezoid(flat),
    }
    return made[shape]()


#: At a jump of the acceleration, select the value before it or after it.
Limit = Literal["before", "after"]


@dataclass(frozen=True, slots=True, eq=False)
class Kinematics:
    """Motion at some times; arrays of one shape.

    Attributes:
        theta: angle (rad), positive forward
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2)
    """

    theta: FloatArray
    omega: FloatArray
    alpha: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class ForwardAndReturn:
    """A stroke from the middle to an angle, a dwell and a return from time 0, with rest before and after.

    Attributes:
        amplitude: the angle (rad), negative for a motion backward; not 0
        rise: duration of the stroke (s)
        fall: duration of the return (s); by default as `rise`
        dwell: time held at the angle (s)
        rest: time at rest in the middle, before and after (s)
        shape: shape of stroke and return: ``minimum-jerk`` (continuous acceleration), ``raised-cosine``
            (acceleration jumps at both ends) or ``trapezoid`` (trapezoidal velocity; acceleration jumps at
            all corners)
        flat: fraction of a stroke at constant velocity, for the trapezoid only

    Raises:
        ParameterError: a value is outside its range
    """

    amplitude: float
    rise: float
    fall: float | None = None
    dwell: float = 0.0
    rest: float = 0.0
    shape: Shape = "minimum-jerk"
    flat: float = 1.0 / 3.0

    def __post_init__(self) -> None:
        if angle("amplitude", self.amplitude) == 0.0:
            raise ParameterError("amplitude", self.amplitude, "an angle other than 0 rad")
        positive("rise", self.rise, "s")
        positive("fall", self.return_time, "s")
        not_negative("dwell", self.dwell, "s")
        not_negative("rest", self.rest, "s")
        if self.shape not in SHAPES:
            raise ParameterError("shape", self.shape, f"one of {', '.join(SHAPES)}")
        if not 0.0 <= finite("flat", self.flat) < 1.0:
            raise ParameterError("flat", self.flat, "0 or more and below 1")

    @property
    def return_time(self) -> float:
        """Duration of the return (s)."""
        return self.rise if self.fall is None else self.fall

    @property
    def duration(self) -> float:
        """Length of the motion including the rests (s)."""
        return 2.0 * self.rest + self.rise + self.dwell + self.return_time

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times between which the motion is smooth (s), from 0 to `duration`."""
        pieces = self._pieces()
        return (pieces[0].start, *(piece.end for piece in pieces))

    def at(self, time: ArrayLike, limit: Limit = "after") -> Kinematics:
        """Motion at times (s) of any shape; at rest before 0 and after `duration`.

        Args:
            time: times (s)
            limit: which value to return where the acceleration jumps
        """
        instants = np.asarray(time, dtype=np.float64)
        pieces = self._pieces()
        ends = np.array([piece.end for piece in pieces[:-1]])
        number = np.searchsorted(ends, instants, side="right" if limit == "after" else "left")
        found = np.zeros((3, *instants.shape))
        for i, piece in enumerate(pieces):
            inside = (number == i) & (instants >= 0.0) & (instants <= self.duration)
            found[:, inside] = piece.motion(instants[inside])
        return Kinematics(*found)

    def _pieces(self) -> list[_Piece]:
        shape = profile(self.shape, flat=self.flat)
        spans: list[tuple[float, float, _Motion]] = [(0.0, self.rest, _held(0.0))]
        start = self.rest
        for travel, (u, v) in zip(shape.pieces, pairwise(shape.corners), strict=True):
            spans.append((start + self.rise * u, start + self.rise * v, self._stroke(travel, start)))
        start += self.rise
        spans.append((start, start + self.dwell, _held(self.amplitude)))
        end = start + self.dwell + self.return_time
        for travel, (u, v) in reversed(list(zip(shape.pieces, pairwise(shape.corners), strict=True))):
            spans.append((end - self.return_time * v, end - self.return_time * u, self._return(travel, end)))
        spans.append((end, end + self.rest, _held(0.0)))
        return [_Piece(*span) for span in spans if span[1] > span[0]]

    def _stroke(self, travel: Callable[[FloatArray], FloatArray], start: float) -> _Motion:
        scales = _scales(self.amplitude, self.rise)
        return lambda time: scales * travel((time - start) / self.rise)

    def _return(self, travel: Callable[[FloatArray], FloatArray], end: float) -> _Motion:
        # Time-reversed, so that the small angles near the end keep all their digits.
        scales = _scales(self.amplitude, -self.return_time)
        return lambda time: scales * travel((end - time) / self.return_time)


#: Angle, angular velocity and angular acceleration, shape (3, n), at times (s) of shape (n,).
_Motion = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class _Piece:
    """A smooth part of a motion, from `start` to `end` (s)."""

    start: float
    end: float
    motion: _Motion


def _scales(amplitude: float, time: float) -> FloatArray:
    return amplitude / np.array([[1.0], [time], [time * time]])


def _held(theta: float) -> _Motion:
    values = np.array([[theta], [0.0], [0.0]])
    return lambda time: np.broadcast_to(values, (3, len(time)))
