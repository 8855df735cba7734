"""Where a free oscillation loses its energy: the steps of Fig. 12 and the damping function of Fig. 13."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.model import Trajectory
from pyjoystick.support import BLACK, GRAY, LAWS, SKY, SOLID, dress, legend_above

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


_DEG: Final = math.degrees(1.0)
_MJ: Final = 1e3


def plot_energy(
    run: Trajectory, rests: pd.DataFrame, *, title: str = "", size: tuple[float, float] = (7.0, 5.4)
) -> Figure:
    """Energy over time with its plateaus shaded, and below it the power that the damping takes.

    Args:
        run: a free oscillation
        rests: its `plateaus`
        title: a line above the figure
        size: width and height (inch)
    """
    figure = Figure(figsize=size, layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    above.plot(run.time, run.E * _MJ, color=BLACK, linewidth=1.3, label="energy")
    below.plot(run.time, run.M_d * run.omega, color=BLACK, linewidth=1.1)
    for axes in (above, below):
        for i, (start, end) in enumerate(zip(rests["start"], rests["end"], strict=True)):
            label = "plateau, around a turning point" if i == 0 and axes is above else None
            axes.axvspan(start, end, color=SKY, alpha=0.45, linewidth=0.0, label=label)
        dress(axes)
        axes.set_ylim(bottom=0.0)
    above.set_ylabel("Energy (mJ)")
    below.set_ylabel("Power lost (W)")
    below.set_xlabel("Time (s)")
    below.set_xlim(0.0, float(run.time[-1]))
    figure.align_ylabels([above, below])
    legend_above(figure, above, title=title)
    return figure


def plot_damping_function(
    run: Trajectory,
    *,
    constant: float,
    equivalent: float,
    title: str = "",
    size: tuple[float, float] = (7.0, 5.4),
) -> Figure:
    """C over time beside constants, and below it the angle, which says where the jumps are.

    Args:
        run: a free oscillation with the power law
        constant: a constant C (N m s/rad) to compare with
        equivalent: the one that takes as much energy (N m s/rad), see `equivalent_damping`
        title: a line above the figure
        size: width and height (inch)
    """
    figure = Figure(figsize=size, layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    style = LAWS["power-law"] | {"linestyle": SOLID, "linewidth": 1.1}
    above.plot(run.time, run.C, label="damping function, eq. (11)", **style)
    above.axhline(constant, label=f"constant {constant:g}", **LAWS["constant"])
    above.axhline(equivalent, color=GRAY, linewidth=1.2, label=f"{equivalent:.3f}, takes as much energy")
    below.plot(run.time, run.theta * _DEG, color=BLACK, linewidth=1.1)
    for point in run.turning_points:
        for axes in (above, below):
            axes.axvline(point.time, color="0.85", linewidth=0.7, zorder=0)
    above.set_ylabel("C (N m s/rad)")
    above.set_ylim(bottom=0.0)
    below.set_ylabel("Displacement (deg)")
    below.set_xlabel("Time (s); vertical lines where it turns")
    below.set_xlim(0.0, float(run.time[-1]))
    dress(above)
    dress(below, zero=True)
    for axes in (above, below):
        axes.grid(visible=False, axis="x")
    figure.align_ylabels([above, below])
    legend_above(figure, above, title=title)
    return figure
