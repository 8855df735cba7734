"""Figures of runs and results as files. Figures are not made by pyplot, so that nothing is kept or shown."""

from __future__ import annotations

import math
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Final, Literal

import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.support.errors import ParameterError, UnknownVariableError
from pyjoystick.support.figure_style import SERIES, LineStyle, dress, legend_above
from pyjoystick.support.output import FIGURE_SUFFIXES, check_suffix, replacing, write_text

AngleUnit = Literal["deg", "rad"]

_PANELS: Final = (
    ("theta", "Displacement", ""),
    ("omega", "Velocity", "/s"),
    ("alpha", "Acceleration", "/s²"),
)


def plot_motion(
    runs: pd.DataFrame | Mapping[str, pd.DataFrame],
    *,
    styles: Mapping[str, LineStyle] | None = None,
    angle_unit: AngleUnit = "deg",
    title: str = "",
    size: tuple[float, float] = (7.0, 6.4),
) -> Figure:
    """Displacement, velocity and acceleration over time, one above the other, as in Fig. 10 of the paper.

    Args:
        runs: a table with the columns ``theta`` (rad), ``omega`` (rad/s), ``alpha`` (rad/s2), or several by
            label
        styles: how each run is drawn, by label; in the order of `SERIES` where not given
        angle_unit: ``deg`` or ``rad``
        title: a line above the figure
        size: width and height (inch)

    Raises:
        ParameterError: no run, more runs than there are line styles, or an unknown unit
        UnknownVariableError: a table lacks a column
    """
    if isinstance(runs, pd.DataFrame):
        runs = {"": runs}
    if not 1 <= len(runs) <= len(SERIES):
        raise ParameterError("runs", f"{len(runs)} runs", f"1 to {len(SERIES)} runs")
    if angle_unit not in ("deg", "rad"):
        raise ParameterError("angle_unit", angle_unit, "'deg' or 'rad'")
    factor = math.degrees(1.0) if angle_unit == "deg" else 1.0
    drawn = dict(zip(runs, SERIES, strict=False)) if styles is None else styles
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(len(_PANELS), 1, sharex=True)
    for panel, (column, name, per) in zip(axes, _PANELS, strict=True):
        for label, table in runs.items():
            if column not in table.columns:
                raise UnknownVariableError(column, map(str, table.columns))
            panel.plot(table.index, table[column] * factor, label=label, **drawn[label])
        panel.set_ylabel(f"{name} ({angle_unit}{per})")
        panel.margins(y=0.08)
        dress(panel, zero=True)
    axes[-1].set_xlabel("Time (s)")
    axes[-1].set_xlim(
        min(float(table.index[0]) for table in runs.values()),
        max(float(table.index[-1]) for table in runs.values()),
    )
    figure.align_ylabels(axes)
    if len(runs) > 1:
        legend_above(figure, axes[0], title=title)
    elif title:
        figure.suptitle(title, fontsize="medium")
    return figure


def save_figure(figure: Figure, path: str | PathLike[str], *, resolution: float = 200.0) -> None:
    """Write a figure, whole or not at all, in the format of the suffix: .png, .pdf or .svg.

    Args:
        figure: the figure
        path: the file
        resolution: of a .png (dots per inch)

    Raises:
        OutputFileError: another suffix, or the file cannot be written
    """
    path = Path(path)
    check_suffix(path, *FIGURE_SUFFIXES)
    # Without a date the same figure is the same file.
    metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(path.suffix.lower(), {})
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=resolution, metadata=metadata)


def save_results(folder: str | PathLike[str], summary: str, figures: Mapping[str, Figure]) -> None:
    """Print the summary of a scenario, and write it and the figures as PNG and PDF.

    Args:
        folder: the target; created if missing
        summary: text in Markdown, for ``summary.md``
        figures: by file name without suffix

    Raises:
        OutputFileError: a file cannot be written
    """
    folder = Path(folder)
    for name, figure in figures.items():
        for suffix in ("png", "pdf"):
            save_figure(figure, folder / f"{name}.{suffix}")
    text = summary.rstrip("\n")
    write_text(folder / "summary.md", f"{text}\n")
    print(text)
