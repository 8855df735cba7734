"""Records of the synthetic testing machine."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np

from pyjoystick.laboratory import LoadCurve, MachineErrors, synthetic_load_cycle
from pyjoystick.model import SegmentTable
from pyjoystick.support import FloatArray

MACHINE = MachineErrors()


def cycle(
    table: SegmentTable, seed: int, *, step: float = 3e-6, slack: tuple[float, float] = (0.0, 0.0)
) -> tuple[FloatArray, FloatArray]:
    """Travel (m) and force (N) of one record, by the seed of its noise."""
    errors = dataclasses.replace(MACHINE, slack=slack)
    return synthetic_load_cycle(table, random=np.random.default_rng(seed), errors=errors, step=step)


def curve(
    table: SegmentTable, seed: int, *, step: float = 3e-6, slack: tuple[float, float] = (0.0, 0.0)
) -> LoadCurve:
    """The same as a curve."""
    return LoadCurve.from_cycle(*cycle(table, seed, step=step, slack=slack))


def write(path: Path, travel: FloatArray, force: FloatArray, heading: str = "travel (mm);force (N)") -> Path:
    """A file as such machines write it."""
    rows = [f"{1e3 * x:.6f};{f:.4f}" for x, f in zip(travel, force, strict=True)]
    path.write_text("\n".join(("# synthetic", heading, *rows)) + "\n", encoding="utf-8")
    return path
