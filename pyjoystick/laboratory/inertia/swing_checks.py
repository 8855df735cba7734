"""Rejection of swing records from which period and decay would be wrong."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from pyjoystick.motion import GAP, HIDING, Record, RecordError, Swing, require_no_growth
from pyjoystick.support import FloatArray

#: Excess of equal samples in a row at a turn, over what resolution and sampling explain, that means clipping.
_CLIPPED: Final = 3
_MARGIN: Final = 1.3


def check_swings(record: Record, theta: FloatArray, swings: Sequence[Swing]) -> None:
    """Raise RecordError for a second release, a gap that may hide a turn, or an angle beyond the range.

    Args:
        record: the measured record
        theta: its angle from the pendulum's rest position (rad), shape (n,)
        swings: the complete half swings to evaluate
    """
    _require_no_gap(record, swings)
    require_no_growth(record, swings, float(np.max(np.abs(theta))))
    _require_unclipped(record, theta, swings)


def widest_gap(record: Record, span: slice) -> int | None:
    """Index of the sample before the widest gap in a stretch; None if there are no gaps."""
    steps = np.diff(record.time[span])
    if not steps.size or float(np.max(steps)) <= GAP * record.interval:
        return None
    return int(span.start) + int(np.argmax(steps))


def _require_no_gap(record: Record, swings: Sequence[Swing]) -> None:
    turns = record.time[[swing.extreme for swing in swings]]
    allowed = HIDING * float(np.median(np.diff(turns)))
    i = widest_gap(record, slice(swings[0].first, swings[-1].last + 1))
    if i is None or (missing := float(record.time[i + 1] - record.time[i])) <= allowed:
        return
    raise RecordError(
        record.source,
        f"a gap of {missing:.4g} s in which the pendulum may have turned: {allowed:.3g} s is allowed here",
        "all half swings after it would be counted wrongly: cut the record before the gap, or record again",
        column="time",
        rows=record.rows[[i, i + 1]],
    )


def _require_unclipped(record: Record, theta: FloatArray, swings: Sequence[Swing]) -> None:
    """Reject half swings that stay at their largest angle for longer than a pendulum does."""
    # Differences in the last digit are rounding errors.
    values = np.diff(np.unique(np.round(record.theta, 12)))
    resolution = float(np.min(values)) if values.size else 0.0
    runs = [_run_at_top(record, swing) for swing in swings]
    clipped = [
        (swing, run)
        for swing, run in zip(swings, runs, strict=True)
        if run[1] - run[0] + 1 >= _CLIPPED + _MARGIN * _expected(record, theta, swing, resolution)
    ]
    if not clipped:
        return
    first, end = max((run for _, run in clipped), key=lambda run: run[1] - run[0])
    last = clipped[-1][0]
    advice = "measure with more range"
    after = sum(swing.first > last.last for swing in swings)
    if after:
        advice += f", or keep the rows from {record.rows[last.last + 1]} on ({after} half swings)"
    raise RecordError(
        record.source,
        f"the angle stays at its largest value for {end - first + 1} samples, in {len(clipped)} half "
        f"swing{'s' * (len(clipped) > 1)}: the range of the instrument ends there, and the decay "
        "would look like friction",
        advice,
        column="theta",
        rows=np.concatenate([record.rows[a : b + 1] for _, (a, b) in clipped]).tolist(),
        value=f"{math.degrees(record.theta[last.extreme]):+.4g} degrees",
    )


def _run_at_top(record: Record, swing: Swing) -> tuple[int, int]:
    """First and last sample of the longest stretch at the extreme angle of a half swing."""
    inside = record.theta[swing.first : swing.last + 1]
    at = np.concatenate(([False], inside == record.theta[swing.extreme], [False])).astype(np.int8)
    edges = np.flatnonzero(np.diff(at)).reshape(-1, 2)
    first, end = edges[np.argmax(edges[:, 1] - edges[:, 0])]
    return swing.first + int(first), swing.first + int(end) - 1


def _expected(record: Record, theta: FloatArray, swing: Swing, resolution: float) -> float:
    """Number of equal samples to expect at a turn, due to resolution or repeated samples."""
    samples = swing.last - swing.first + 1
    hidden = 2.0 * math.acos(max(0.0, 1.0 - resolution / abs(swing.value))) / math.pi * samples
    span = slice(swing.first, swing.last + 1)
    flank = np.abs(theta[span]) < 0.5 * abs(swing.value)
    equal = (np.diff(record.theta[span]) == 0.0) & flank[1:]
    # Longest run of repeats on the way up and down, where a pendulum has none.
    edges = np.flatnonzero(np.diff(np.concatenate(([False], equal, [False])).astype(np.int8))).reshape(-1, 2)
    repeats = float(np.max(edges[:, 1] - edges[:, 0])) if len(edges) else 0.0
    return max(hidden if resolution > 0.0 else 0.0, repeats)
