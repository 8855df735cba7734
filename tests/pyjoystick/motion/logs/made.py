"""Logs of one motion, in the formats of laboratory tools."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyjoystick.support import FloatArray

COUNT = 120
#: A motion at 250 Hz that begins at 0: time (s), angle (deg), torque (N m).
TIME: FloatArray = np.arange(COUNT) / 250.0
ANGLE: FloatArray = np.round(18.0 * np.sin(9.0 * TIME) + 2.0 * np.cos(31.0 * TIME), 6)
TORQUE: FloatArray = np.round(2.0 * np.cos(9.0 * TIME), 6)


def text(
    names: Sequence[str],
    *columns: Sequence[object] | FloatArray,
    delimiter: str = ",",
    decimal: str = ".",
    digits: int = 9,
    before: str = "",
    newline: str = "\n",
) -> str:
    """A table as the csv module writes it."""
    opened = io.StringIO()
    writer = csv.writer(opened, delimiter=delimiter, lineterminator=newline)
    if names:
        writer.writerow(names)
    for row in zip(*columns, strict=True):
        writer.writerow(
            f"{cell:.{digits}g}".replace(".", decimal) if isinstance(cell, float) else cell for cell in row
        )
    return before + opened.getvalue()


def written(path: Path, content: str, encoding: str = "utf-8") -> Path:
    path.write_bytes(content.encode(encoding))
    return path
