"""The steps of the energy of a free oscillation, Fig. 12: it falls in swings and rests where it turns."""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.model.reference.trajectory import Trajectory

#: The energy rests where it falls less than this part of as fast as it does at most in the swings beside it.
REST: Final = 0.05

_COLUMNS: Final = ["time", "theta", "energy", "start", "end", "lost", "swing_lost"]


def plateaus(run: Trajectory) -> pd.DataFrame:
    """The plateau around each turning point of a free oscillation that starts at rest.

    Args:
        run: a motion without torque, sampled finely: the ends of plateaus lie on its instants

    Returns:
        one row a turning point with a swing before and after it: ``time`` (s), ``theta`` (rad), ``energy``
        (J) there, ``start`` and ``end`` of the plateau (s), ``lost`` on it (J), and ``swing_lost`` (J), what
        the swing before the turning point takes from the energy; empty where no energy is taken
    """
    power = np.abs(run.M_d * run.omega)
    if not power.any():
        return pd.DataFrame(columns=_COLUMNS, dtype=np.float64)
    turns = np.array([run.time[0], *(point.time for point in run.turning_points)])
    at = np.searchsorted(run.time, turns)
    rows = []
    for (before, here), after in zip(pairwise(at), at[2:], strict=False):
        rest = REST * min(np.max(power[before:here]), np.max(power[here:after]))
        start = before + int(np.flatnonzero(power[before:here] >= rest)[-1]) + 1
        end = here + int(np.flatnonzero(power[here:after] >= rest)[0]) - 1
        rows.append(
            {
                "time": run.time[here],
                "theta": run.theta[here],
                "energy": run.E[here],
                "start": run.time[start],
                "end": run.time[end],
                "lost": run.E[start] - run.E[end],
                "swing_lost": run.E[before] - run.E[here],
            }
        )
    return pd.DataFrame(rows, columns=_COLUMNS, dtype=np.float64)
