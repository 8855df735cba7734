"""Check that a record shows what section 3.3 of the paper needs: one release and a free decay.

Anything that would make later results wrong or meaningless is an error (`RecordError`): no oscillation, too
few peaks for a line through them, a motion that does not decay or grows again (a second release), a gap that
may hide a peak (all later peaks would be miscounted), the wrong side of release, a velocity that is not that
of the angle, an angle that jumps like a counter that wraps around. Less serious findings are added to the
notes of the record, one sentence each: a motion at the first sample, shorter gaps, uneven times, fewer peaks
than eq. (12) compares, swings of few samples, samples that repeat while the joystick moves, angles beyond the
stops, a zero of the angle that is not the rest position. Nothing is repaired.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final, Literal

import numpy as np

from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.motion.records.instrument import HELD, repeated_angles, require_no_jump, uneven_notes
from pyjoystick.motion.records.record import GAP, HIDING, Record
from pyjoystick.motion.records.swings import THRESHOLD, Swing, find_swings
from pyjoystick.support import FloatArray

Side = Literal["forward", "backward"]

#: Two on either side; fewer do not define a line through the peaks of a side.
FEWEST_PEAKS: Final = 4
#: Number of displacement peaks that eq. (12) compares.
WANTED_PEAKS: Final = 9
#: A swing that exceeds the previous one on its side by this part of the largest angle is not free.
GROWTH: Final = 0.1
#: A gap shorter than this part of a swing hides little of its height: 1 - cos(0.3*pi/2) = 11 %.
_OF_SWING: Final = 0.3
#: The last swing on the side of release must stay below this part of the release angle.
DECAYED: Final = 0.9
#: The speed at the first sample, from a parabola through at least three samples and this time (s), is noted
#: above this part of the largest, this many times what noise makes it, and this many samples after a rest.
_AT_FIRST: Final = 0.02
_MOVING: Final = 0.25
_CLEARLY: Final = 5.0
_JUST: Final = 2.0
#: Minimum number of samples at the end of a record that show the rest position.
_REST_SAMPLES: Final = 10
#: A rest farther from zero than this part of the largest angle is noted. A joystick leans to an end of its
#: clearance, 0.2 degrees, which is 1 % of a release from 20.
_OFF_ZERO: Final = 0.02
#: One and a half times the angle of a joystick's stops; larger angles are likely in another unit.
_FAR_BEYOND_STOPS: Final = math.radians(30.0)


def check_free_oscillation(
    record: Record, *, released: Side | None = None, counted: bool = True, resolution: float = 0.0
) -> Record:
    """Check that the record is a free oscillation after one release; returns it with notes.

    Args:
        record: the measured record
        released: side of the release, if known; forward is positive
        counted: whether its peaks will be counted, so that no gap may hide any; a fit of the whole
            motion does not count them
        resolution: known resolution of the angle (rad), if its own steps are finer

    Returns:
        the same samples, with findings added to the notes

    Raises:
        RecordError: the record is not such a motion, or was released on the other side; see the module
    """
    require_no_jump(record)
    largest = float(np.max(np.abs(record.theta)))
    swings = find_swings(record.theta, THRESHOLD * largest) if largest > 0.0 else []
    _require_oscillation(record, swings)
    require_no_growth(record, swings, largest)
    _require_decay(record, swings)
    _require_side(record, swings[0], released)
    notes = [
        *_start(record),
        *_gaps(record, swings, counted=counted),
        *uneven_notes(record.time),
        *_velocity(record),
        *repeated_angles(record.theta, record.rows, resolution),
        *_peak_count(record, swings),
        *_stops(record, largest),
        *_rest(record, swings, largest),
    ]
    return record.with_notes(*notes)


def _require_oscillation(record: Record, swings: Sequence[Swing]) -> None:
    peaks = max(len(swings) - 1, 0)
    if peaks == 0:
        raise RecordError(
            record.source,
            "there is no free oscillation in it: the angle never swings from one side to the other",
            "is this the right file and column, and is zero the middle position?",
            column="theta",
            rows=record.rows[[0, -1]],
        )
    if peaks < FEWEST_PEAKS:
        raise RecordError(
            record.source,
            f"too few peaks after the release, {FEWEST_PEAKS} are needed",
            "record until the joystick has come to rest, and begin before the release",
            column="theta",
            rows=[record.rows[swing.extreme] for swing in swings[1:]],
            value=peaks,
        )


def require_no_growth(record: Record, swings: Sequence[Swing], largest: float) -> None:
    """Raise RecordError if a swing exceeds the previous one on its side, which is impossible without a push.

    If a gap may hide the top of the previous swing, the one before it on the same side is used.

    Args:
        record: the measured record
        swings: swings of its angle, alternating in side
        largest: angle (rad) of which a 10 % excess is allowed
    """
    seen: dict[int, Swing] = {}
    for swing in swings:
        before = seen.get(swing.sign)
        if before is not None and abs(swing.value) > abs(before.value) + GROWTH * largest:
            raise RecordError(
                record.source,
                f"the motion grows again, from {math.degrees(before.value):+.2f} degrees on the same side "
                f"(row {record.rows[before.extreme]}): a second release, or a hand on the joystick",
                "cut the file so that it holds one release and what follows it",
                column="theta",
                rows=[record.rows[swing.extreme]],
                value=f"{math.degrees(swing.value):+.2f} degrees",
            )
        time = record.time[max(swing.first - 1, 0) : swing.last + 2]
        if np.max(np.diff(time)) < _OF_SWING * (time[-1] - time[0]):
            seen[swing.sign] = swing


def _require_decay(record: Record, swings: Sequence[Swing]) -> None:
    last = max(swings[-2:], key=lambda swing: abs(swing.value))
    if abs(last.value) > DECAYED * abs(swings[0].value):
        raise RecordError(
            record.source,
            f"the motion does not decay from {math.degrees(swings[0].value):+.2f} degrees "
            f"(row {record.rows[swings[0].extreme]}): this is not a free oscillation",
            "use a record of a release; for driven motion read it without this check",
            column="theta",
            rows=[record.rows[last.extreme]],
            value=f"{math.degrees(last.value):+.2f} degrees",
        )


def _require_side(record: Record, release: Swing, released: Side | None) -> None:
    found = "forward" if release.sign > 0 else "backward"
    if released is not None and found != released:
        raise RecordError(
            record.source,
            f"the joystick is released {found} instead of {released}: wrong sign?",
            "the angle is positive forward: reverse its sign (for markers, with the opposite --forward) or "
            "correct the side of release",
            column="theta",
            rows=[record.rows[release.extreme]],
            value=f"{math.degrees(release.value):+.2f} degrees",
        )


def _gaps(record: Record, swings: Sequence[Swing], *, counted: bool) -> Iterator[str]:
    """Note on the gaps; if peaks are counted, gaps in which a swing may hide are an error."""
    steps = np.diff(record.time)
    gaps = np.flatnonzero(steps > GAP * record.interval)
    for i in gaps:
        allowed = HIDING * _shortest_beside(record, swings, int(i))
        if counted and steps[i] > allowed:
            raise RecordError(
                record.source,
                f"a gap of {steps[i]:.4g} s in which a peak may hide: {allowed:.3g} s is allowed here",
                "all peaks after it would be counted wrongly: use another record, cut it before the gap, or "
                "fit the whole motion (pyjoystick fit)",
                column="time",
                rows=record.rows[[i, i + 1]],
            )
    if gaps.size:
        missing = round(float(np.sum(steps[gaps] / record.interval - 1.0)))
        beside = rows_in_words(record.rows[np.concatenate((gaps, gaps + 1))].tolist())
        yield f"gaps: about {missing} samples are missing between {beside}"


def _shortest_beside(record: Record, swings: Sequence[Swing], i: int) -> float:
    """Duration (s) of the shortest complete swing next to the step after sample i; infinite if none is near.

    The hold before the release and the rest after the last significant swing may have gaps of any length.
    """
    time = record.time
    if i >= swings[-1].last or record.theta[i + 1] / swings[0].value > HELD:
        return math.inf
    edges = [0.5 * float(time[a.last] + time[b.first]) for a, b in pairwise(swings)]
    inside = sum(edge < time[i] for edge in edges)
    durations = np.diff(edges)
    # Swing k lasts from edge k-1 to edge k; a swing with the gap may be two, with one hidden in between.
    beside = [durations[k - 1] for k in (inside - 1, inside + 1, inside + 2) if 1 <= k <= len(durations)]
    return float(min(beside))


def _start(record: Record) -> Iterator[str]:
    """Note that the joystick moves at the first sample, more than two samples after it was at rest."""
    time = record.time[: max(3, int(np.searchsorted(record.time, record.time[0] + _AT_FIRST)))]
    inverse = np.linalg.pinv(np.vander(time - time[0], 3, increasing=True))
    _, velocity, half = inverse @ record.theta[: len(time)]
    speed = abs(float(velocity))
    fastest = float(np.max(np.abs(np.diff(record.theta) / np.diff(record.time))))
    noise = _quietest(record.theta) * float(np.linalg.norm(inverse[1]))
    is_just_released = velocity * half > 0.0 and speed < _JUST * 2.0 * abs(half) * record.interval
    if speed > max(_MOVING * fastest, _CLEARLY * noise) and not is_just_released:
        yield f"the joystick moves at the first sample, at about {speed:.2g} rad/s: was it released before?"


def _quietest(theta: FloatArray) -> float:
    """Standard deviation of the noise (rad) where the angle changes least, from its second differences."""
    second = np.diff(theta, 2)
    windows = np.lib.stride_tricks.sliding_window_view(second, min(_REST_SAMPLES, len(second)))
    return float(windows.std(axis=1).min()) / math.sqrt(6.0)


def _velocity(record: Record) -> Iterator[str]:
    """Note on a measured velocity that is off; one that does not match the angle at all is an error."""
    if record.omega is None:
        return
    record.require_rate("omega", record.omega, moves=True)
    # Trapezoidal rule: change of the angle over a step compared with the mean velocity.
    turned = np.diff(record.theta)
    mean = 0.5 * (record.omega[1:] + record.omega[:-1]) * np.diff(record.time)
    ratio = float(np.sum(turned * mean) / np.sum(mean * mean))
    if abs(ratio - 1.0) > 0.1:
        yield f"the angle changes {ratio:.3f} times as fast as the measured velocity"


def _peak_count(record: Record, swings: Sequence[Swing]) -> Iterator[str]:
    peaks = len(swings) - 1
    if peaks < WANTED_PEAKS:
        yield f"few peaks: {peaks} stand out after the release; eq. (12) judges {WANTED_PEAKS}"
    short = [swing for swing in swings[1 : WANTED_PEAKS + 1] if swing.last - swing.first < 2]
    if short:
        rows = rows_in_words([int(record.rows[swing.extreme]) for swing in short])
        yield f"coarse sampling: {len(short)} swings of fewer than three samples, at {rows}"


def _stops(record: Record, largest: float) -> Iterator[str]:
    if largest > _FAR_BEYOND_STOPS:
        beyond = int(np.argmax(np.abs(record.theta)))
        yield (
            f"the angle goes to {math.degrees(largest):.1f} degrees (row {record.rows[beyond]}), far beyond "
            "a joystick's stops at about 20 degrees: is its unit right?"
        )


def _rest(record: Record, swings: Sequence[Swing], largest: float) -> Iterator[str]:
    """What does not move for a whole period is at rest; a shorter stretch may also be a turning point."""
    period = 2.0 * max(record.time[swing.last] - record.time[swing.first] for swing in swings[1:-1])
    tail = record.theta[record.time > record.time[-1] - period]
    if len(tail) < _REST_SAMPLES:
        tail = record.theta[-_REST_SAMPLES:]
    offset = float(np.mean(tail))
    error = float(np.std(tail)) / math.sqrt(len(tail))
    if float(np.ptp(tail)) < THRESHOLD * largest and abs(offset) > max(_OFF_ZERO * largest, 4.0 * error):
        yield (
            f"the record ends at rest at {math.degrees(offset):+.3f} degrees "
            f"({rows_in_words(record.rows[-len(tail) :].tolist())}): is zero the middle position?"
        )
