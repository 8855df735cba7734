"""A synthetic testing machine: the reference's curve with friction, noise of both axes, and an offset."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pyjoystick._types import FloatArray
from pyjoystick.load_curve import LoadCurve
from pyjoystick.parameters import SegmentTable
from pyjoystick.reference import table_force

FRICTION = 0.3
ZERO = 0.1
TRAVEL_NOISE = 1e-6
FORCE_NOISE = 0.05


def cycle(
    table: SegmentTable,
    seed: int,
    *,
    step: float = 3e-6,
    end: float = 3.6e-3,
    slack: tuple[float, float] = (0.0, 0.0),
) -> tuple[FloatArray, FloatArray]:
    """Travel (m) and force (N) of loading and unloading.

    Args:
        table: the curve
        seed: of the noise
        step: between two samples (m)
        end: where the machine turns (m)
        slack: travel of the machine (m) at which the fixture slips while loading, and by how much (m)
    """
    up = np.arange(0.0, end, step)
    down = up[::-1]
    at, by = slack
    loading = table_force(table, up - np.where(up > at, by, 0.0))
    loading = loading + FRICTION * (loading > 0.0)
    unloading = np.maximum(table_force(table, down - by) - FRICTION, 0.0)
    random = np.random.default_rng(seed)
    travel, force = np.concatenate((up, down)), np.concatenate((loading, unloading)) + ZERO
    travel += TRAVEL_NOISE * random.standard_normal(travel.size)
    force += FORCE_NOISE * random.standard_normal(force.size)
    return travel, force


def curve(table: SegmentTable, seed: int, **options: float) -> LoadCurve:
    """The same as a curve."""
    return LoadCurve.from_cycle(*cycle(table, seed, **options))  # type: ignore[arg-type]


def write(path: Path, travel: FloatArray, force: FloatArray, heading: str = "travel (mm);force (N)") -> Path:
    """A file as such machines write it."""
    rows = [f"{1e3 * x:.6f};{f:.4f}" for x, f in zip(travel, force, strict=True)]
    path.write_text("\n".join(("# synthetic", heading, *rows)) + "\n", encoding="utf-8")
    return path
