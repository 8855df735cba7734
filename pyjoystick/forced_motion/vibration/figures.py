"""Figure of transmissibility: angle per base acceleration, and the motion of the top in space."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.forced_motion.vibration.direction import Direction
from pyjoystick.support import SERIES, ParameterError, dress, legend_above

_MARKERS: Final = ("o", "s", "^", "D", "v")


def plot_transmissibility(
    small: Mapping[str, pd.DataFrame],
    driven: Mapping[str, pd.DataFrame] | None = None,
    *,
    direction: Direction = Direction.HORIZONTAL,
) -> Figure:
    """Plot frequency responses, of small vibrations as lines and of large ones as points.

    Args:
        small: tables from `MountedHandle.small`, by label; at least one, at most as many as there are
            line styles
        driven: tables from `MountedHandle.driven`, by label
        direction: direction of the base's vibration, for the labels

    Raises:
        ParameterError: no line, or more lines or series of points than there are styles
    """
    points = driven or {}
    most = min(len(SERIES), len(_MARKERS))
    if not 1 <= len(small) <= most or len(points) > most:
        raise ParameterError("small, driven", f"{len(small)} and {len(points)} tables", f"1 to {most} each")
    figure = Figure(figsize=(7.4, 5.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    for panel, column, factor in ((upper, "gain", np.degrees(1.0)), (lower, "transmissibility", 1.0)):
        for style, (label, table) in zip(SERIES, small.items(), strict=False):
            panel.plot(table.index, factor * table[column], label=label, **style)
        for marker, style, (label, table) in zip(_MARKERS, SERIES, points.items(), strict=False):
            panel.plot(
                table.index, factor * table[column], marker, color=style["color"], markersize=4, label=label
            )
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.yaxis.set_major_formatter("{x:g}")
        panel.xaxis.set_major_formatter("{x:g}")
        dress(panel)
    lower.axhline(1.0, color="0.6", linewidth=0.8, zorder=0)
    upper.set_ylabel(f"Angle (deg per {direction.unit.replace('s2', 's$^2$')})")
    lower.set_ylabel(f"{direction.seen.capitalize()} over base in space")
    lower.set_xlabel("Frequency (Hz)")
    legend_above(figure, upper, columns=3)
    return figure
