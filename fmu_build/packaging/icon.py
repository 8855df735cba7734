"""The icon: the model as a block with its inputs on the left and its outputs on the right."""

from __future__ import annotations

import io
from collections.abc import Mapping

from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from fmu_build.packaging.drawing import own_settings
from fmu_build.support.description import ModelDescription
from fmu_build.support.request import FmiVersion

# Where it is in the archive.
ICONS: Mapping[FmiVersion, str] = {"2.0": "model.png", "3.0": "terminalsAndIcons/icon.png"}
_MOST_PORTS = 12  # on one side; more would not be legible
_COLOR = "#1f3b63"


def model_png(description: ModelDescription) -> bytes:
    """A PNG of 400 by 300 pixels."""
    with own_settings({}):
        return _drawn(description)


def _drawn(description: ModelDescription) -> bytes:
    figure = Figure(figsize=(4, 3), dpi=100)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0, 4), ylim=(0, 3))
    axes.set_axis_off()
    axes.add_patch(Rectangle((0.5, 0.3), 3.0, 2.4, facecolor="#eef3fa", edgecolor=_COLOR, linewidth=2))
    axes.text(
        2, 2.45, description.identifier, ha="center", va="center", fontsize=12, color=_COLOR, weight="bold"
    )
    for causality, edge, inside, align in (("input", 0.3, 0.6, "left"), ("output", 3.5, 3.4, "right")):
        names = [v.name for v in description.variables if v.causality == causality]
        shown = names if len(names) <= _MOST_PORTS else [*names[: _MOST_PORTS - 1], "..."]
        for row, name in enumerate(shown):
            y = 2.15 - (row + 0.5) * 1.8 / len(shown)
            axes.arrow(
                edge, y, 0.2, 0, head_width=0.08, head_length=0.1, length_includes_head=True, color=_COLOR
            )
            axes.text(inside, y, name, ha=align, va="center", fontsize=8, parse_math=False)
    buffer = io.BytesIO()
    # Without the name and version of the drawing library, whose place this is by default.
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()
