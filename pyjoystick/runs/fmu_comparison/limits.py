"""How far two runs of the same thing may lie apart."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import FmuDescription
from pyjoystick.support import positive

#: Largest difference of a variable in parts of its largest value, where no other limit is set. Through CVode
#: at a tolerance of 1e-10, FMUs of one joystick lie up to 2e-5 apart: C of eq. (11), steep about the middle.
RELATIVE_LIMIT: Final = 1e-4

# The error of an angle is judged in parts of tolerance times the largest angle, but of 0.1 rad at least: to
# that, the FMUs' nominal value, integrators scale their absolute tolerance. Measured over 640 releases from
# 0.1 to 85 degrees and tolerances from 1e-4 to 1e-10: co-simulation up to 12 with constant damping, and with
# eq. (11) up to 160 (once 580, at 1e-5), for its coefficient has a peak and a dip within 1e-4 rad of the
# middle, which an integrator can step across unseen. CVode, which begins anew at each of 150 events: up to
# 2e3 within the stops, 3e4 at 85 degrees.
_NOMINAL_ANGLE: Final = 0.1
CO_SIMULATION_CONSTANT: Final = 30.0
CO_SIMULATION_POWER_LAW: Final = 200.0
MODEL_EXCHANGE: Final = 3e4
# Ten times what the pure-Python reference itself is good for (rad).
_LEAST_ANGLE_LIMIT: Final = 1e-9

# Where a variable stays below this part of its nominal value, it is taken for that: rounding about zero is no
# difference.
_SMALLEST_PART: Final = 1e-6


def angle_limit(theta: pd.Series[float], tolerance: float, factor: float) -> float:
    """Largest difference (rad) of an angle that an integrator's errors explain.

    Args:
        theta: the angle over a run (rad)
        tolerance: of the integrator
        factor: largest error in parts of tolerance times angle, such as `CO_SIMULATION_CONSTANT`
    """
    largest = max(float(np.max(np.abs(theta))), _NOMINAL_ANGLE)
    return max(factor * tolerance * largest, _LEAST_ANGLE_LIMIT)


def relative_limits(
    part: float, tables: Sequence[pd.DataFrame], fmus: Sequence[FmuDescription]
) -> dict[str, float]:
    """A limit for each column of the tables in parts of its largest value.

    Args:
        part: the part that is allowed
        tables: runs with the same columns
        fmus: what says the nominal values, each FMU's where it has the variable

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
