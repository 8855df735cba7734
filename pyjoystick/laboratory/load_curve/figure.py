"""The figure of a load-deflection curve with its fit (Fig. 7b and c)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyjoystick.laboratory.load_curve.cubic import cubic_fit, segment_force
from pyjoystick.laboratory.load_curve.fit import LoadCurveFit
from pyjoystick.support import BLUE, FITTED, GRAY, LONG_DASHES, MEASURED, dress, legend_above

_MM = 1e3
_POINTS = 2000


def plot_load_curve(fit: LoadCurveFit, *, title: str = "", size: tuple[float, float] = (7.0, 6.4)) -> Figure:
    """The whole curve with segments and cubic; below it the steep segments, enlarged.

    Args:
        fit: from `fit_load_curve`
        title: a line above the figure
        size: width and height (inch)
    """
    figure = Figure(figsize=size, layout="constrained")
    steep = list(range(0, len(fit.table.x) - 1, 2))[:2]
    grid = figure.add_gridspec(2, max(len(steep), 1), height_ratios=(3, 2) if steep else (1, 0))
    whole = figure.add_subplot(grid[0, :])
    _draw(whole, fit, cubic=True)
    for column, i in enumerate(steep):
        axes = figure.add_subplot(grid[1, column])
        _draw(axes, fit, cubic=False)
        _enlarge(axes, fit, i)
    legend_above(figure, whole, marker_scale=4.0, title=title)
    return figure


def _draw(axes: Axes, fit: LoadCurveFit, *, cubic: bool) -> None:
    colors = (MEASURED, GRAY)
    for branch, name, color in zip(fit.curve.branches, ("loading", "unloading"), colors, strict=False):
        axes.plot(branch.travel * _MM, branch.force - fit.zero, ".", color=color, markersize=2.0, label=name)
    travel = fit.curve.loading.travel
    x = np.sort(np.concatenate((np.linspace(np.min(travel), np.max(travel), _POINTS), fit.table.x)))
    axes.plot(x * _MM, segment_force(fit, x), color=FITTED, linewidth=1.4, label="segments")
    if cubic:
        inside = x[x >= fit.table.x[0]]
        force = cubic_fit(fit.curve, fit.table.x[0], fit.zero)(inside)
        axes.plot(inside * _MM, force, color=BLUE, linestyle=LONG_DASHES, linewidth=1.4, label="cubic")
    axes.set_xlabel("Travel (mm)")
    axes.set_ylabel("Force (N)")
    dress(axes)


def _enlarge(axes: Axes, fit: LoadCurveFit, i: int) -> None:
    """The window around segment i, with its kinks marked."""
    first, last = fit.table.x[i], fit.table.x[i + 1]
    margin = 0.6 * (last - first)
    low, high = segment_force(fit, [first, last])
    space = 0.15 * (high - low) + 2.0 * abs(fit.friction)
    axes.set_xlim((first - margin) * _MM, (last + margin) * _MM)
    axes.set_ylim(low - space, high + space)
    for number, kink in ((i, first), (i + 1, last)):
        axes.axvline(kink * _MM, color="0.6", linewidth=0.8, zorder=0)
        axes.annotate(
            f"$x_{number}$",
            (kink * _MM, 0.02),
            xycoords=("data", "axes fraction"),
            xytext=(3, 0),
            textcoords="offset points",
        )
