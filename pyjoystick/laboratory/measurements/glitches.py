"""Frames in which a marker is somewhere else, as when labels are swapped or a reflection is taken for it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion import RecordError, rows_in_words
from pyjoystick.support import FloatArray

#: The paper's joystick moves at up to 12 rad/s; a faster step (rad/s) that is this much longer than most of
#: those beside it is no motion.
_FASTEST: Final = 30.0
_JUMP: Final = 4.0
_BESIDE: Final = 5
#: A frame is apart if it is off the middle of its neighbors by this angle (rad), and by this multiple of what
#: most frames around it are.
_APART: Final = math.radians(1.0)
_MULTIPLE: Final = 5.0
_MOST: Final = 0.75
_AROUND: Final = 10
_FEWEST: Final = 6


def require_no_glitch(source: str, time: FloatArray, theta: FloatArray, rows: NDArray[np.int64]) -> None:
    """Reject an angle that jumps.

    Args:
        source: the markers' file
        time: times of the frames (s), shape (n,)
        theta: the angle (rad), shape (n,)
        rows: rows of the frames in the file, shape (n,)

    Raises:
        RecordError: the angle moves faster than 30 rad/s between two frames, and not beside them
    """
    steps = np.abs(np.diff(theta))
    for i in np.flatnonzero(steps > _FASTEST * np.diff(time)).tolist():
        around = np.concatenate((steps[max(0, i - _BESIDE) : i], steps[i + 1 : i + 1 + _BESIDE]))
        if steps[i] < _JUMP * np.median(around):
            continue  # a light joystick, which is fast everywhere
        raise RecordError(
            source,
            f"the angle jumps by {math.degrees(steps[i]):.3g} degrees to the next frame, faster than "
            "joysticks move: is a marker somewhere else there, or its label swapped?",
            "empty the marker's cells in these frames; short gaps are interpolated",
            rows=rows[i : i + 2].tolist(),
        )


def glitch_notes(time: FloatArray, theta: FloatArray, rows: NDArray[np.int64]) -> Iterator[str]:
    """Note frames in which the angle (rad) leaves the motion of those around it."""
    off = np.zeros(len(theta))
    off[1:-1] = np.abs(theta[1:-1] - _between(time, theta))
    apart = []
    for i in np.flatnonzero(off > _APART).tolist():
        around = np.concatenate((off[max(0, i - _AROUND) : max(0, i - 2)], off[i + 3 : i + 1 + _AROUND]))
        beside = max(off[i - 1], off[i + 1])
        if around.size >= _FEWEST and off[i] >= beside and off[i] > _MULTIPLE * np.quantile(around, _MOST):
            apart.append(i)
    if apart:
        most = math.degrees(float(off[apart].max()))
        where = rows_in_words(rows[apart].tolist())
        yield f"the angle leaves the motion by up to {most:.2g} degrees ({where}): is a marker wrong there?"


def _between(time: FloatArray, theta: FloatArray) -> FloatArray:
    """The angle that the neighbors of each inner frame have at its time."""
    share = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    return np.asarray(theta[:-2] + share * (theta[2:] - theta[:-2]))
