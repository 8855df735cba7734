"""Marker trajectories from C3D, the CSV export of Vicon Nexus, or plain CSV, detected by content.

Plain CSV has one frame per row: ``time (s),TOP x (mm),TOP y (mm),TOP z (mm),...``
"""

from __future__ import annotations

import logging
import re
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.laboratory.measurements.c3d_file import read_c3d
from pyjoystick.laboratory.measurements.lost_markers import without_lost
from pyjoystick.laboratory.measurements.markers import Markers, length_factor
from pyjoystick.laboratory.measurements.nexus_csv import is_nexus_csv, read_nexus_csv
from pyjoystick.motion import TIME, Heading, RecordError, TableHead, open_text, read_table_file

_LOG = logging.getLogger(__name__)

_TIME: Final = replace(TIME, advice="delete these rows, or export the time of every frame")
_AXES: Final = "xyz"
#: First characters of every CSV file of OptiTrack's Motive.
_MOTIVE: Final = "Format Version,"
_COLUMN: Final = re.compile(r"(?P<marker>.*\S)[\s._:](?P<axis>[xyzXYZ])")


def read_markers(path: str | PathLike[str], *, unit: str | None = None) -> Markers:
    """Read marker trajectories from C3D, the CSV export of Vicon Nexus, or plain CSV.

    A marker that jumps to exactly 0, 0, 0 counts as lost there, with a note (see `without_lost`).

    Args:
        path: the file; ``.c3d`` means a C3D file, anything else is text
        unit: unit of the coordinates, a length of `UNITS`, overriding the file's own in C3D and Nexus files,
            and for headings without a unit in plain CSV

    Raises:
        RecordError: the file is none of these or cannot be used; see `read_c3d`, `read_nexus_csv` and
            `read_marker_csv`
    """
    file = Path(path)
    if file.suffix.casefold() == ".c3d":
        return _told(without_lost(read_c3d(file, unit=unit)))
    with open_text(file, "name a C3D file .c3d, export a table as CSV in UTF-8") as opened:
        text = opened.read()
    if text.startswith(_MOTIVE):
        advice = "export the take as C3D, which Motive writes too"
        raise RecordError(str(file), "is the CSV export of OptiTrack Motive, which is not read", advice)
    read = read_nexus_csv(file, text, unit=unit) if is_nexus_csv(text) else read_marker_csv(file, unit=unit)
    return _told(without_lost(read))


def _told(markers: Markers) -> Markers:
    """Log the markers and return them."""
    names = ", ".join(markers.names)
    _LOG.info("read %s: %d frames at %g Hz of %s", markers.source, len(markers.time), markers.rate, names)
    return markers


def read_marker_csv(path: Path, *, unit: str | None = None) -> Markers:
    """Read markers from a table.

    A marker's name and its axis are separated by a space, ``.``, ``_`` or ``:``.

    Args:
        path: the file
        unit: unit of the coordinates, for headings without one

    Returns:
        the markers; empty cells are NaN, `rows` are line numbers

    Raises:
        RecordError: the file is not a table of numbers, has no time or no markers, a marker lacks an axis, a
            unit is unknown, or the time does not increase
    """
    file = read_table_file(path)
    time, headings = file.read([_TIME])["time"], _markers(file.head)
    positions = np.empty((len(file.rows), len(headings), 3))
    for i, axes in enumerate(headings.values()):
        for k, axis in enumerate(_AXES):
            factor = length_factor(str(path), axes[axis].unit or unit or "", axes[axis].text)
            positions[:, i, k] = file.numbers(axes[axis]) * factor
    positions[np.isnan(positions).any(axis=2)] = np.nan
    return Markers(str(path), tuple(headings), time, positions, rows=file.rows)


def _markers(head: TableHead) -> dict[str, dict[str, Heading]]:
    """Headings by marker and axis."""
    found: dict[str, dict[str, Heading]] = {}
    for heading in head.headings:
        match = _COLUMN.fullmatch(heading.name)
        if match:
            marker, axis = match["marker"], match["axis"].lower()
            first = found.setdefault(marker, {}).setdefault(axis, heading)
            if first is not heading:
                reason = f"has {axis} of marker {marker!r} twice, in {first.text!r} and in {heading.text!r}"
                raise RecordError(str(head.path), reason, "delete or rename one of them", rows=[head.line])
    if not found:
        advice = "name the columns as in: time (s),TOP x (mm),TOP y (mm),TOP z (mm)"
        texts = ", ".join(repr(heading.text) for heading in head.headings)
        raise RecordError(str(head.path), "has no columns of markers", advice, rows=[head.line], value=texts)
    for marker, axes in found.items():
        for axis in _AXES:
            if axis not in axes:
                reason, advice = f"lacks {axis} of marker {marker!r}", "export all three coordinates"
                raise RecordError(str(head.path), reason, advice, rows=[head.line])
    return found
