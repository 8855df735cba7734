"""The runs that are left, handed out in chunks that take about the same time each."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

#: A chunk has at most this many times the runs of the largest one timed so far.
_GROWTH: Final = 32
#: The last chunks take at least this fraction of the time of others; sending smaller ones would not pay.
_SMALLEST: Final = 0.1


class Chunks:
    """Runs still to be done.

    The rate is measured as the work goes on. Chunks become smaller towards the end, so that all threads or
    workers finish at about the same time.
    """

    def __init__(self, runs: NDArray[np.int64], *, seconds: float, slots: int, least: int = 1) -> None:
        """Take up the runs.

        Args:
            runs: numbers of the runs, in the order in which they are handed out
            seconds: target duration of a chunk (s)
            slots: number of chunks worked on at a time
            least: smallest number of runs in a chunk, also that of the first chunks
        """
        self._runs = runs
        self._seconds = seconds
        self._least = least
        self._largest = least
        self._rate = 0.0
        self.slots = slots

    @property
    def left(self) -> int:
        """Number of runs not handed out."""
        return int(self._runs.size)

    def take(self) -> NDArray[np.int64]:
        """The next chunk, empty when there are no more."""
        full = min(int(self._rate * self._seconds), _GROWTH * self._largest)
        wanted = full if self.slots == 1 else min(full, -(-self.left // (2 * self.slots)))
        size = max(wanted, int(_SMALLEST * full), self._least)
        chunk, self._runs = self._runs[:size], self._runs[size:]
        return chunk

    def timed(self, runs: int, seconds: float) -> None:
        """Learn from a finished chunk."""
        self._rate = runs / max(seconds, 1e-9)
        self._largest = max(self._largest, runs)
