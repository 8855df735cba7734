"""The circle that points in a plane lie on: the pivot of a marker that turns about it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.support import FloatArray

_ITERATIONS: Final = 50
_CONVERGED: Final = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Circle:
    """A circle by least squares.

    Attributes:
        center: its center (m), shape (2,)
        radius: its radius (m)
        center_error: standard errors of the center's coordinates (m), shape (2,)
        radius_error: standard error of the radius (m)
        noise: standard deviation of the points' distances from it (m)
    """

    center: FloatArray
    radius: float
    center_error: FloatArray
    radius_error: float
    noise: float


def fit_circle(points: FloatArray, radius: float | None = None) -> Circle:
    """The circle with the least sum of squared distances to points of shape (n, 2), n > 3, by Gauss-Newton.

    The start solves the linear equations of squared distances. The errors take the points' noise as
    independent and equal. Points on a straight line give a circle with errors that are not finite.

    Args:
        points: the points (m)
        radius: where it is known (m): only the center is found then, and the radius has no error
    """
    middle = points.mean(axis=0)
    local = points - middle
    matrix = np.column_stack((2.0 * local, np.ones(len(local))))
    x, y, constant = np.linalg.lstsq(matrix, np.sum(local**2, axis=1), rcond=None)[0]
    found = np.array([x, y, math.sqrt(max(constant + x**2 + y**2, 0.0))])
    unknown = 3
    if radius is not None:
        unknown = 2
        found = np.array([*(found[:2] * radius / np.hypot(x, y)), radius])
    for _ in range(_ITERATIONS):
        difference = local - found[:2]
        distance = np.hypot(*difference.T)
        jacobian = np.column_stack((-difference / distance[:, None], -np.ones(len(local))))[:, :unknown]
        step = np.linalg.lstsq(jacobian, found[2] - distance, rcond=None)[0]
        found[:unknown] += step
        if np.max(np.abs(step)) <= _CONVERGED * found[2]:
            break
    residuals = np.hypot(*(local - found[:2]).T) - found[2]
    variance = float(residuals @ residuals) / (len(local) - unknown)
    errors = np.zeros(3)
    errors[:unknown] = np.sqrt(np.diag(np.linalg.pinv(jacobian.T @ jacobian)) * variance)
    if np.linalg.matrix_rank(jacobian) < unknown:
        errors[:] = np.inf
    return Circle(found[:2] + middle, float(found[2]), errors[:2], float(errors[2]), math.sqrt(variance))
