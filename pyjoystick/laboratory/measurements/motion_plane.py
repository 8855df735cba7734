"""The plane of a planar motion, found from where one marker went."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.motion import RecordError
from pyjoystick.support import FloatArray

#: The plane is uncertain where the path bends within it by less than this many times what it leaves it by.
_BEND: Final = 2.0
_STILL: Final = 1e-9
#: Forward must lie this much along the main direction: within 60 degrees of it.
_ALONG: Final = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class MotionPlane:
    """A plane with two directions in it; all vectors have length 1 and shape (3,).

    Attributes:
        along: the main direction of motion, forward
        across: in the plane, at a right angle to `along`, to either side
        normal: at a right angle to both
        out_of_plane: largest excursion out of the plane in parts of the largest along it
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
    """The plane through a path that fits best in the sense of least squares, by singular values.

    Args:
        path: positions of a marker (m), shape (n, 3), none of them NaN
        rest: its position at rest (m), shape (3,)
        forward: direction that counts as positive, shape (3,), of length 1; it need not lie in the plane
        source: what errors name
        up: a direction that the plane is known to hold, shape (3,), of length 1; the rest is then only the
            main direction of motion, which a small motion tells well

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
            f"the plane of motion is uncertain: within it the path bends by {_rms(singular[1], path):.2g} mm "
            f"rms, out of it it goes {_rms(singular[2], path):.2g} mm rms",
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
    """The main direction at a right angle to `up`, and `up`, shape (2, 3)."""
    level = main - (main @ up) * up
    return np.stack((level / np.linalg.norm(level), up))


def _rms(singular: float, path: FloatArray) -> float:
    return 1e3 * float(singular) / math.sqrt(len(path))
