"""Swings of a motion: stretches on alternating sides of the middle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pyjoystick.support import FloatArray

#: Minimum height of a swing relative to the largest angle; noise about the middle is not a swing.
THRESHOLD = 0.05


@dataclass(frozen=True, slots=True)
class Swing:
    """A stretch of samples on one side.

    Attributes:
        first, last: indices of its first and last sample on that side
        extreme: index of the sample with the largest angle
        value: angle of that sample (rad)
    """

    first: int
    last: int
    extreme: int
    value: float

    @property
    def sign(self) -> int:
        """1 on the forward side, -1 on the backward side."""
        return 1 if self.value > 0.0 else -1


def find_swings(theta: FloatArray, threshold: float) -> list[Swing]:
    """Find the swings that exceed `threshold` (rad, above 0), alternating in side.

    A swing ends where the next one on the other side starts or, for the last one, where the motion stays
    below the threshold; zero crossings in between, due to noise, do not split it.
    """
    outside = np.flatnonzero(np.abs(theta) > threshold)
    return list(_swings(theta, outside)) if outside.size else []


def _swings(theta: FloatArray, outside: np.ndarray[tuple[int], np.dtype[np.intp]]) -> Iterator[Swing]:
    turns = np.flatnonzero(np.diff(np.sign(theta[outside])) != 0.0)
    for stretch in np.split(outside, turns + 1):
        sign = np.sign(theta[stretch[0]])
        first, last = int(stretch[0]), int(stretch[-1])
        while first > 0 and theta[first - 1] * sign > 0.0:
            first -= 1
        while last + 1 < len(theta) and theta[last + 1] * sign > 0.0:
            last += 1
        extreme = int(stretch[np.argmax(np.abs(theta[stretch]))])
        yield Swing(first, last, extreme, float(theta[extreme]))
