"""Angles and motions as CSV files that `pyjoystick.motion.read_record` reads."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from pyjoystick.laboratory.measurements.accelerometer import AngularAcceleration
from pyjoystick.laboratory.measurements.chain import Motion
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray, write_text


def write_record(record: Record, path: Path, comments: Iterable[str]) -> None:
    """Write time and angle, as measured; raises OutputFileError.

    Args:
        record: the angle
        path: the file
        comments: lines that stand before the headings
    """
    _write(path, {"time (s)": record.time, "theta (rad)": record.theta}, comments)


def write_motion(motion: Motion, path: Path, comments: Iterable[str]) -> None:
    """Write what came out of the chain; instants in gaps that are not bridged are left out.

    The column ``bridged`` is 1 inside gaps that are. Raises OutputFileError.
    """
    known = np.isfinite(motion.theta)
    columns = {
        "time (s)": motion.time,
        "theta (rad)": motion.theta,
        "omega (rad/s)": motion.omega,
        "alpha (rad/s2)": motion.alpha,
        "bridged": motion.bridged.astype(np.float64),
    }
    _write(path, {name: values[known] for name, values in columns.items()}, comments)


def write_acceleration(found: AngularAcceleration, path: Path, comments: Iterable[str]) -> None:
    """Write the angular acceleration where the angle is known; raises OutputFileError."""
    known = np.isfinite(found.alpha)
    _write(path, {"time (s)": found.time[known], "alpha (rad/s2)": found.alpha[known]}, comments)


def _write(path: Path, columns: Mapping[str, FloatArray], comments: Iterable[str]) -> None:
    rows = zip(*(series.tolist() for series in columns.values()), strict=True)
    lines = [
        *(f"# {line}" for comment in comments for line in comment.splitlines()),
        ",".join(columns),
        *(",".join(f"{value:.12g}" for value in row) for row in rows),
    ]
    write_text(path, "\n".join(lines) + "\n")
