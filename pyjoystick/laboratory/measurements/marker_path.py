"""The path of a marker: its plane, and the circle about the pivot."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.motion import RecordError
from pyjoystick.support import FloatArray

#: The plane is uncertain if the path bends within it by less than this many times its distance from it.
_BEND: Final = 2.0
_STILL: Final = 1e-9
#: Forward must have at least this component along the main direction: within 60 degrees of it.
_ALONG: Final = 0.5
#: Gauss-Newton for the circle; SciPy's least squares stops at half of the digits and takes longer.
_ITERATIONS: Final = 50
_CONVERGED: Final = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class MotionPlane:
    """A plane with two directions in it; all vectors have length 1 and shape (3,).

    Attributes:
        along: the main direction of motion, forward
        across: in the plane, perpendicular to `along`, to either side
        normal: perpendicular to both
        out_of_plane: largest distance from the plane relative to the largest motion along it
    """

    along: FloatArray
    across: FloatArray
    normal: FloatArray
    out_of_plane: float

    def project(self, vectors: FloatArray) -> FloatArray:
        """Coordinates along and across of vectors of shape (..., 3), shape (..., 2)."""
        return vectors @ np.stack((self.along, self.across), axis=1)


def motion_plane(
    path: FloatArray, rest: FloatArray, forward: FloatArray, source: str, *, up: FloatArray | None = None
) -> MotionPlane:
    """Fit a plane to a path by least squares, using singular values.

    Args:
        path: positions of a marker (m), shape (n, 3), without NaN
        rest: its position at rest (m), shape (3,)
        forward: direction that counts as positive, shape (3,), of length 1; it need not be in the plane
        source: name for errors
        up: a direction known to be in the plane, shape (3,), of length 1; only the main direction of
            motion is then fitted, which even a small motion determines well

    Raises:
        RecordError: the marker does not move, its path is so short or so little planar that the plane is
            uncertain, or forward is not along the motion
    """
    _, singular, directions = np.linalg.svd(path - path.mean(axis=0), full_matrices=False)
    if singular[0] <= _STILL * math.sqrt(len(path)):
        raise RecordError(source, "the marker does not move", "is it the one on top of the joystick?")
    if up is not None:
        directions = _holding(up, directions[0])
    elif singular[1] < _BEND * singular[2]:
        raise RecordError(
            source,
            f"the plane of motion is uncertain: the path is curved by {_rms(singular[1], path):.2g} mm "
            f"rms within it, and leaves it by {_rms(singular[2], path):.2g} mm rms",
            "use a record of larger motion about one axis, with the marker on top named as the top, or say "
            "which axis of the laboratory lies in the plane: up",
        )
    along = directions[0] * np.sign(directions[0] @ forward)
    if abs(along @ forward) < _ALONG:
        words = ", ".join(f"{value:+.2f}" for value in directions[0])
        reason = f"the main direction of motion ({words}) is not along the direction called forward"
        raise RecordError(
            source, reason, "name the axis of the laboratory that points forward: x, -x, y, ..."
        )
    across, middle = directions[1], path - rest
    normal = np.cross(along, across)
    out = float(np.max(np.abs(middle @ normal)) / np.max(np.abs(middle @ along)))
    return MotionPlane(along, across, normal, out)


def _holding(up: FloatArray, main: FloatArray) -> FloatArray:
    """The main direction perpendicular to `up`, and `up`, shape (2, 3)."""
    level = main - (main @ up) * up
    return np.stack((level / np.linalg.norm(level), up))


def _rms(singular: float, path: FloatArray) -> float:
    return 1e3 * float(singular) / math.sqrt(len(path))


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
    """Fit a circle by minimizing squared distances to points of shape (n, 2), n > 3, with Gauss-Newton.

    The start solves the linear equations of squared distances. The errors assume independent noise of equal
    size. Points on a straight line give a circle with errors that are not finite.

    Args:
        points: the points (m)
        radius: the radius if known (m); then only the center is fitted, and the radius has no error
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
    # The inverse of the product with itself would lose the curvature of a nearly straight path to rounding.
    errors[:unknown] = np.linalg.norm(np.linalg.pinv(jacobian), axis=1) * math.sqrt(variance)
    if np.linalg.matrix_rank(jacobian) < unknown:
        errors[:] = np.inf
    return Circle(found[:2] + middle, float(found[2]), errors[:2], float(errors[2]), math.sqrt(variance))
