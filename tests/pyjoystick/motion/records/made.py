"""Synthetic records, each with one fault."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np

from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import FloatArray

RATE = 60.0
HOLD = 15  # samples before the release


@cache
def motion() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Time (s), theta (deg) and omega (rad/s) of a held and released joystick at 60 Hz."""
    time = np.arange(105) / RATE
    run = simulate(NOMINAL, time=time[HOLD:] - time[HOLD], theta_start=math.radians(-20.0))
    theta = np.concatenate((np.full(HOLD, -20.0), np.degrees(run.theta)))
    return time, theta, np.concatenate((np.zeros(HOLD), run.omega))


def rows(*columns: Sequence[object] | FloatArray) -> list[list[object]]:
    return [list(row) for row in zip(*columns, strict=True)]


def write(path: Path, table: list[list[object]], heading: str = "time (s),theta (deg)") -> Path:
    """A CSV file: row k of the table stands on line k + 2."""
    lines = [heading, *(",".join(str(cell) for cell in row) for row in table)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def written(folder: Path, change: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]) -> Path:
    """The motion with a fault in it, as a file."""
    time, theta, _ = motion()
    return write(folder / "made.csv", rows(*change(time.copy(), theta.copy())))
