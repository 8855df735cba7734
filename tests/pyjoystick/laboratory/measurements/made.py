"""Files and motions shared by several tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

NAMES = ("TOP", "BASE1", "BASE2")


def scattered(frames: int = 40, markers: int = 3, seed: int = 5) -> NDArray[np.float64]:
    """Points (mm) that single precision holds exactly, with marker 1 lost in frames 10 to 13."""
    random = np.random.default_rng(seed)
    points = np.round(random.normal(0.0, 300.0, (frames, markers, 3)) * 8.0) / 8.0
    points[10:14, 1] = np.nan
    return points


def swing(time: NDArray[np.float64]) -> NDArray[np.float64]:
    """A decaying oscillation from -18 degrees that is at rest at zero in the end (rad)."""
    return np.asarray(-np.radians(18.0) * np.exp(-2.2 * time) * np.cos(2.0 * np.pi * 2.0 * time))


def nexus_text(
    points: NDArray[np.float64], *, rate: float = 60.0, unit: str = "mm", names: tuple[str, ...] = NAMES
) -> str:
    """The text of a Nexus export of points (frames, markers, 3), with a section of devices before it."""
    cells = ["" if np.isnan(value) else f"{value:.12g}" for value in points.ravel()]
    width = 3 * len(names)
    rows = [",".join([str(i + 1), "0", *cells[i * width : (i + 1) * width]]) for i in range(len(points))]
    head = [
        "Devices",
        "1200",
        "Frame,Sub Frame,Voltage",
        "1,0,0.5",
        "",
        "Trajectories",
        f"{rate:g}",
        "," + "".join(f",Joystick:{name},," for name in names),
        "Frame,Sub Frame" + ",X,Y,Z" * len(names),
        "," + f",{unit}" * width,
    ]
    return "\n".join([*head, *rows, ""])


def plain_text(time: NDArray[np.float64], points: NDArray[np.float64], *, unit: str = "mm") -> str:
    """Plain CSV of points (frames, 3 markers, 3)."""
    head = ",".join(["time (s)", *(f"{name} {axis} ({unit})" for name in NAMES for axis in "xyz")])
    rows = [
        ",".join([f"{instant:.9g}", *("" if np.isnan(value) else f"{value:.12g}" for value in frame.ravel())])
        for instant, frame in zip(time, points, strict=True)
    ]
    return "\n".join([head, *rows, ""])


def write(path: Path, text: str) -> Path:
    """The path of a text file with this text."""
    path.write_text(text, encoding="utf-8")
    return path
