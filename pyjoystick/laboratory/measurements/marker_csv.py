"""Markers from plain CSV: ``time (s),TOP x (mm),TOP y (mm),TOP z (mm),...``, one frame a row."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.laboratory.measurements.markers import Markers, length_factor
from pyjoystick.motion import CsvFile, Heading, RecordError, read_csv_file

_AXES: Final = "xyz"
_COLUMN: Final = re.compile(r"(?P<marker>.*\S)[\s._:](?P<axis>[xyzXYZ])")
_TIME_UNITS: Final = {"s": 1.0, "ms": 1e-3}


def read_marker_csv(path: Path, *, unit: str | None = None) -> Markers:
    """Read markers from a file of columns.

    A marker's name and its axis are set apart by a blank, ``.``, ``_`` or ``:``.

    Args:
        path: the file
        unit: unit of the coordinates, for headings that have none

    Returns:
        the markers; empty cells are NaN, `rows` are line numbers

    Raises:
        RecordError: the file cannot be read as columns of numbers, has no time or no markers, a marker lacks
            an axis, a unit is unknown, or the time does not increase
    """
    file = read_csv_file(path)
    if len(file.headings) == 1:
        advice = "separate them by commas, semicolons or tabs"
        raise RecordError(str(path), "has a single column", advice, rows=[file.lines[0] - 1])
    time, headings = _time(file), _markers(file)
    positions = np.empty((len(file.cells), len(headings), 3))
    for i, axes in enumerate(headings.values()):
        for k, axis in enumerate(_AXES):
            heading = axes[axis]
            factor = length_factor(str(path), heading.unit or unit or "", heading.text)
            positions[:, i, k] = file.numbers(heading) * factor
    positions[~np.isfinite(positions).all(axis=2)] = np.nan
    return Markers(str(path), tuple(headings), time, positions, rows=file.lines)


def _markers(file: CsvFile) -> dict[str, dict[str, Heading]]:
    """Headings by marker and axis."""
    found: dict[str, dict[str, Heading]] = {}
    for heading in file.headings:
        match = _COLUMN.fullmatch(heading.name)
        if match:
            found.setdefault(match["marker"], {})[match["axis"].lower()] = heading
    if not found:
        advice = "name the columns as in: time (s),TOP x (mm),TOP y (mm),TOP z (mm)"
        texts = ", ".join(repr(heading.text) for heading in file.headings)
        raise RecordError(str(file.path), "has no columns of markers", advice, value=texts)
    for marker, axes in found.items():
        for axis in _AXES:
            if axis not in axes:
                reason, advice = f"lacks {axis} of marker {marker!r}", "export all three coordinates"
                raise RecordError(str(file.path), reason, advice)
    return found


def _time(file: CsvFile) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    candidates = [heading for heading in file.headings if heading.name.casefold() in ("time", "t")]
    if not candidates:
        advice = "add a column time (s)"
        raise RecordError(str(file.path), "has no column 'time'", advice)
    heading = candidates[0]
    if heading.unit not in _TIME_UNITS:
        advice = f"write time (s) or time (ms); known are {', '.join(_TIME_UNITS)}"
        reason = "has an unknown unit" if heading.unit else "has no unit"
        raise RecordError(str(file.path), reason, advice, column=heading.text, value=heading.unit or None)
    time = file.numbers(heading) * _TIME_UNITS[heading.unit]
    bad = np.flatnonzero(~np.isfinite(time))
    if bad.size:
        advice = "delete these rows, or export the time of every frame"
        raise RecordError(str(file.path), "has no time", advice, column=heading.text, rows=file.lines[bad])
    return time
