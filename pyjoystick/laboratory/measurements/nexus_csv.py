"""Markers from the CSV export of Vicon Nexus.

Such a file has sections, each starting with a line with its name and one with its rate. The trajectories are:

    Trajectories
    60
    ,,Joystick:TOP,,,Joystick:BASE1,,
    Frame,Sub Frame,X,Y,Z,X,Y,Z
    ,,mm,mm,mm,mm,mm,mm
    1,0,12.5,-3.1,266.0,,,

and end with an empty line, unless frames follow it. Empty cells are markers that were not seen.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.laboratory.measurements.markers import Markers, length_factor
from pyjoystick.motion import DELIMITERS, RecordError, cut_short, is_cut_short
from pyjoystick.support import FloatArray, is_number_text, number_of_text

_SECTION: Final = "trajectories"
_AXES: Final = ["X", "Y", "Z"]
#: Number of lines from the name of the section to the first frame.
_HEAD: Final = 5
#: Plausible rates of cameras (Hz), with a wide margin.
_RATES: Final = (1.0, 1e7)


@dataclass(frozen=True, slots=True)
class _Section:
    """The lines of the trajectories, and the number of each in the file, from 1."""

    source: str
    lines: list[str]
    rows: list[int]
    delimiter: str

    def cells(self, i: int) -> list[str]:
        return [cell.strip().strip('"') for cell in self.lines[i].split(self.delimiter)]


def is_nexus_csv(text: str) -> bool:
    """Whether a text has a section of trajectories."""
    return _find(text.splitlines()) is not None


def read_nexus_csv(path: Path, text: str, *, unit: str | None = None) -> Markers:
    """Read the trajectories from the text of an export.

    Args:
        path: the file of the text
        text: all of it
        unit: unit of the coordinates, overriding the one in the file

    Returns:
        the markers; `rows` are line numbers; time is zero at the first frame

    Raises:
        RecordError: the section is not as above, a cell is not a number, a unit is unknown, or frames are
            missing or out of order
    """
    section = _section(str(path), text)
    if not text.endswith("\n"):
        _require_whole_end(section)
    names, columns = _markers(section)
    units = section.cells(4)
    factors = [
        length_factor(section.source, unit or _cell(units, column), f"{name} {axis}")
        for name, first in zip(names, columns, strict=True)
        for axis, column in zip(_AXES, range(first, first + 3), strict=True)
    ]
    rate = _rate(section)
    values = _numbers(section)
    rows = np.array(section.rows[_HEAD:], dtype=np.int64)
    frames = values[:, 0]
    _require_consecutive(section, frames, rows)
    wanted = [column for first in columns for column in range(first, first + 3)]
    positions = (values[:, wanted] * np.array(factors)).reshape(len(values), len(names), 3)
    positions[np.isnan(positions).any(axis=2)] = np.nan
    return Markers(section.source, names, (frames - frames[0]) / rate, positions, rows=rows)


def _find(lines: list[str]) -> int | None:
    for i, line in enumerate(lines):
        if line.strip(DELIMITERS + ' "').casefold() == _SECTION:
            return i
    return None


def _section(source: str, text: str) -> _Section:
    lines = text.splitlines()
    start = _find(lines)
    assert start is not None, "is_nexus_csv() was not asked"
    rows = list(_rows_of_section(lines, start))
    if len(rows) <= _HEAD:
        reason = f"has no frames under {lines[start].strip()!r}"
        raise RecordError(source, reason, "was it truncated? Export it again", rows=[start + 1])
    titles = lines[start + 3]
    found = [lines[i] for i in rows]
    return _Section(source, found, [i + 1 for i in rows], max(DELIMITERS, key=titles.count))


def _rows_of_section(lines: list[str], start: int) -> Iterator[int]:
    """Indices of the lines of a section that have content.

    The section ends at the first line without content that no line with a number in its first cell follows:
    frames that were deleted in a spreadsheet leave rows of empty cells, but another section has a name.
    """
    is_open = True
    for i in range(start, len(lines)):
        line = lines[i].strip(DELIMITERS + ' "')
        if not line:
            if i - start < _HEAD:
                return
            is_open = False
        elif is_open or is_number_text(re.split(f'["{DELIMITERS}]', line)[0].strip()):
            is_open = True
            yield i
        else:
            return


def _markers(section: _Section) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Names of the markers and the columns of their X coordinates."""
    axes, names = section.cells(3), section.cells(2)
    columns = tuple(i for i in range(2, len(axes)) if axes[i : i + 3] == _AXES)
    if axes[:1] != ["Frame"] or not columns:
        raise RecordError(
            section.source,
            "has no columns Frame and X, Y, Z",
            "export trajectories from Nexus as ASCII, with commas between the columns",
            rows=[section.rows[3]],
            value=repr(section.lines[3][:40]),
        )
    found = tuple(_cell(names, column) for column in columns)
    if not all(found):
        nameless = columns[found.index("")]
        reason = f"has no name above column {nameless + 1}"
        raise RecordError(section.source, reason, "label every marker", rows=[section.rows[2]])
    return found, columns


