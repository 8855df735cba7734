"""Detection of saturation: stretches in which a signal stays at its largest or smallest value."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from pyjoystick.support import FloatArray

#: This many equal samples at an extreme are not a peak: 2.8 ms at 1800 Hz.
RUN: Final = 5
#: A value within this part of the given full scale has reached it.
_REACHED: Final = 1e-3
_MOST_KEPT: Final = 1000


@dataclass(slots=True)
class _Side:
    """One side of the signal, with signs such that its extreme is the largest value.

    Attributes:
        level: the extreme so far, or the level of the full scale
        fixed: whether the level is that of a full scale
        runs: first row and number of samples of the stretches at the level, the first `_MOST_KEPT`
        open: the stretch that the last sample belongs to, if any
    """

    level: float
    fixed: bool
    runs: list[tuple[int, int]] = field(default_factory=list)
    open: tuple[int, int] | None = None

    def add(self, values: FloatArray, first: int) -> None:
        largest = float(values.max())
        if not self.fixed and largest > self.level:
            self.level, self.runs, self.open = largest, [], None
        at = np.concatenate(([False], values >= self.level, [False])).astype(np.int8)
        edges = np.flatnonzero(np.diff(at)).reshape(-1, 2).tolist()
        if self.open and not (edges and edges[0][0] == 0):
            self._close()
        for start, end in edges:
            if start == 0 and self.open:
                self.open = (self.open[0], self.open[1] + end)
            else:
                self.open = (first + start, end - start)
            if end < len(values):
                self._close()

    def _close(self) -> None:
        if self.open and self.open[1] >= RUN and len(self.runs) < _MOST_KEPT:
            self.runs.append(self.open)
        self.open = None

    def found(self) -> list[tuple[int, int]]:
        return [*self.runs, *([self.open] if self.open and self.open[1] >= RUN else [])]


class SaturationWatch:
    """Detects saturation in a signal that arrives in pieces.

    Args:
        full_scale: largest reading of the amplifier, in the unit of the signal; if None, the largest
            and smallest values of the signal are taken for it if the signal stays there
    """

    def __init__(self, full_scale: float | None = None) -> None:
        level = -np.inf if full_scale is None else full_scale * (1.0 - _REACHED)
        self._sides = [_Side(level, full_scale is not None) for _ in range(2)]

    def add(self, values: FloatArray, first: int) -> None:
        """Add the next samples, shape (n,), n > 0; `first` is the row of the first one."""
        for sign, side in zip((1.0, -1.0), self._sides, strict=True):
            side.add(sign * values, first)

    def found(self) -> list[tuple[int, int]]:
        """First and last row of the stretches of `RUN` samples or more; the first thousand of either side."""
        runs = [run for side in self._sides for run in side.found()]
        return sorted((first, first + count - 1) for first, count in runs)
