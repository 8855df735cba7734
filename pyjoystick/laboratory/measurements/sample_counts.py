"""Columns that count the samples of a series, or give their times, beside a known rate."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion import UNITS, Heading, RecordError, time_heading
from pyjoystick.support import FloatArray

#: The part of the steps of a column that must be alike if it counts.
_NEARLY_ALL: Final = 0.98
#: By how much a step is not a multiple of the finest one, and a little more than one of these.
_ROUNDED: Final = 1e-3
_ONE: Final = 1.01
#: The shortest period of a counter that begins again, and the rounding of its logarithm.
_SHORTEST: Final = 16.0
_EXACT: Final = 1e-9
#: Relative difference of two rates that may be one.
_SAME_RATE: Final = 0.01


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
        self._last, self._row = math.nan, 0

    def follow(self, numbers: FloatArray, first: int) -> None:
        """Take the next piece.

        Args:
            numbers: its numbers, shape (n,), n >= 1
            first: row of the first

        Raises:
            RecordError: a column that counts skips or repeats samples, or has times of another rate
        """
        places = np.flatnonzero(np.isfinite(numbers))
        known, rows = numbers[places], first + places
        if self.counts:
            known, rows = np.append(self._last, known), np.append(self._row, rows)
        steps = np.diff(known) / np.diff(rows)
        if not self.counts:
            allowed = _allowed_steps(steps, self._heading, self._rate)
            if allowed is None:
                _require_rate(self._source, known, rows, self._heading, self._rate)
                return
            self.counts, (self._low, self._high) = True, allowed
        is_first = math.isnan(self._last)
        self._last, self._row = float(known[-1]), int(rows[-1])
        again = _begins_again(known, (self._low + self._high) / 2.0)
        faults = np.flatnonzero(((steps < self._low) | (steps > self._high)) & ~again)
        if faults.size:
            i = int(faults[0]) + 1
            raise RecordError(
                self._source,
                "the samples do not go on in even steps here: are some missing?",
                "an accelerometer's series has no gaps: cut the file there, or remove the column",
                column=self._heading.text,
                rows=[int(rows[i])],
                value=f"{known[i]:g}",
            )
        if is_first:
            _require_rate(self._source, known, rows, self._heading, self._rate)


def _require_rate(
    source: str, numbers: FloatArray, rows: NDArray[np.int64], heading: Heading, rate: float
) -> None:
    """Reject times whose mean step is not that of the rate (Hz), within what they are rounded to."""
    time, steps = time_heading(heading.text, by_unit=True), np.diff(numbers)
    if time is None or time.unit not in UNITS["time"] or (steps < 0.0).any() or not steps.any():
        return
    span = float(numbers[-1] - numbers[0])
    found = float(rows[-1] - rows[0]) / (span * UNITS["time"][time.unit])
    if abs(rate / found - 1.0) > _SAME_RATE + 2.0 * float(np.min(steps[steps > 0.0])) / span:
        reason = f"its times are those of {found:.6g} Hz, the given rate is {rate:g} Hz"
        raise RecordError(source, reason, "leave the rate out or correct it", column=heading.text)


def _begins_again(numbers: FloatArray, step: float) -> NDArray[np.bool_]:
    """Whether a counter begins again in each step, after 2^n, 2^n - 1 or 10^n."""
    periods = np.maximum(numbers[:-1] + step - numbers[1:], 1.0)
    powers = (np.log2(periods), np.log2(periods + 1.0), np.log10(periods))
    is_whole = np.any([np.abs(one - np.rint(one)) < _EXACT for one in powers], axis=0)
    return np.asarray((numbers[1:] <= step) & (periods >= _SHORTEST) & is_whole)


def _allowed_steps(steps: FloatArray, heading: Heading, rate: float) -> tuple[float, float] | None:
    """The least and the largest step of a column that counts samples or times; None if it does not count.

    Times are rounded to a multiple of something; if a step is none, it differs by that.
    """
    time = time_heading(heading.text, by_unit=True)
    usual, margin = float(np.median(steps)) if steps.size else 0.0, 0.5
    if time is not None and time.unit in UNITS["time"] and usual > 0.0:
        step = 1.0 / (rate * UNITS["time"][time.unit])
        finest = float(np.min(steps[steps > 0.0]))
        if abs(step / finest - round(step / finest)) > _ROUNDED:
            usual, margin = step, _ONE * finest / step
    if not usual > 0.0 or np.mean(np.abs(steps - usual) <= margin * usual) < _NEARLY_ALL:
        return None
    return (1.0 - margin) * usual, (1.0 + margin) * usual
