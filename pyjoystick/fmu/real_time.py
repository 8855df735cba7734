"""Pacing of loops with real time."""

from __future__ import annotations

import itertools
import time as clock
from collections.abc import Iterator

from pyjoystick.support import ParameterError, positive


def paced(interval: float, duration: float = float("inf")) -> Iterator[float]:
    """Iterate at multiples of an interval, counted from the first call.

    An iteration that takes too long delays the following ones until they have caught up. None is skipped, so
    that a simulation with one step per iteration stays in sync with the clock.

    >>> for late in paced(1e-3, duration=5e-3):
    ...     pass  # a step of 1 ms

    Args:
        interval: interval between iterations (s)
        duration: when to end (s)

    Yields:
        delay of the iteration (s)

    Raises:
        ParameterError: the interval is not above zero, or the duration is negative or not a number
    """
    positive("interval", interval, "s")
    if not duration >= 0.0:
        raise ParameterError("duration", duration, "a number (s), 0 or more")
    return _paced(interval, duration)


def _paced(interval: float, duration: float) -> Iterator[float]:
    begin = clock.perf_counter()
    for i in itertools.count():
        # Extend by half an interval, so that rounding does not decide about the last iteration.
        if (i + 0.5) * interval > duration:
            return
        due = begin + i * interval
        rest = due - clock.perf_counter()
        if rest > 0.0:
            clock.sleep(rest)
        yield clock.perf_counter() - due
