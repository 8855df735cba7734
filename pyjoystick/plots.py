"""Figures of runs. They are Matplotlib `Figure` objects apart from pyplot, so nothing is kept or shown."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Final, Literal

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyjoystick.errors import OutputFileError, ParameterError, UnknownVariableError
from pyjoystick.output import replacing

AngleUnit = Literal["deg", "rad"]

#: Colors that the color-blind can tell apart (Okabe and Ito), with dashes that survive gray print.
_STYLES: Final = (
    {"color": "#000000", "linestyle": "-", "linewidth": 1.1},
    {"color": "#D55E00", "linestyle": (0, (6, 2)), "linewidth": 1.4},
    {"color": "#0072B2", "linestyle": (0, (2, 1.5)), "linewidth": 1.4},
    {"color": "#009E73", "linestyle": (0, (6, 1.5, 1.5, 1.5)), "linewidth": 1.4},
    {"color": "#CC79A7", "linestyle": (0, (1, 1)), "linewidth": 1.6},
)
_PANELS: Final = (
    ("theta", "Displacement", ""),
    ("omega", "Velocity", "/s"),
    ("alpha", "Acceleration", "/s²"),
)
_SUFFIXES: Final = (".png", ".pdf", ".svg")


def plot_motion(
    runs: Mapping[str, pd.DataFrame],
    *,
    angle_unit: AngleUnit = "deg",
    title: str = "",
    size: tuple[float, float] = (7.0, 6.4),
) -> Figure:
    """Displacement, velocity and acceleration over time, one above the other, as in Fig. 10 of the paper.

    Args:
        runs: tables with the columns ``theta`` (rad), ``omega`` (rad/s), ``alpha`` (rad/s2), by label
        angle_unit: ``deg`` or ``rad``
        title: a line above the figure
        size: width and height (inch)

    Raises:
        ParameterError: no run, more runs than there are line styles, or an unknown unit
        UnknownVariableError: a table lacks a column
    """
    if not 1 <= len(runs) <= len(_STYLES):
        raise ParameterError("runs", f"{len(runs)} runs", f"1 to {len(_STYLES)} runs")
    if angle_unit not in ("deg", "rad"):
        raise ParameterError("angle_unit", angle_unit, "'deg' or 'rad'")
    factor = math.degrees(1.0) if angle_unit == "deg" else 1.0
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(len(_PANELS), 1, sharex=True)
    for panel, (column, name, per) in zip(axes, _PANELS, strict=True):
        for (label, table), style in zip(runs.items(), _STYLES, strict=False):
            if column not in table.columns:
                raise UnknownVariableError(column, map(str, table.columns))
            panel.plot(table.index, table[column] * factor, label=label, **style)
        panel.set_ylabel(f"{name} ({angle_unit}{per})")
        _dress(panel)
    axes[-1].set_xlabel("Time (s)")
    axes[-1].set_xlim(
        min(float(table.index[0]) for table in runs.values()),
        max(float(table.index[-1]) for table in runs.values()),
    )
    figure.align_ylabels(axes)
    if title:
        figure.suptitle(title, fontsize="medium")
    if len(runs) > 1:
        # Beside the curves, never over them.
        figure.legend(
            *axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(runs), frameon=False
        )
    return figure


def save_figure(figure: Figure, path: Path, *, resolution: float = 200.0) -> None:
    """Write a figure, whole or not at all; the suffix of the path says the format: .png, .pdf or .svg.

    Args:
        figure: the figure
        path: where to
        resolution: dots per inch of a .png

    Raises:
        OutputFileError: another suffix, or the file cannot be written
    """
    check_figure_path(path)
    # Without a date the same figure is the same file.
    metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(path.suffix.lower(), {})
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=resolution, metadata=metadata)


def check_figure_path(path: Path) -> None:
    """Raise OutputFileError unless the suffix is one that `save_figure` knows."""
    if path.suffix.lower() not in _SUFFIXES:
        raise OutputFileError(path, f"the name must end in {', '.join(_SUFFIXES)}")


def _dress(axes: Axes) -> None:
    axes.axhline(0.0, color="0.6", linewidth=0.6, zorder=0)
    axes.grid(visible=True, color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.margins(y=0.08)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
