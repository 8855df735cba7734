"""Markers from a file of any kind that is known, told apart by what is in it."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from pyjoystick.laboratory.measurements.c3d_file import read_c3d
from pyjoystick.laboratory.measurements.marker_csv import read_marker_csv
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.laboratory.measurements.nexus_csv import is_nexus_csv, read_nexus_csv
from pyjoystick.motion import RecordError


def read_markers(path: str | PathLike[str], *, unit: str | None = None) -> Markers:
    """Read marker trajectories from C3D, the CSV export of Vicon Nexus, or plain CSV.

    Args:
        path: the file; ``.c3d`` names a C3D file, anything else is text
        unit: unit of the coordinates (m, cm or mm), in place of the file's own in C3D and Nexus files, and
            for headings without one in plain CSV

    Raises:
        RecordError: the file is none of these or cannot be used; see `read_c3d`, `read_nexus_csv` and
            `read_marker_csv`
    """
    file = Path(path)
    if file.suffix.casefold() == ".c3d":
        return read_c3d(file, unit=unit)
    try:
        text = file.read_text(encoding="utf-8-sig")
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise RecordError(str(path), reason, "check the path and its permissions") from error
    except UnicodeDecodeError as error:
        advice = "name a C3D file .c3d, export a table as CSV in UTF-8"
        raise RecordError(str(path), "is no text in UTF-8", advice) from error
    return read_nexus_csv(file, text, unit=unit) if is_nexus_csv(text) else read_marker_csv(file, unit=unit)
