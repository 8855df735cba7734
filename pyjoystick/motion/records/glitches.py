"""Samples of an angle that are somewhere else than the motion around them, for a moment."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.support import FloatArray

#: The paper's joystick moves at up to 12 rad/s; a faster step (rad/s) that is this much longer than most of
#: those before and behind it is no motion.
_FASTEST: Final = 30.0
_JUMP: Final = 4.0
_BESIDE: Final = 5
#: A sample is apart if it is off the line between its neighbors by this angle (rad), and by this multiple of
#: what most samples before and behind it are.
_APART: Final = math.radians(1.0)
_MULTIPLE: Final = 5.0
_MOST: Final = 0.75
_AROUND: Final = 10
_FEWEST: Final = 6


def require_no_glitch(
    source: str, time: FloatArray, theta: FloatArray, rows: NDArray[np.int64], question: str, advice: str
) -> None:
    """Reject an angle that jumps.

    Args:
        source: the file
        time: times of the samples (s), shape (n,)
        theta: the angle (rad), shape (n,)
        rows: rows of the samples in the file, shape (n,)
        question: what may be wrong
        advice: what to do then

    Raises:
        RecordError: the angle moves faster than 30 rad/s between two samples, and not beside them
    """
    steps = np.abs(np.diff(theta))
    for i in np.flatnonzero(steps > _FASTEST * np.diff(time)).tolist():
        beside = (steps[max(0, i - _BESIDE) : i], steps[i + 1 : i + 1 + _BESIDE])
        if steps[i] > _JUMP * max(float(np.median(one)) for one in beside if one.size):
            jump = f"the angle jumps by {math.degrees(steps[i]):.3g} degrees between two samples"
            raise RecordError(
                source,
                f"{jump}, faster than joysticks move: {question}",
                advice,
                rows=rows[i : i + 2].tolist(),
            )


def glitch_notes(
    time: FloatArray, theta: FloatArray, rows: NDArray[np.int64], question: str
) -> Iterator[str]:
    """Note samples in which the angle leaves the motion of those around it.

    Args:
        time: times of the samples (s), shape (n,)
        theta: the angle (rad), shape (n,)
        rows: rows of the samples in the file, shape (n,)
        question: what may be wrong
    """
    if len(theta) < _AROUND:
        return
    off = np.zeros(len(theta))
    off[1:-1] = np.abs(theta[1:-1] - _between(time, theta))
    apart = [i for i in np.flatnonzero(off > _APART).tolist() if _is_apart(off, i)]
    if apart:
        most = math.degrees(float(off[apart].max()))
        where = rows_in_words(rows[apart].tolist())
        yield f"the angle leaves the motion by up to {most:.2g} degrees ({where}): {question}"


def _is_apart(off: FloatArray, i: int) -> bool:
    beside = (off[max(0, i - _AROUND) : max(0, i - 2)], off[i + 3 : i + 1 + _AROUND])
    usual = [float(np.quantile(one, _MOST)) for one in beside if one.size >= _FEWEST]
    is_largest = bool(off[i] >= max(off[i - 1], off[i + 1]))
    return bool(usual) and is_largest and bool(off[i] > _MULTIPLE * max(usual))


def _between(time: FloatArray, theta: FloatArray) -> FloatArray:
    """The angle that the neighbors of each inner sample have at its time."""
    share = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    return np.asarray(theta[:-2] + share * (theta[2:] - theta[:-2]))
