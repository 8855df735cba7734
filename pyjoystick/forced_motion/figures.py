"""Figures of forced motions: torque and its parts over time (Fig. 15), and the load over a shift."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.forced_motion.work_cycle import PERCENTAGES, Demand
from pyjoystick.model import LawName
from pyjoystick.support import LAWS, SERIES, ParameterError, dress, legend_above

_PANELS: Final = (
    ("T_stiffness", "(a)  Stiffness"),
    ("T_damping", "(b)  Damping"),
    ("T_inertia", "(c)  Inertia"),
    ("T", "(d)  Total"),
)


def plot_torque(tables: Mapping[LawName, pd.DataFrame]) -> Figure:
    """Plot stiffness, damping, inertia and total torque over time, as in Fig. 15; all but (b) share a scale.

    Args:
        tables: from `torque_by_fmu` or `torque_by_reference`, one for each damping law; parts that do not
            depend on the law are drawn once

    Raises:
        ParameterError: no table
        ParameterError: no table
    """
    if not tables:
        raise ParameterError("tables", "no table", "one or two")
    figure = Figure(figsize=(7.4, 5.4), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True).ravel()
    for panel, (column, name) in zip(panels, _PANELS, strict=True):
        if column in ("T_stiffness", "T_inertia"):
            table = next(iter(tables.values()))
            panel.plot(table.index, table[column], **SERIES[0])
        else:
            for law, table in tables.items():
                panel.plot(table.index, table[column], label=f"{law} damping", **LAWS[law])
            if column == "T_damping" and "T_friction" in table:
                panel.plot(table.index, table["T_friction"], label="dry friction", **SERIES[2])
        panel.set_title(name, loc="left", fontsize="medium")
        dress(panel, zero=True)
    whole = [panel for panel, (column, _) in zip(panels, _PANELS, strict=True) if column != "T_damping"]
    low = min(panel.get_ylim()[0] for panel in whole)
    high = max(panel.get_ylim()[1] for panel in whole)
    for panel in whole:
        panel.set_ylim(low, high)
    for panel in panels[::2]:
        panel.set_ylabel("Torque (N m)")
    for panel in panels[2:]:
        panel.set_xlabel("Time (s)")
    first = next(iter(tables.values()))
    panels[0].set_xlim(float(first.index[0]), float(first.index[-1]))
    legend_above(figure, panels)
    return figure


def plot_demands(groups: Mapping[str, Mapping[str, Demand]], *, title: str = "") -> Figure:
    """Plot the fraction of time for which the force stays below a level, one panel per group of variants.

    Args:
        groups: demands by label, by name of the group
        title: title of the figure

    Raises:
        ParameterError: no group, or more variants in one than there are line styles
    """
    if not groups or max(map(len, groups.values())) > len(SERIES):
        raise ParameterError("groups", f"{len(groups)} groups", f"one or more, of up to {len(SERIES)} each")
    figure = Figure(figsize=(7.4, 3.4), layout="constrained")
    panels = figure.subplots(1, len(groups), sharex=True, sharey=True, squeeze=False)[0]
    for panel, (name, demands) in zip(panels, groups.items(), strict=True):
        for (label, demand), style in zip(demands.items(), SERIES, strict=False):
            force = np.array([demand.force(percentage) for percentage in PERCENTAGES])
            panel.plot(force, PERCENTAGES, label=label, **style)
        panel.set_title(name, loc="left", fontsize="medium")
        panel.set_xlabel("Force at the handle (N)")
        panel.legend(loc="lower right", frameon=False, fontsize="small")
        dress(panel)
    panels[0].set_xlim(left=0.0)
    panels[0].set_ylim(0.0, 100.0)
    panels[0].set_ylabel("Part of the time below (%)")
    if title:
        figure.suptitle(title, fontsize="medium")
    return figure
