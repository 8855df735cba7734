"""Reading records from a laboratory's files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.motion.columns import TIME, Column
from pyjoystick.motion.logs.log_table import read_log_table
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.records.free_oscillation import Side, check_free_oscillation
from pyjoystick.motion.records.glitches import doubts, lone_notes
from pyjoystick.motion.records.record import MISSING_ADVICE, Record
from pyjoystick.motion.records.swings import THRESHOLD, Swing, find_swings
from pyjoystick.motion.units import UNITS
from pyjoystick.support import FloatArray

_COLUMNS: Final = (
    replace(TIME, advice=MISSING_ADVICE),
    Column("theta", UNITS["angle"], advice=MISSING_ADVICE),
    Column("omega", UNITS["angular velocity"], required=False, advice=MISSING_ADVICE),
)


def read_record(
    path: str | PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    released: Side | None = None,
    free_oscillation: bool = True,
    counted: bool = True,
    name: str | None = None,
) -> Record:
    """Read one motion from a file.

    A CSV file has one line of headings, ``time (s)``, ``theta (deg)`` or ``theta (rad)`` and, optionally,
    ``omega (rad/s)`` or ``omega (deg/s)``, then one sample per row; lines that begin with # are comments, and
    other columns are ignored. Files for `read_log` are also accepted if they are unambiguous.

    Args:
        path: the file
        columns: headings of columns with other names: ``{"theta": "Angle X"}``, with or without
            their unit
        units: units of columns whose headings have none: ``{"time": "s", "theta": "deg"}``; see `UNITS`
        released: side of release, if known; records of the other side are rejected
        free_oscillation: whether to check that the record is one release and its decay (see
            `check_free_oscillation`); otherwise only the samples themselves are checked
        counted: whether its peaks will be counted, see `check_free_oscillation`
        name: name of the record; by default that of the file without its suffix

    Returns:
        the record in SI units, with doubts in its notes

    Raises:
        RecordError: the file cannot be read; a column is missing, has no unit or an unknown one; a cell is
            empty or not a finite number; times are repeated or out of order; degrees are labelled as
            radians; or it is not a free oscillation. The message names the file, the column and the rows.
    """
    table = read_log_table(path, numbered=bool(columns))
    series = table.read(_COLUMNS, headings=columns, units=units)
    in_degrees = table.find(_COLUMNS, headings=columns, units=units)["theta"].unit == "deg"
    record = Record(
        name=Path(path).stem if name is None else name,
        time=series["time"],
        theta=series["theta"],
        omega=series.get("omega"),
        source=str(path),
        notes=(
            *table.file.notes,
            *(_small_degrees(series["theta"]) if in_degrees else ()),
        ),
        rows=table.file.rows,
    )
    if free_oscillation:
        record = check_free_oscillation(record, released=released, counted=counted)
    advice = "correct the angle in that row, or delete the row"
    notes = doubts(record.source, record.time, record.theta, record.rows, advice)
    if record.omega is not None:
        notes += lone_notes("omega", record.omega, record.rows)
    return record.with_notes(*notes)


def read_repeats(
    paths: Iterable[str | PathLike[str]],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    released: Side | None = None,
    both_sides: bool = False,
    counted: bool = True,
) -> tuple[Record, ...]:
    """Read the records of one joystick: free oscillations, by default all released from the same side.

    Args:
        paths: one file per repeat
        columns: headings of the columns, see `read_record`
        units: units of columns without one, see `read_record`
        released: side of release, if known
        both_sides: whether some may be released from the other side
        counted: whether their peaks will be counted, see `check_free_oscillation`

    Raises:
        RecordError: the paths are not a list; a file is rejected; two contain the same samples (a repeat
            counted twice would make every interval too narrow); or they are released from different sides
            (perhaps one has the wrong sign)
    """
    if isinstance(paths, str | PathLike):
        raise RecordError(str(paths), "is a single path", "give a list of files, one for each repeat")
    records: list[Record] = []
    for path in paths:
        record = read_record(path, columns=columns, units=units, released=released, counted=counted)
        for other in records:
            _require_another(record, other)
            if not both_sides:
                _require_same_side(record, other)
        records.append(record)
    if not records:
        raise RecordError("records", "no file is given", "give one file for each repeat")
    return tuple(records)


def _require_another(record: Record, other: Record) -> None:
    if np.array_equal(record.theta, other.theta):
        advice = "give every repeat once"
        raise RecordError(record.source, f"holds the same angles as {other.source}", advice, column="theta")


def _require_same_side(record: Record, other: Record) -> None:
    # Use the first swing, not the largest angle: with a zero offset, the next swing may be larger.
    release, before = (_release(one) for one in (record, other))
    if release.sign != before.sign:
        raise RecordError(
            record.source,
            f"is released from the opposite side to {other.source}: wrong sign?",
            "give angles that are positive forward; if both are meant, pyjoystick fit takes --both-sides",
            column="theta",
            rows=[record.rows[release.extreme]],
            value=f"{math.degrees(release.value):+.2f} degrees",
        )


def _release(record: Record) -> Swing:
    """The swing in which a free oscillation is held and released."""
    return find_swings(record.theta, THRESHOLD * float(np.max(np.abs(record.theta))))[0]


def _small_degrees(theta: FloatArray) -> tuple[str, ...]:
    """Note that angles in degrees look like radians.

    They cannot be rejected: a motion of a degree is possible, one of 90 degrees or more is not.
    """
    largest = math.degrees(float(np.max(np.abs(theta))))
    if largest < math.pi / 2.0:
        return (f"the largest angle is {largest:.3g} degrees: are these radians labeled as degrees?",)
    return ()
