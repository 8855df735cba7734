"""Shapes of a stroke in closed form: travel from 0 to 1 in a time from 0 to 1, with its two derivatives.

All of them are turned about their middle, s(u) = 1 - s(1 - u), so that a return is a stroke in reverse.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final, Literal, get_args

import numpy as np

from pyjoystick.support import FloatArray

Shape = Literal["minimum-jerk", "raised-cosine", "trapezoid"]
SHAPES: Final[tuple[Shape, ...]] = get_args(Shape)

#: Travel and its first and second derivative at times u, shape (3, n) for u of shape (n,).
Travel = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True)
class Profile:
    """A stroke of unit travel in unit time, in pieces that are smooth.

    Attributes:
        corners: times of the pieces' ends, from 0 to 1, shape (k + 1,)
        pieces: the travel within each piece, k of them
    """

    corners: tuple[float, ...]
    pieces: tuple[Travel, ...]


def minimum_jerk() -> Profile:
    """Least mean square jerk from rest to rest (Flash and Hogan, 1985): s = 10 u^3 - 15 u^4 + 6 u^5.

    The acceleration is continuous and zero at both ends, so that the torque has no jump. The largest velocity
    is 15/8, the largest acceleration 10/sqrt(3).
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

    The acceleration is largest, pi^2/2, at both ends and jumps there: so does the torque, by J times that.
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
    """The velocity rises evenly, stays, and falls evenly: a trapezoid over time.

    The acceleration is constant in each of the three pieces, v/r with the largest velocity v = 1/(1 - r) and
    the time of rise r = (1 - flat)/2, and jumps at all four corners: so does the torque, by J times that.

    Args:
        flat: part of the time at constant velocity, 0 (a triangle) or more, below 1
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
    """The profile of a name; `flat` counts for the trapezoid alone."""
    made: Mapping[Shape, Callable[[], Profile]] = {
        "minimum-jerk": minimum_jerk,
        "raised-cosine": raised_cosine,
        "trapezoid": lambda: trapezoid(flat),
    }
    return made[shape]()
