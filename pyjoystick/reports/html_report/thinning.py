"""Removal of invisible dots: outside of the axes, or hidden by other dots."""

from __future__ import annotations

from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

#: Of dots closer than this (pt), a quarter of a dot, only one is drawn.
_NEAR: Final = 0.5
_POINTS_PER_INCH: Final = 72.0


def thin_dots(figure: Figure) -> None:
    """Remove invisible dots, each of which costs a page 200 bytes; axes are unchanged.

    Args:
        figure: modified in place; lines between dots are kept
    """
    dotted = [(line, axes) for axes in figure.axes for line in axes.lines if line.get_linestyle() == "None"]
    if not dotted:
        return
    # Fix limits and positions of the axes for the whole data first.
    figure.draw_without_rendering()
    for line, axes in dotted:
        _thin(line, axes, figure.dpi / _POINTS_PER_INCH)


def _thin(line: Line2D, axes: Axes, dots_per_point: float) -> None:
    data = np.asarray(line.get_xydata())
    size = line.get_markersize() * dots_per_point
    with np.errstate(invalid="ignore"):
        at = axes.transData.transform(data)
        low, high = np.asarray(axes.bbox.min) - size, np.asarray(axes.bbox.max) + size
        inside = np.all((at >= low) & (at <= high), axis=1)
    cells = np.floor(at[inside] / (_NEAR * dots_per_point))
    first = np.sort(np.unique(cells, axis=0, return_index=True)[1])
    line.set_data(*data[np.flatnonzero(inside)[first]].T)
