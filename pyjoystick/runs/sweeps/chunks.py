"""Division of the remaining runs into chunks of similar duration."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

#: Largest growth of a chunk over the largest one timed so far.
_GROWTH: Final = 32
#: Smallest duration of the last chunks, relative to others; smaller ones do not pay.
_SMALLEST: Final = 0.1


class Chunks:
    """The remaining runs.

    The rate is measured during the work. Chunks become smaller towards the end, so that all threads or
    workers finish at about the same time.
    """

    def __init__(self, runs: NDArray[np.int64], *, seconds: float, slots: int, least: int = 1) -> None:
        """Start with the given runs.

        Args:
            runs: numbers of the runs, in the order of execution
            seconds: target duration of a chunk (s)
            slots: number of chunks worked on at a time
            least: smallest number of runs in a chunk, and the size of the first chunks
        """
        self._runs = runs
        self._seconds = seconds
        self._least = least
        self._largest = least
        self._rate = 0.0
        self.slots = slots

    @property
    def left(self) -> int:
        """Number of runs not handed out yet."""
        return int(self._runs.size)

    def take(self) -> NDArray[np.int64]:
        """Return the next chunk, empty if there are no more runs."""
        full = min(int(self._rate * self._seconds), _GROWTH * self._largest)
        wanted = full if self.slots == 1 else min(full, -(-self.left // (2 * self.slots)))
        size = max(wanted, int(_SMALLEST * full), self._least)
        chunk, self._runs = self._runs[:size], self._runs[size:]
        return chunk

    def timed(self, runs: int, seconds: float) -> None:
        """Update the rate from a finished chunk."""
        self._rate = runs / max(seconds, 1e-9)
        self._largest = max(self._largest, runs)
