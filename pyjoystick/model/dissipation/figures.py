"""Figures of the energy over time, with its plateaus, and of the damping function (Figs. 12 and 13)."""

from __future__ import annotations

import math
from typing import Final

import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.model.reference.trajectory import Trajectory
from pyjoystick.support import BLACK, GRAY, LAWS, SKY, SOLID, dress, legend_above

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
    below.set_xlabel("Time after the release (s)")
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
    below.set_xlabel("Time after the release (s); vertical lines where it turns")
    below.set_xlim(0.0, float(run.time[-1]))
    dress(above)
    dress(below, zero=True)
    for axes in (above, below):
        axes.grid(visible=False, axis="x")
    figure.align_ylabels([above, below])
    legend_above(figure, above, title=title)
    return figure
