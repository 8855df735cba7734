"""Figures of a shaken joystick: its branches over the free parameter, and its attractors."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyjoystick.forced_motion.response.attractors import Basins, PeriodicAttractor
from pyjoystick.forced_motion.response.branches import Response
from pyjoystick.forced_motion.response.shaken import FREQUENCY, TORQUE, ShakenJoystick
from pyjoystick.forced_motion.response.tables import branch_table, special_table, with_unit
from pyjoystick.model import JoystickParameters, NoOscillationError, undamped_oscillation
from pyjoystick.support import (
    AMBER,
    BLACK,
    BLUE,
    GRAY,
    LONG_DASHES,
    SKY,
    SOLID,
    VERMILION,
    FloatArray,
    dress,
    legend_above,
)

_MARKS: Final = {
    "fold": ("o", VERMILION),
    "period doubling": ("s", AMBER),
    "Neimark-Sacker": ("D", AMBER),
    "branch point": ("^", AMBER),
    "grazing": ("|", BLUE),
}


def backbone(joystick: JoystickParameters, amplitudes: FloatArray) -> pd.DataFrame:
    """Frequency of the undamped free oscillation over its amplitude.

    Args:
        joystick: the joystick; its damping is ignored
        amplitudes: forward release angles (rad), shape (n,)

    Returns:
        ``frequency`` (Hz) and ``amplitude`` (rad; half of the peak-to-peak angle), one row per release
        that swings across the middle
    """
    rows = []
    for release in amplitudes:
        try:
            found = undamped_oscillation(joystick, float(release))
        except NoOscillationError:
            continue
        rows.append((1.0 / found.period, 0.5 * (found.forward + found.backward)))
    return pd.DataFrame(rows, columns=["frequency", "amplitude"])


def plot_response(response: Response) -> Figure:
    """Plot amplitude over the free parameter, dashed for unstable motions; for frequency, also the backbone.

    Args:
        response: the branches
    """
    figure = Figure(figsize=(7.4, 4.8), layout="constrained")
    axes = figure.subplots()
    free, (low, high) = response.shaken.free, response.limits
    table = branch_table(response)
    if free == FREQUENCY:
        free_motion = backbone(response.shaken.joystick, np.radians(np.geomspace(0.19, 60.0, 400)))
        inside = free_motion["frequency"].between(low, high)
        shown = free_motion.where(inside)
        degrees = np.degrees(shown["amplitude"])
        axes.plot(shown["frequency"], degrees, color=GRAY, linewidth=2.0, label="undamped, free")
    for _, branch in table.groupby("branch"):
        _draw_branch(axes, branch, free)
    special = special_table(response)
    kinds = special["kind"].str.replace(r"^grazing .*", "grazing", regex=True)
    for kind, (marker, color) in _MARKS.items():
        points = special[kinds == kind]
        if len(points):
            degrees = np.degrees(points["amplitude"])
            axes.plot(points[free], degrees, marker, color=color, markersize=5, label=kind)
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xlim(low, high)
    label = with_unit(free)
    axes.set_xlabel(label[0].upper() + label[1:] if free in (FREQUENCY, TORQUE) else label)
    axes.set_ylabel("Amplitude (deg)")
    dress(axes)
    legend_above(figure, axes, columns=4)
    return figure


def _draw_branch(axes: Axes, branch: pd.DataFrame, free: str) -> None:
    """Draw pieces of equal stability, each up to the first point of the next, to leave no gaps."""
    color = BLACK if branch["periods"].iloc[0] == 1 else SKY
    what = "" if branch["periods"].iloc[0] == 1 else f", {branch['periods'].iloc[0]} periods"
    values, degrees = branch[free].to_numpy(), np.degrees(branch["amplitude"].to_numpy())
    stable = branch["stable"].to_numpy()
    bounds = [0, *(np.flatnonzero(np.diff(stable)) + 1), len(stable)]
    for first, last in pairwise(bounds):
        piece = slice(first, last + 1)
        style, label = (SOLID, "stable") if stable[first] else (LONG_DASHES, "unstable")
        width = 1.6 if stable[first] else 1.1
        axes.plot(
            values[piece], degrees[piece], color=color, linestyle=style, linewidth=width, label=label + what
        )


def plot_attractors(found: Basins, shaken: ShakenJoystick) -> Figure:
    """Plot each attractor in the phase plane: periodic ones as curves, others as Poincare sections.

    Args:
        found: the attractors
        shaken: the joystick
    """
    figure = Figure(figsize=(7.4, 3.8), layout="constrained")
    panels = figure.subplots(1, len(found.attractors), squeeze=False)[0]
    for number, (panel, one) in enumerate(zip(panels, found.attractors, strict=True)):
        if isinstance(one, PeriodicAttractor):
            orbit = shaken.with_periods(one.periods).orbit(one.solution.state, shaken.value)
            panel.plot(np.degrees(orbit.theta), orbit.omega, color=BLACK, linewidth=1.4)
            first = one.solution.state
            panel.plot(math.degrees(first[0]), first[1], "o", color=VERMILION, markersize=5)
            title = f"periodic, {one.periods} T" if one.periods > 1 else "periodic, T"
        else:
            panel.plot(np.degrees(one.section[:, 0]), one.section[:, 1], ".", color=BLUE, markersize=2)
            title = "section once a period"
        panel.set_title(f"{title}: {100.0 * found.share(number):.0f} % of the releases", fontsize="medium")
        panel.set_xlabel("Displacement (deg)")
        dress(panel, zero=True)
    panels[0].set_ylabel("Velocity (rad/s)")
    return figure
