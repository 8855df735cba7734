"""Instrument faults that show in the samples: counters that wrap, sensors that freeze, rounded times."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.motion.records.record import GAP, Record
from pyjoystick.motion.records.swings import THRESHOLD, find_swings
from pyjoystick.support import FloatArray

#: A joystick moves at up to 12 rad/s; a step faster than this that
_FASTEST: Final = 30.0
#: covers this part of the range of angles, with neighbors below this part of it, is not motion.
_FAR: Final = 0.5
_BESIDE: Final = 0.25
#: Times are uneven if steps that are not gaps differ by this part of the usual one.
_UNEVEN: Final = 0.02
#: Above this part of the release angle the joystick is still held: once free, it never returns there.
HELD: Final = 0.95
#: Number of equal samples that are examined.
_EQUAL: Final = 3
#: This many at the end of a record are no rest, if the step before them is more than half as large as the one
#: before it, and more than this part of the largest.
_END: Final = 10
_SUDDEN: Final = 0.5
_FAST: Final = 0.1
#: After equal samples, a step of a true motion is at most four times the resolution, including rounding.
_CATCH_UP: Final = 5.0
#: Angles closer than this (rad) are equal up to rounding.
_SAME_ANGLE: Final = 1e-12


def require_no_jump(record: Record) -> None:
    """Raise RecordError if the angle jumps in a steady motion, as from a counter that wraps."""
    steps = np.abs(np.diff(record.theta))
    beside = np.maximum(np.append(0.0, steps[:-1]), np.append(steps[1:], 0.0))
    jumps = np.flatnonzero(
        (steps > _FASTEST * np.diff(record.time))
        & (steps > _FAR * np.ptp(record.theta))
        & (beside < _BESIDE * steps)
    )
    if not jumps.size:
        return
    i = int(jumps[0])
    first, second = np.degrees(record.theta[i : i + 2])
    raise RecordError(
        record.source,
        f"the angle jumps by {math.degrees(steps[i]):.4g} degrees between rows {record.rows[i]} and "
        f"{record.rows[i + 1]}, faster than any joystick moves, in {len(jumps)} "
        f"place{'s' * (len(jumps) > 1)}: did a counter wrap around?",
        "add the whole range of the counter from each jump on, or export an angle that does not wrap",
        column="theta",
        rows=record.rows[np.unique(np.concatenate((jumps, jumps + 1)))],
        value=f"{first:+.4g} and {second:+.4g} degrees",
    )


def uneven_notes(time: FloatArray) -> Iterator[str]:
    """Note times (s) whose steps, apart from gaps, differ as after rounding."""
    steps = np.diff(time)
    interval = float(np.median(steps)) if steps.size else 0.0
    usual = steps[steps <= GAP * interval]
    if usual.size and float(np.ptp(usual)) > _UNEVEN * interval:
        yield (
            f"uneven times: steps from {usual.min():.6g} to {usual.max():.6g} s; if the times are rounded, "
            "export them with more digits"
        )


def repeated_angles(theta: FloatArray, rows: NDArray[np.int64], resolution: float = 0.0) -> Iterator[str]:
    """Note that the angle stays exactly constant in a motion from side to side, then catches up or ends.

    Equal samples alone prove nothing: coarse angles repeat at every turn and at rest. There the next step is
    a few times the resolution; after a freeze, the sensor makes up for all that it missed. At the end of a
    record, a joystick slows down before it rests; a sensor that freezes stops at once.

    Args:
        theta: the angle (rad), shape (n,)
        rows: rows of the samples in the file, shape (n,)
        resolution: known resolution of the angle (rad), if its own steps are finer
    """
    largest = float(np.max(np.abs(theta)))
    swings = find_swings(theta, THRESHOLD * largest) if largest > 0.0 else []
    if len(swings) < 2:
        return
    steps = np.abs(np.diff(theta))
    edges = np.flatnonzero(steps > _SAME_ANGLE)
    values = np.diff(np.unique(theta))
    values = values[values > _SAME_ANGLE]
    resolution = max(resolution, float(np.min(values)) if values.size else math.inf)
    frozen: list[tuple[int, int]] = []
    for before, last in pairwise([-1, *edges.tolist()]):
        moves = theta[last] / swings[0].value < HELD and last < swings[-1].last
        if last - before >= _EQUAL and moves and steps[last] > _CATCH_UP * resolution:
            frozen.append((before + 1, last))
    end = int(edges[-1]) + 1
    if abs(theta[end]) < HELD * largest and _stops_at_once(steps, end, resolution):
        frozen.append((end, len(theta) - 1))
    if frozen:
        most = max(last - first + 1 for first, last in frozen)
        where = rows_in_words(int(rows[i]) for first, last in frozen for i in range(first, last + 1))
        yield (
            f"the angle stays exactly the same for up to {most} samples while the joystick moves ({where}): "
            "did the sensor freeze, reach the end of its range, or is it slower than the record?"
        )


def _stops_at_once(steps: FloatArray, end: int, resolution: float) -> bool:
    """Whether steps (rad) do not slow down before the equal samples from `end` to the last."""
    slow = max(_CATCH_UP * resolution, _SUDDEN * steps[end - 2], _FAST * steps.max())
    return len(steps) - end >= _END - 1 and bool(steps[end - 1] > slow)
