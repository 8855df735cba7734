"""Reading the motion in a laboratory's table."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import TIME, Column, Match
from pyjoystick.motion.logs.clocks import counted_times, other_clocks
from pyjoystick.motion.logs.headings import last_part, meaning
from pyjoystick.motion.logs.layout import Layout, Scale
from pyjoystick.motion.logs.log_table import AUTOMATIC, SYMBOLIC, LogTable, read_log_table
from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.motion.records.glitches import doubts, lone_notes
from pyjoystick.motion.records.instrument import repeated_angles, require_no_jump, uneven_notes
from pyjoystick.motion.records.record import FEWEST_SAMPLES, GAP, Record
from pyjoystick.motion.units import UNITS
from pyjoystick.support import FloatArray

#: Quantities in a log, in SI units: time (s), theta (rad), omega (rad/s), T (N m), F (N).
COLUMNS: Final = (
    TIME,
    Column("theta", UNITS["angle"]),
    Column("omega", UNITS["angular velocity"], required=False),
    Column("T", UNITS["torque"], required=False),
    Column("F", UNITS["force"], required=False),
)
#: Largest torque (N m) and force (N) at a joystick that is moved by hand or by a test bench.
_LARGEST_LOADS: Final = {"T": 200.0, "F": 2000.0}
#: Minimum duration of a record (s); shorter ones contain no motion of a joystick.
_SHORTEST: Final = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class Log:
    """Interpretation of a laboratory's table.

    Attributes:
        path: the file
        form: description of the file format
        line: line of the headings, from 1; 0 if there is none
        found: the columns by quantity
        series: in SI units by quantity, shape (n,) each; includes ``time`` and ``theta``
        rows: line number of each sample, shape (n,)
        left_out: line numbers of rows without a number in one of these columns
        notes: doubts, one sentence each
    """

    path: Path
    form: str
    line: int
    found: Mapping[str, Match]
    series: Mapping[str, FloatArray]
    rows: NDArray[np.int64]
    left_out: NDArray[np.int64]
    notes: tuple[str, ...]

    @property
    def rate(self) -> float:
        """Sampling rate (Hz) without gaps: the mean, because times may be rounded to milliseconds."""
        steps = np.diff(self.series["time"])
        return 1.0 / float(np.mean(steps[steps <= GAP * np.median(steps)]))


def read_log(
    path: str | PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    layout: Layout = AUTOMATIC,
    scales: Mapping[str, Scale] | None = None,
    rate: float | None = None,
    start: float = -math.inf,
    end: float = math.inf,
) -> Log:
    """Read time, angle and, optionally, velocity, torque and force from a laboratory's table.

    Args:
        path: the file
        columns: headings by quantity (time, theta, omega, T, F) if they are not recognized
        units: units by quantity; they override those of headings, except known units of a torque or force
        layout: layout of the file, if it must be specified
        scales: calibrations by quantity, for readings in V, mV or counts
        rate: sampling rate (Hz), instead of a column of times
        start: earliest time to keep (s)
        end: latest time to keep (s)

    Raises:
        RecordError: the file is rejected; the message names file, column and rows, and the option that helps
    """
    table = read_log_table(path, layout, numbered=bool(columns))
    wanted = COLUMNS if rate is None else COLUMNS[1:]
    for name in scales or {}:
        if name not in [column.name for column in COLUMNS[1:]]:
            reason = f"has no quantity {name!r} with a scale"
            raise RecordError(str(path), reason, "known are theta, omega, T and F")
    found = table.find(wanted, headings=columns, units=units, scales=scales, override=True)
    used = [match.index for match in found.values()]
    times, counted = (None, ()) if rate is None else counted_times(table, rate, used)
    series = {} if times is None else {"time": times}
    for name, match in found.items():
        zero = scales[name].zero * scales[name].factor if scales and name in scales else 0.0
        series[name] = table.file.numbers(table.heading(match)) * match.factor - zero
        _require_plausible(table, match, series[name])
    known = np.isfinite(np.stack(list(series.values()))).all(axis=0)
    if "time" not in (units or {}):
        _require_duration(table, found, series["time"][known])
    inside = known & (series["time"] >= start) & (series["time"] <= end)
    if not inside.any():
        reason = f"has no samples from {start:g} to {end:g} s" if known.any() else "has no complete row"
        raise RecordError(str(path), reason, "check --from, --to and the columns")
    left_out = np.union1d(table.file.rows[~known], np.array(table.file.empty, dtype=np.int64))
    motion = series["time"][inside], series["theta"][inside], table.file.rows[inside]
    log = Log(
        path=Path(path),
        form=table.form,
        line=table.file.head.line,
        found=found,
        series={name: one[inside] for name, one in series.items()},
        rows=table.file.rows[inside],
        left_out=left_out,
        notes=(
            *table.file.notes,
            *_notes(table, found, left_out),
            *counted,
            *other_clocks(table, found),
            *_longest_gap(series["time"][inside], table.file.rows[inside]),
            *uneven_notes(series["time"][inside]),
        ),
    )
    record = record_of(log)
    require_no_jump(record)  # all of these reject impossible motions
    advice = "empty the angle's cell in that row; rows without a number are left out"
    notes = [*doubts(str(path), *motion, advice), *repeated_angles(*motion[1:])]
    if "omega" in found:  # a torque or force may well be a tap
        notes += lone_notes(repr(table.heading(found["omega"]).text), log.series["omega"], log.rows)
    return replace(log, notes=(*log.notes, *notes))


def _require_duration(table: LogTable, found: Mapping[str, Match], time: FloatArray) -> None:
    """Reject a record (s) that is too short for a motion, such as seconds labelled as ms."""
    enough = len(time) >= FEWEST_SAMPLES  # fewer are rejected for that
    if "time" in found and enough and 0.0 < np.ptp(time) < _SHORTEST:
        match = found["time"]
        reason = f"a record of {np.ptp(time):.3g} s is too short for a motion"
        advice = f"give --unit time={match.unit} if it is one"
        if match.unit != "s":
            reason += f": are these s labeled as {match.unit}?"
            advice = f"give --unit time=s, or --unit time={match.unit} if that is right"
        raise RecordError(str(table.file.head.path), reason, advice, column=match.heading.text)


def _require_plausible(table: LogTable, match: Match, series: FloatArray) -> None:
    """Reject torques (N m) and forces (N) in the wrong unit, which shows in nothing else."""
    advice = f"is this really in {match.unit}? Correct the unit in the heading"
    require_plausible_load(table.file.head.path, match.column.name, series, match.heading.text, advice)


def require_plausible_load(path: Path, name: str, series: FloatArray, heading: str, advice: str) -> None:
    """Reject torques ``T`` (N m) and forces ``F`` (N) that no joystick withstands; others are not checked."""
    finite = series[np.isfinite(series)]
    largest = _LARGEST_LOADS.get(name, np.inf)
    if not finite.size or np.abs(finite).max() <= largest:
        return
    unit = {"T": "N.m", "F": "N"}[name]
    reason = f"reaches {np.abs(finite).max():.4g} {unit}; a joystick takes up to {largest:g} {unit}"
    raise RecordError(str(path), reason, advice, column=heading)


def _notes(table: LogTable, found: Mapping[str, Match], left_out: NDArray[np.int64]) -> Iterator[str]:
    for match in found.values():
        heading = table.heading(match)
        if heading.unit not in ("", match.unit):
            yield f"{heading.text!r} is read in {match.unit}, as given"
        if last_part(heading.name) != heading.name:
            yield f"{heading.text!r} is read as {match.column.name}"
    for i, heading in enumerate(table.file.head.headings):
        name = heading.name.partition("/")[0]  # of Force/dyn, whose unit is not known
        if meaning(last_part(name)) in SYMBOLIC and i not in [one.index for one in found.values()]:
            yield f"{heading.text!r} is left alone: --column and --unit say what it is"
    if left_out.size:
        yield f"{len(left_out)} rows without a number are left out: {rows_in_words(left_out)}"


def _longest_gap(time: FloatArray, rows: NDArray[np.int64]) -> Iterator[str]:
    """Note on the longest gap between samples (s), if there is any."""
    steps = np.diff(time)
    gaps = int(np.sum(steps > GAP * np.median(steps))) if steps.size else 0
    if gaps:
        i = int(np.argmax(steps))
        count = "a gap" if gaps == 1 else f"{gaps} gaps, the longest"
        yield f"{count} of {steps[i]:.4g} s between rows {rows[i]} and {rows[i + 1]}: one record a file?"


def record_of(log: Log) -> Record:
    """The motion in a log.

    Raises:
        RecordError: the samples are not those of a motion, see `Record`
    """
    series = log.series
    return Record(
        name=log.path.stem,
        time=series["time"],
        theta=series["theta"],
        omega=series.get("omega"),
        source=str(log.path),
        notes=log.notes,
        rows=log.rows,
    )