def _cell(cells: list[str], column: int) -> str:
    return cells[column] if column < len(cells) else ""


def _require_whole_end(section: _Section) -> None:
    lines = section.lines[_HEAD:]
    last = [line.rpartition(section.delimiter)[2].strip() for line in lines]
    is_whole = bool(lines) and lines[-1].count(section.delimiter) + 1 == len(section.cells(3))
    if is_whole and is_cut_short(last):
        raise cut_short(section.source, "", section.rows[-1:], last[-1])


def _rate(section: _Section) -> float:
    text = ",".join(section.cells(1)).rstrip(",")
    try:
        rate = number_of_text(text)
    except ValueError:
        rate = math.nan
    slowest, fastest = _RATES
    if not slowest <= rate <= fastest:
        advice = f"the line under the name of the section is the rate in Hz, from {slowest:g} to {fastest:g}"
        raise RecordError(section.source, "has no rate", advice, rows=[section.rows[1]], value=repr(text))
    return rate


def _numbers(section: _Section) -> FloatArray:
    """All cells of the frames, shape (frames, columns), NaN where empty."""
    width = len(section.cells(3))
    lines = [line.rstrip(f"{section.delimiter} ") for line in section.lines[_HEAD:]]
    for i, (line, whole) in enumerate(zip(lines, section.lines[_HEAD:], strict=True), start=_HEAD):
        fewest, most = whole.count(section.delimiter) + 1, line.count(section.delimiter) + 1
        if fewest < width or most > width:
            reason = f"has {max(most, min(fewest, width))} cells, its head has {width}"
            advice = "was the file cut off, or are the decimal marks commas? Export it with decimal points"
            raise RecordError(section.source, reason, advice, rows=[section.rows[i]])
    try:
        body = io.StringIO("\n".join(lines))
        table = pd.read_csv(body, sep=section.delimiter, header=None, names=range(width), dtype=np.float64)
    except ValueError:
        raise _no_number(section) from None
    return table.to_numpy(dtype=np.float64)


def _no_number(section: _Section) -> RecordError:
    """Find the cell that is not a number."""
    names, axes = section.cells(2), section.cells(3)
    for i in range(_HEAD, len(section.lines)):
        for column, cell in enumerate(section.cells(i)):
            try:
                number_of_text(cell or "nan")
            except ValueError:
                above = max((k for k in range(column + 1) if _cell(names, k)), default=0)
                decimal = "," in cell
                return RecordError(
                    section.source,
                    "is not a number",
                    "export with decimal points, not commas"
                    if decimal
                    else "write a number or leave it empty",
                    column=f"{_cell(names, above)} {_cell(axes, column)}".strip(),
                    rows=[section.rows[i]],
                    value=repr(cell),
                )
    return RecordError(section.source, "has cells that are not numbers", "export it again")


def _require_consecutive(section: _Section, frames: FloatArray, rows: np.ndarray) -> None:
    wrong = np.flatnonzero(~np.isfinite(frames))
    if not wrong.size:
        wrong = np.flatnonzero(np.diff(frames) < 1.0) + 1
    if wrong.size:
        raise RecordError(
            section.source,
            "the frame does not come after the one before",
            "export the frames of one recording in order",
            column="Frame",
            rows=rows[wrong],
            value=f"{frames[wrong[0]]:g}",
        )
