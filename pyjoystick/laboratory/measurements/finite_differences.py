"""Derivatives of evenly spaced samples by the rules of 3, 5 or 7 points."""

from __future__ import annotations

import math
from functools import cache
from typing import Final

import numpy as np

from pyjoystick.support import FloatArray, ParameterError, SeriesError, positive

POINTS: Final = (3, 5, 7)


def derivative(values: FloatArray, interval: float, *, order: int, points: int) -> FloatArray:
    """First or second derivative by central differences, one-sided at the ends.

    The 5-point rule of the first derivative and the 3-point rule of the second are those of section 2:
    ``(y[-2] - 8 y[-1] + 8 y[1] - y[2])/(12 h)`` and ``(y[-1] - 2 y[0] + y[1])/h^2``. The one-sided rules of a
    second derivative take one point more, which keeps their order.

    Args:
        values: samples, shape (n,), n > points
        interval: time between two (s)
        order: 1 or 2
        points: of the rule: 3, 5 or 7

    Raises:
        ParameterError: the order, the points or the interval is not allowed
        SeriesError: too few samples
    """
    step = positive("interval", interval, "s")
    if order not in (1, 2):
        raise ParameterError("order", order, "1 or 2")
    if points not in POINTS:
        raise ParameterError("points", points, "3, 5 or 7")
    if len(values) <= points:
        raise SeriesError("values", f"has {len(values)} samples, more than {points} are needed")
    half = points // 2
    result = np.empty(len(values))
    inner = weights(tuple(range(-half, half + 1)), order)
    result[half : len(values) - half] = np.correlate(values, inner, mode="valid")
    width = points + order - 1
    for i in range(half):
        offsets = tuple(range(-i, width - i))
        result[i] = weights(offsets, order) @ values[:width]
        backward = tuple(-offset for offset in reversed(offsets))
        result[-1 - i] = weights(backward, order) @ values[-width:]
    return result / step**order


@cache
def weights(offsets: tuple[int, ...], order: int) -> FloatArray:
    """Weights of samples at whole offsets that are exact for polynomials of a degree below their number."""
    powers = np.vander(np.array(offsets, dtype=np.float64), increasing=True).T
    wanted = np.zeros(len(offsets))
    wanted[order] = math.factorial(order)
    return np.asarray(np.linalg.solve(powers, wanted), dtype=np.float64)
