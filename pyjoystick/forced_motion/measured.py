"""Measured motions: from CSV files, or synthetic, as the paper's cameras would record them (Fig. 14)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Final

import numpy as np

from pyjoystick.forced_motion.motions import ForwardAndReturn
from pyjoystick.forced_motion.samples import Samples
from pyjoystick.laboratory import (
    BASE,
    CAMERA_RATE,
    TOP,
    Chain,
    MarkerLayout,
    measure_angle,
    synthetic_markers,
)
from pyjoystick.motion import (
    GAP,
    MISSING_ADVICE,
    UNITS,
    Column,
    Record,
    RecordError,
    lone_notes,
    read_log_table,
    read_record,
)
from pyjoystick.support import FloatArray

#: Longest delay of an acceleration that is looked for (s), and the part of the mean square between velocity
#: and integral that its removal must leave at most.
_LATEST: Final = 0.1
_BETTER: Final = 0.5
_ALPHA: Final = Column("alpha", UNITS["angular acceleration"], required=False, advice=MISSING_ADVICE)


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredMotion:
    """A measured motion and its origin.

    Attributes:
        samples: the motion
        differentiated: whether velocity and acceleration come from the signal chain rather than the file
        notes: doubts about the motion
    """

    samples: Samples
    differentiated: bool
    notes: tuple[str, ...]


def read_motion(
    path: str | PathLike[str],
    *,
    chain: Chain | None = None,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
) -> MeasuredMotion:
    """Read a motion: directly if the file has ``omega`` and ``alpha``, else through the signal chain.

    The columns are those of `pyjoystick.motion.read_record` and ``alpha (rad/s2)`` or ``alpha (deg/s2)``, as
    in the files that ``pyjoystick import markers --motion`` writes.

    Args:
        path: the file
        chain: filtering and differentiation of the angle; by default the paper's
        columns: headings by quantity (``time``, ``theta``, ``omega``, ``alpha``) if they differ
        units: units of columns whose headings give none

    Raises:
        RecordError: the file cannot be used; the message names file, column, row and what to do
        SeriesError: it is too short for the chain
    """
    headings, given = dict(columns or {}), dict(units or {})
    of_alpha = [{"alpha": one.pop("alpha")} if "alpha" in one else {} for one in (headings, given)]
    record = read_record(path, columns=headings, units=given, free_oscillation=False)
    found = read_log_table(path, numbered=bool(columns)).read(
        [_ALPHA], headings=of_alpha[0], units=of_alpha[1]
    )
    if not record.theta.any():
        raise RecordError(str(path), "is zero throughout", "was the right column chosen?", column="theta")
    alpha = found.get("alpha")
    if record.omega is not None and alpha is not None:
        _require_no_gap(record)
        record.require_rate("alpha", alpha)
        samples = Samples.trapezoidal(record.time, record.theta, record.omega, alpha)
        doubts = *lone_notes("alpha", alpha, record.rows), *_shifted(record.time, record.omega, alpha)
        return MeasuredMotion(samples, False, (*record.notes, *doubts))
    return MeasuredMotion(through_chain(record, chain or Chain()), True, record.notes)


def through_chain(record: Record, chain: Chain) -> Samples:
    """Compute the motion from a measured angle with the signal chain.

    Raises:
        RecordError: a gap of the record is longer than the chain bridges
        SeriesError: the record is too short for the chain
    """
    motion = chain.run(record.time, record.theta)
    for start, end in motion.gaps:
        raise _gap(record, int(np.searchsorted(record.time, 0.5 * (start + end))) - 1)
    return Samples.trapezoidal(motion.time, motion.theta, motion.omega, motion.alpha)


def _shifted(time: FloatArray, omega: FloatArray, alpha: FloatArray) -> Iterator[str]:
    """Note an acceleration that is late or early: its integral follows the velocity when it is moved."""
    step = float(np.median(np.diff(time)))
    most = min(int(_LATEST / step), len(time) // 4)
    integral = np.concatenate(([0.0], np.cumsum(0.5 * (alpha[1:] + alpha[:-1]) * np.diff(time))))
    # An offset of the acceleration is a drift of its integral.
    velocity, integral = (one - np.polyval(np.polyfit(time, one, 1), time) for one in (omega, integral))
    missed = {lag: _apart(velocity, integral, lag) for lag in range(-most, most + 1)}
    lag = min(missed, key=missed.__getitem__)
    if abs(lag) > 1 and missed[lag] < _BETTER * missed[0]:
        verb = "lags" if lag > 0 else "leads"
        yield f"alpha {verb} omega by {1e3 * abs(lag) * step:.3g} ms: was it filtered differently?"


def _apart(velocity: FloatArray, integral: FloatArray, lag: int) -> float:
    """Mean square of the difference if the integral is `lag` samples late."""
    count, first, second = len(velocity) - abs(lag), max(-lag, 0), max(lag, 0)
    return float(np.mean((velocity[first : first + count] - integral[second : second + count]) ** 2))


def _require_no_gap(record: Record) -> None:
    for i in np.flatnonzero(np.diff(record.time) > GAP * record.interval)[:1]:
        raise _gap(record, int(i))


def _gap(record: Record, i: int) -> RecordError:
    """Make the error for a gap after sample i."""
    step = record.time[i + 1] - record.time[i]
    return RecordError(
        record.source,
        f"a gap of {step:.4g} s where samples are {record.interval:.4g} s apart",
        "the torque in it is not known: use a stretch without gaps",
        column="time",
        rows=record.rows[[i, i + 1]],
    )


def seen_by_cameras(motion: ForwardAndReturn, *, random: np.random.Generator) -> Samples:
    """Make a synthetic measurement: markers of the motion, their angle, and the result of the paper's chain.

    Zero is the mean angle during the rest after the motion. The plane of motion and the radius are taken as
    known, because a short arc to one side does not determine them well.

    Args:
        motion: the motion, with a rest of at least a few frames
        random: random generator for the noise

    Raises:
        RecordError, SeriesError: the motion is too short, or rests for less than two frames
    """
    frames = np.arange(math.floor(motion.duration * CAMERA_RATE) + 1) / CAMERA_RATE
    markers = synthetic_markers(frames, motion.at(frames).theta, random=random)
    rest = (motion.duration - motion.rest, motion.duration)
    angle = measure_angle(
        markers, top=TOP, base=BASE, forward="x", up="z", radius=MarkerLayout().height, rest=rest
    )
    return through_chain(angle.record("synthetic"), Chain())
