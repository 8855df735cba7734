"""Where the damping function of eq. (11) jumps, Fig. 13, and which constant stands for it."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.model.reference.trajectory import Trajectory

#: Samples to either side of an instant that count as its neighborhood.
_NEAR: Final = 2


def damping_jumps(run: Trajectory) -> pd.DataFrame:
    """The largest change of C between neighboring samples around each zero of the angle and of the velocity.

    Eq. (11) jumps, or with negative exponents grows without bound, where theta = 0 and where omega = 0, so
    that a figure shows what its samples happen to meet: the paper's are 1 ms apart.

    Args:
        run: a motion without torque, sampled evenly

    Returns:
        one row a zero in order of time: ``time`` (s), ``zero`` (``theta`` or ``omega``), ``amplitude``
        (rad; of the turning point that comes before, or is there) and ``jump`` (N m s/rad)
    """
    changes = np.abs(np.diff(run.C))
    middles = [(event.time, "theta", math.nan) for event in run.events if event.kind == "theta = 0"]
    turns = [(point.time, "omega", abs(point.theta)) for point in run.turning_points]
    amplitude = abs(float(run.theta[0]))
    rows = []
    for time, zero, height in sorted(middles + turns):
        amplitude = amplitude if math.isnan(height) else height
        at = int(np.searchsorted(run.time, time))
        near = changes[max(at - 1 - _NEAR, 0) : at + _NEAR]
        rows.append({"time": time, "zero": zero, "amplitude": amplitude, "jump": float(np.max(near))})
    return pd.DataFrame(rows)


def mean_damping(run: Trajectory) -> float:
    """The mean of C over time (N m s/rad)."""
    return float(np.trapezoid(run.C, run.time) / (run.time[-1] - run.time[0]))


def equivalent_damping(run: Trajectory) -> float:
    """The constant that takes as much energy along the same motion (N m s/rad).

    As dE/dt = -C*omega^2, it is what the energy falls by over the integral of omega^2.
    """
    return float((run.E[0] - run.E[-1]) / np.trapezoid(run.omega**2, run.time))
