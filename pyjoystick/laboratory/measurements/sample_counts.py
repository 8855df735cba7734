"""Columns that count the samples of a series, or give their times, beside a known rate."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from pyjoystick.motion import UNITS, Heading, RecordError, time_heading
from pyjoystick.support import FloatArray

#: The part of the steps of a column that must be alike if it counts.
_NEARLY_ALL: Final = 0.98
#: By how much a step is not a multiple of the finest one, and a little more than one of these.
_ROUNDED: Final = 1e-3
_ONE: Final = 1.01


class SampleCount:
    """A column that is read in pieces and may count the samples.

    Attributes:
        counts: whether it does, once a piece is known
    """

    def __init__(self, source: str, heading: Heading, rate: float) -> None:
        """Store where the column is.

        Args:
            source: the file
            heading: heading of the column
            rate: sampling rate (Hz)
        """
        self.counts = False
        self._source, self._heading, self._rate = source, heading, rate
        self._low, self._high = -math.inf, math.inf
        self._last = math.nan

    def follow(self, numbers: FloatArray, first: int) -> None:
        """Take the next piece.

        Args:
            numbers: its numbers, shape (n,), n >= 1
            first: row of the first

        Raises:
            RecordError: a column that counts skips or repeats samples
        """
        steps = np.diff(numbers, prepend=self._last) if self.counts else np.diff(numbers)
        if not self.counts:
            allowed = _allowed_steps(steps, self._heading, self._rate)
            if allowed is None:
                return
            self.counts, (self._low, self._high) = True, allowed
        self._last = float(numbers[-1])
        # A counter may begin again.
        is_short = (steps < self._low) & (steps > -self._high)
        faults = np.flatnonzero((steps > self._high) | is_short | np.isnan(steps))
        if faults.size:
            i = int(faults[0]) - len(steps)
            raise RecordError(
                self._source,
                "the samples do not go on in even steps here: are some missing?",
                "an accelerometer's series has no gaps: cut the file there, or remove the column",
                column=self._heading.text,
                rows=[first + len(numbers) + i],
                value=f"{numbers[i]:g}",
            )


def _allowed_steps(steps: FloatArray, heading: Heading, rate: float) -> tuple[float, float] | None:
    """The least and the largest step of a column that counts samples or times; None if it does not count.

    Times are rounded to a multiple of something; if a step is none, it differs by that.
    """
    time = time_heading(heading.text)
    usual, margin = float(np.median(steps)) if steps.size else 0.0, 0.5
    if time is not None and time.unit in UNITS["time"]:
        step = 1.0 / (rate * UNITS["time"][time.unit])
        finest = float(np.min(steps[steps > 0.0], initial=np.inf))
        if abs(step / finest - round(step / finest)) > _ROUNDED:
            usual, margin = step, _ONE * finest / step
    if not usual > 0.0 or np.mean(np.abs(steps - usual) <= margin * usual) < _NEARLY_ALL:
        return None
    return (1.0 - margin) * usual, (1.0 + margin) * usual
