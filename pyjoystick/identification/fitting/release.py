"""A guess of when and where the joystick was let go, from the record alone."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from pyjoystick.support import FloatArray

_HELD = 0.95
_BEGUN = 0.9
_HALF = 0.5


class Release(NamedTuple):
    """Angle (rad) before the release, and the instant (s) of the release on the clock of the record."""

    angle: float
    time: float


def guess_release(time: FloatArray, theta: FloatArray) -> Release:
    """The release of a free oscillation.

    The angle is the median of the samples before the fall. A motion that begins at rest falls as the square
    of time at first; the instants at which the angle has fallen to 0.9 and to 0.5 of it give the beginning.

    Args:
        time: instants (s), shape (n,)
        theta: angle (rad), shape (n,), with the release at the largest or at the first sample
    """
    largest = float(theta[np.argmax(np.abs(theta))])
    ratio = theta / largest
    fallen = int(np.argmax(ratio < _BEGUN)) if (ratio[0] >= _BEGUN) else 0
    if fallen == 0:
        return Release(float(theta[0]), float(time[0]))
    held = theta[:fallen][ratio[:fallen] >= _HELD]
    angle = float(np.median(held)) if held.size else largest
    begun = _crossing(time, theta / angle, _BEGUN)
    half = _crossing(time, theta / angle, _HALF)
    part = math.sqrt(1.0 - _BEGUN) / (math.sqrt(1.0 - _HALF) - math.sqrt(1.0 - _BEGUN))
    return Release(angle, begun - (half - begun) * part)


def _crossing(time: FloatArray, ratio: FloatArray, level: float) -> float:
    """The first instant at which the series has fallen to `level`, on a straight line between samples."""
    below = np.flatnonzero(ratio < level)
    if not below.size:
        return float(time[-1])
    i = int(below[0])
    if i == 0:
        return float(time[0])
    part = (ratio[i - 1] - level) / (ratio[i - 1] - ratio[i])
    return float(time[i - 1] + part * (time[i] - time[i - 1]))
