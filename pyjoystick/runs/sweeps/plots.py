"""Figures of sweeps: sensitivity indices, and results over parameters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyjoystick.support import AMBER, BLUE, VERMILION, ParameterError, UnknownVariableError, dress

_FIRST: Final = BLUE
_TOTAL: Final = AMBER
_FAILED: Final = VERMILION
#: Maximum number of results and of parameters in a figure.
MOST_RESULTS: Final = 6
MOST_PARAMETERS: Final = 8
_MOST_POINTS: Final = 5000
_LONGEST_LINE: Final = 24


def plot_sensitivity(indices: pd.DataFrame, *, title: str = "") -> Figure:
    """Plot first-order and total Sobol indices as bars with confidence intervals, one panel per result.

    Args:
        indices: from `sensitivity`, with at most `MOST_RESULTS` results
        title: title of the figure

    Raises:
        ParameterError: too many results
    """
    results = list(dict.fromkeys(indices["result"]))
    _require_room("results", results, MOST_RESULTS)
    parameters = list(dict.fromkeys(indices["parameter"]))
    width = max(2.4 + 2.6 * min(len(results), 3), 5.0)
    columns = min(len(results), 3)
    rows = -(-len(results) // columns)
    height = 0.9 + rows * (0.7 + 0.42 * len(parameters))
    figure = Figure(figsize=(width, height), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for axes, result in zip(panels, results, strict=False):
        _bars(axes, indices[indices["result"] == result])
        axes.set_title(result, fontsize="medium")
    for axes in panels[len(results) :]:
        axes.set_visible(False)
    for axes in panels[max(len(results) - columns, 0) : len(results)]:
        axes.set_xlabel("Share of the variance")
        axes.tick_params(labelbottom=True)
    panels[0].set_yticks(range(len(parameters)), parameters)
    panels[0].invert_yaxis()
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False)
    if title:
        figure.suptitle(title, fontsize="large")
    return figure


def plot_scatter(table: pd.DataFrame, results: Sequence[str], *, title: str = "") -> Figure:
    """Plot results over parameters, one row per result and one column per parameter; each dot is a run.

    Failed runs, which have no result, are marked at the bottom of each panel.

    Args:
        table: from `read_sweep`, with at most `MOST_PARAMETERS` parameters; at most 5000 runs
            are drawn, equally spaced
        results: names of the results, at most `MOST_RESULTS`
        title: title of the figure

    Raises:
        ParameterError: too many results or parameters, or no result
        UnknownVariableError: there is no result of that name
    """
    document = table.attrs["sweep"]
    parameters = list(document["settings"]["vary"])
    units = document["units"]
    _require_room("results", results, MOST_RESULTS)
    _require_room("parameters", parameters, MOST_PARAMETERS)
    for name in results:
        if name not in table:
            raise UnknownVariableError(name, map(str, table.columns))
    drawn = table.iloc[np.unique(np.linspace(0, len(table) - 1, min(len(table), _MOST_POINTS)).astype(int))]
    size = (1.0 + 2.2 * len(parameters), 0.9 + 1.9 * len(results))
    figure = Figure(figsize=(max(size[0], 4.0), max(size[1], 3.0)), layout="constrained")
    panels = figure.subplots(len(results), len(parameters), sharex="col", sharey="row", squeeze=False)
    for row, result in zip(panels, results, strict=True):
        for axes, parameter in zip(row, parameters, strict=True):
            _dots(axes, drawn, parameter, result)
        row[0].set_ylabel(_labeled(result, units))
    for axes, parameter in zip(panels[-1], parameters, strict=True):
        axes.set_xlabel(_labeled(parameter, units))
    figure.align_labels()
    if title:
        figure.suptitle(title, fontsize="large")
    return figure


def _bars(axes: Axes, indices: pd.DataFrame) -> None:
    place = np.arange(len(indices))
    for name, label, color, shift in (
        ("first", "alone (first order)", _FIRST, -0.2),
        ("total", "with interactions (total)", _TOTAL, 0.2),
    ):
        low, value, high = (indices[column].to_numpy() for column in (f"{name}_low", name, f"{name}_high"))
        # Bootstrap percentiles need not enclose the estimate.
        error = np.clip([value - low, high - value], 0.0, None)
        axes.barh(
            place + shift,
            value,
            height=0.38,
            xerr=error,
            color=color,
            label=label,
            error_kw={"linewidth": 1.0, "capsize": 2.0, "ecolor": "0.2"},
        )
    axes.axvline(0.0, color="0.4", linewidth=0.8)
    dress(axes)
    axes.grid(visible=False, axis="y")


def _dots(axes: Axes, table: pd.DataFrame, parameter: str, result: str) -> None:
    size = float(np.clip(4000.0 / len(table), 2.0, 16.0))
    axes.scatter(
        table[parameter], table[result], s=size, color=_FIRST, alpha=0.6, linewidths=0, rasterized=True
    )
    failed = table.loc[table["failed"], parameter]
    if len(failed):
        axes.plot(
            failed,
            np.full(len(failed), 0.02),
            "x",
            color=_FAILED,
            markersize=4.0,
            transform=axes.get_xaxis_transform(),
        )
    dress(axes)


def _labeled(name: str, units: dict[str, str]) -> str:
    """Name and unit; long names are wrapped so that adjacent labels do not overlap."""
    unit = f"({units[name]})" if units.get(name) else ""
    if len(name) + len(unit) <= _LONGEST_LINE:
        return f"{name} {unit}".rstrip()
    if len(name) <= _LONGEST_LINE:
        return f"{name}\n{unit}"
    first, dot, last = name.rpartition(".")
    return f"{first}{dot}\n{last} {unit}".strip()


def _require_room(field: str, names: Sequence[str], most: int) -> None:
    if not 1 <= len(names) <= most:
        raise ParameterError(field, len(names), f"1 to {most} for a figure")
