"""Synthetic records of a known load-deflection curve by a testing machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.model import SegmentTable, table_force
from pyjoystick.support import FloatArray

#: Travel at which the machine turns (m).
_TURN: Final = 3.6e-3


@dataclass(frozen=True, slots=True)
class MachineErrors:
    """Errors that the machine adds to the curve.

    Attributes:
        friction: half the force between loading and unloading (N)
        zero: reading of the load cell without load (N)
        travel_noise, force_noise: standard deviations of one sample's independent normal noise (m, N)
        slack: travel of the machine (m) at which the fixture slips during loading, and how far (m)
    """

    friction: float = 0.3
    zero: float = 0.1
    travel_noise: float = 1e-6
    force_noise: float = 0.05
    slack: tuple[float, float] = (0.0, 0.0)


def synthetic_load_cycle(
    table: SegmentTable,
    *,
    random: np.random.Generator,
    errors: MachineErrors | None = None,
    step: float = 3e-6,
) -> tuple[FloatArray, FloatArray]:
    """Travel (m) and force (N) of loading and unloading, each of shape (n,), in the order of the record.

    Args:
        table: the curve
        random: random generator for the noise
        errors: errors of the machine; by default those of `MachineErrors`
        step: travel between two samples (m)
    """
    machine = errors or MachineErrors()
    up = np.arange(0.0, _TURN, step)
    down = up[::-1]
    at, by = machine.slack
    loading = table_force(table, up - np.where(up > at, by, 0.0))
    loading = loading + machine.friction * (loading > 0.0)
    unloading = np.maximum(table_force(table, down - by) - machine.friction, 0.0)
    travel, force = np.concatenate((up, down)), np.concatenate((loading, unloading)) + machine.zero
    travel += machine.travel_noise * random.standard_normal(travel.size)
    force += machine.force_noise * random.standard_normal(force.size)
    return travel, force
