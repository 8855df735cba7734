"""A load-deflection curve recorded by a testing machine: loading and, optionally, unloading."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion import UNITS, Column, Layout, RecordError, read_log_table
from pyjoystick.support import FloatArray

#: Travel may run back by this part of the whole due to noise, but not by more.
JITTER = 0.01
#: A single wrong number would distort the fit: a row-to-row step of this part of the travel, or a force that
#: differs by this part of its range from both neighbors. Stiff segments rise within few rows, but never fall.
_JUMP = 0.5
_SPIKE = 0.05
#: Minimum travel of a branch, relative to the whole.
_LEAST_COVERED = 0.5
_FEWEST_SAMPLES = 20
#: Part of the travel before the turn to omit: friction reverses there, and with noise the sample with the
#: largest travel need not be the last one of loading.
_TURN = 0.005
#: Range of a record's largest travel and force: minimum, maximum, unit. Values outside are in another unit.
_SIZES: Final = {"travel": (1e-4, 1.0, "m"), "force": (1e-4, 1e5, "N")}
_AUTOMATIC: Final = Layout()
_COLUMNS: Final = (Column("travel", UNITS["length"]), Column("force", UNITS["force"]))


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """One direction of travel.

    Attributes:
        travel: travel of the contact (m), shape (n,), in the order of the record
        force: force on the plunger (N), shape (n,)
        rows: line numbers of the file, or indices, shape (n,)
    """

    travel: FloatArray
    force: FloatArray
    rows: NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class LoadCurve:
    """One cycle of quasi-static loading.

    Attributes:
        source: the file, or another origin
        loading: branch of increasing travel
        unloading: branch of decreasing travel; None if it was not recorded
        notes: doubts, one sentence each
    """

    source: str
    loading: Branch
    unloading: Branch | None
    notes: tuple[str, ...] = ()

    @property
    def branches(self) -> tuple[Branch, ...]:
        """The recorded branches."""
        return (self.loading,) if self.unloading is None else (self.loading, self.unloading)

    @classmethod
    def from_cycle(
        cls,
        travel: FloatArray,
        force: FloatArray,
        *,
        source: str = "arrays",
        rows: NDArray[np.int64] | None = None,
    ) -> LoadCurve:
        """Split a record at its largest travel; with two branches, the last 0.5 % of travel is left out.

        If compression is recorded as negative, its sign is reversed and a note added.

        Args:
            travel: travel of the contact (m), shape (n,), rising once and optionally falling once
            force: force (N), shape (n,)
            source: its name in messages
            rows: line numbers of the file; by default indices

        Raises:
            RecordError: fewer than 20 samples in a branch, no travel, no force, sizes that no spring has, or
                travel that turns back
        """
        lines = np.arange(len(travel)) if rows is None else rows
        notes = []
        series = {"travel": travel, "force": force}
        for name, values in series.items():
            extreme = float(values[np.argmax(np.abs(values))]) if len(values) else 0.0
            if extreme == 0.0 or np.ptp(values) == 0.0:
                reason = "never changes" if extreme else "is zero throughout"
                raise RecordError(source, reason, "was the right column chosen?", column=name)
            _require_size(source, name, extreme)
            if extreme < 0.0:
                series[name] = -values
                notes.append(
                    f"{name} is mostly negative: taken as compression counted negative, and its sign reversed"
                )
        travel, force = series["travel"], series["force"]
        _require_no_jump(source, travel, lines)
        turn = int(np.argmax(travel))
        span = float(np.ptp(travel))
        parts = [slice(0, turn + 1), slice(turn, len(travel))]
        covered = [float(np.ptp(travel[part])) / span if span > 0.0 else 0.0 for part in parts]
        if covered[0] < _LEAST_COVERED:
            advice = "begin the record before the load is applied, with travel counted in its direction"
            raise RecordError(source, "has no loading branch: travel does not rise", advice, column="travel")
        _require_one_way(source, travel[parts[0]], lines[parts[0]], span, "loading")
        two = covered[1] >= _LEAST_COVERED
        _require_one_way(source, -travel[parts[1]], lines[parts[1]], span, "unloading")
        if not two:
            is_left_out = turn + 1 < len(travel)
            left_out = f" (rows after row {lines[turn]}, the largest travel, are left out)" * is_left_out
            notes.append(
                f"has no unloading branch{left_out}: friction is counted as force of the springs; record the "
                "whole cycle"
            )
        _require_no_spike(source, force, lines, turn)
        notes += _peak_at_turn(force, lines, turn)
        kept = travel < travel[turn] - _TURN * span if two else np.ones(len(travel), dtype=bool)
        found = [
            Branch(travel[part][kept[part]], force[part][kept[part]], lines[part][kept[part]])
            for part in parts[: 1 + two]
        ]
        for branch in found:
            if len(branch.rows) < _FEWEST_SAMPLES:
                reason = f"has {len(branch.rows)} samples in a branch; at least {_FEWEST_SAMPLES} are needed"
                raise RecordError(source, reason, "record more slowly or more often")
        return cls(source, found[0], found[1] if len(found) > 1 else None, tuple(notes))


def _require_size(source: str, name: str, extreme: float) -> None:
    """Reject a largest travel (m) or force (N) that is likely in another unit."""
    least, most, unit = _SIZES[name]
    if least <= abs(extreme) <= most:
        return
    advice = "is its unit right?"
    for size, factor in (("larger", 1e3), ("smaller", 1e-3)):
        if least <= factor * abs(extreme) <= most:
            advice = f"did you mean a unit that is 1000 times {size}? Correct the heading"
    reason = f"the largest {name} is not from {least:g} to {most:g} {unit}"
    raise RecordError(source, reason, advice, column=name, value=f"{extreme:g} {unit}")


def _require_no_jump(source: str, travel: FloatArray, rows: NDArray[np.int64]) -> None:
    """Reject travel with half or more of it between two rows, which indicates a wrong cell."""
    steps = np.abs(np.diff(travel))
    i = int(np.argmax(steps)) if steps.size else 0
    if steps.size and steps[i] >= _JUMP * np.ptp(travel) > 0.0:
        raise RecordError(
            source,
            f"travel jumps by {1e3 * steps[i]:.4g} mm from one row to the next",
            "is one of the two numbers wrong, or were rows lost?",
            column="travel",
            rows=rows[i : i + 2].tolist(),
            value=" and ".join(f"{1e3 * value:.6g} mm" for value in travel[i : i + 2]),
        )


def _require_no_spike(source: str, force: FloatArray, rows: NDArray[np.int64], turn: int) -> None:
    """Reject a force far above or below both neighbors, except at the turn, where it may peak."""
    padded = np.pad(force, 1, mode="reflect") if len(force) > 1 else np.zeros(3)
    before, after = padded[:-2], padded[2:]
    apart = np.maximum(force - np.maximum(before, after), np.minimum(before, after) - force)
    limit = np.full(len(force), _SPIKE * np.ptp(force))
    # The first and the last row have only one neighbor, which may be in a stiff segment.
    limit[[0, -1]] = _JUMP * np.ptp(force)
    limit[turn] = np.inf
    i = int(np.argmax(apart - limit))
    if apart[i] > limit[i]:
        raise RecordError(
            source,
            f"force differs by {apart[i]:.4g} N from both neighboring rows",
            "is the number wrong? If the row cannot be corrected, delete it",
            column="force",
            rows=[int(rows[i])],
            value=f"{force[i]:.6g} N",
        )


def _peak_at_turn(force: FloatArray, rows: NDArray[np.int64], turn: int) -> Iterator[str]:
    """Note a force that exceeds those beside it by most of its range, at the largest travel."""
    beside = [float(force[i]) for i in (turn - 1, turn + 1) if 0 <= i < len(force)]
    excess = float(force[turn]) - max(beside)
    if excess > _JUMP * np.ptp(force):
        where = f"at the largest travel (row {rows[turn]})"
        yield f"the force {where} exceeds its neighbors by {excess:.4g} N: an end stop, or a wrong number?"


def _require_one_way(
    source: str, travel: FloatArray, rows: NDArray[np.int64], span: float, branch: str
) -> None:
    back = np.maximum.accumulate(travel) - travel
    wrong = np.flatnonzero(back > JITTER * span)
    if wrong.size:
        raise RecordError(
            source,
            f"travel turns back by {1e3 * float(np.max(back)):.3g} mm within {branch}",
            "keep one cycle per file: the first loading, and the unloading that follows it",
            column="travel",
            rows=[int(rows[wrong[0]])],
            value=f"{1e3 * abs(float(travel[wrong[0]])):.6g} mm",
        )


def read_load_curve(
    path: str | PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    layout: Layout = _AUTOMATIC,
) -> LoadCurve:
    """Read one cycle of loading and, optionally, unloading from a table.

    The file has one line of headings, such as ``travel (mm);force (N)`` or ``Weg [mm];Kraft [N]``, then one
    sample per row in the order of recording; other columns are ignored.

    Args:
        path: the file, in any form that `read_log` accepts
        columns: headings if they differ: ``{"travel": "Extension", "force": "Load"}``
        units: units of columns whose headings give none: lengths and forces of `UNITS`
        layout: layout of the file, if it must be specified

    Raises:
        RecordError: the file cannot be read, a column is missing, has no unit or an unknown one, a cell is
            not a number, or the record is not one cycle; the message names file, column and rows and what to
            do
    """
    table = read_log_table(path, layout, numbered=bool(columns))
    series = table.read(_COLUMNS, headings=columns, units=units)
    return LoadCurve.from_cycle(series["travel"], series["force"], source=str(path), rows=table.file.rows)
