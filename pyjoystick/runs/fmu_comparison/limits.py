"""Limits for the difference of two runs of the same model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import FmuDescription
from pyjoystick.support import positive

#: Default limit of a variable's difference, relative to its largest value. With CVode at tolerance 1e-10,
#: FMUs of one joystick differ by up to 2e-5 (C of eq. (11), which is steep about the middle).
RELATIVE_LIMIT: Final = 1e-4

# Errors of an angle are in units of tolerance times the largest angle, but at least 0.1 rad, the FMUs'
# nominal value, which scales the absolute tolerance of integrators. Measured over 640 releases from 0.1 to 85
# degrees and tolerances from 1e-4 to 1e-10: in Co-Simulation up to 12 with constant damping and 160 with
# eq. (11) (once 580, at 1e-5), whose coefficient has a peak and a dip within 1e-4 rad of the middle that an
# integrator can step across unseen. With CVode, which restarts at each of 150 events: up to 2e3 within the
# stops, and 3e4 at 85 degrees.
_NOMINAL_ANGLE: Final = 0.1
CO_SIMULATION_CONSTANT: Final = 30.0
CO_SIMULATION_POWER_LAW: Final = 200.0
MODEL_EXCHANGE: Final = 3e4
# Ten times the accuracy of the pure-Python reference (rad).
_LEAST_ANGLE_LIMIT: Final = 1e-9

# Variables that stay below this part of their nominal value are compared relative to that part, as rounding
# errors about zero are no difference.
_SMALLEST_PART: Final = 1e-6


def angle_limit(theta: pd.Series[float], tolerance: float, factor: float) -> float:
    """Largest difference (rad) of an angle that integration errors explain.

    Args:
        theta: the angle over a run (rad)
        tolerance: tolerance of the integrator
        factor: largest error in units of tolerance times angle, such as `CO_SIMULATION_CONSTANT`
    """
    largest = max(float(np.max(np.abs(theta))), _NOMINAL_ANGLE)
    return max(factor * tolerance * largest, _LEAST_ANGLE_LIMIT)


def relative_limits(
    part: float, tables: Sequence[pd.DataFrame], fmus: Sequence[FmuDescription]
) -> dict[str, float]:
    """Limit for each column of the tables, relative to its largest value.

    Args:
        part: the allowed part
        tables: runs with the same columns
        fmus: FMUs that provide the nominal values, if they have the variable

    Raises:
        ParameterError: the part is not above zero
    """
    positive("relative_limit", part)
    limits = {}
    for column in tables[0].columns:
        name = str(column)
        largest = [
            float(np.nanmax(np.abs(table[name].to_numpy(dtype=np.float64)), initial=0.0)) for table in tables
        ]
        nominal = [one.nominal for one in (fmu.find(name) for fmu in fmus) if one is not None]
        limits[name] = part * max(*largest, *(_SMALLEST_PART * value for value in nominal))
    return limits
