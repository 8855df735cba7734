"""Draw the figures of an FMU: its icon and its default run.

Matplotlib is imported only when something is drawn: the live page uses other modules of this package but
draws nothing.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from fmu_build.packaging.default_run import DefaultRun
from fmu_build.support.description import ModelDescription
from fmu_build.support.request import FmiVersion


@contextmanager
def _own_settings(settings: Mapping[Any, Any]) -> Iterator[None]:
    """Use Matplotlib's defaults and these settings, whatever the user or this program has set."""
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(settings)
        yield


# The path of the icon in the archive.
ICONS: Mapping[FmiVersion, str] = {"2.0": "model.png", "3.0": "terminalsAndIcons/icon.png"}
_MOST_PORTS = 12  # on one side; more would not be legible
_COLOR = "#1f3b63"


def model_png(description: ModelDescription) -> bytes:
    """Return the icon as a PNG of 400 by 300 pixels."""
    with _own_settings({}):
        return _drawn(description)


def _drawn(description: ModelDescription) -> bytes:
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle

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
    # By default, the file would contain the name and version of the drawing library.
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


# The color-blind-safe palette of Okabe and Ito; the dashes distinguish the curves in gray.
_COLORS = ("#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7")
_DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 1.5, 1.5, 1.5)), (0, (1, 1)))
# In inches: the margins, the panels' width and height, and the average letter of the names on the right.
_LEFT, _BELOW, _CURVES, _PANEL, _LETTER = 1.0, 0.5, 5.6, 1.4, 0.09
_SETTINGS = {
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "default run",  # the same identifiers in every file
    "font.family": "sans-serif",
    "axes.grid": True,
    "grid.color": "0.9",
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def default_run_svg(run: DefaultRun, description: ModelDescription) -> bytes:
    """Return the figure as SVG; the same run gives the same bytes."""
    from matplotlib.figure import Figure

    units = {variable.name: variable.unit for variable in description.variables}
    panels = [(unit, names, run.inputs, "steps-post") for unit, names in _by_unit(run.inputs, units)]
    panels += [(unit, names, run.outputs, "default") for unit, names in _by_unit(run.outputs, units)]
    with _own_settings(_SETTINGS):
        height = _BELOW + _PANEL * len(panels)
        width = _LEFT + _CURVES + _LETTER * (8 + max(map(len, [*run.inputs, *run.outputs])))
        figure = Figure(figsize=(width, height))
        # Placed by hand, because Matplotlib's layout takes half a second.
        right, top = (_LEFT + _CURVES) / width, 1.0 - 0.1 / height
        figure.subplots_adjust(_LEFT / width, _BELOW / height, right, top, hspace=0.15)
        all_axes = figure.subplots(len(panels), sharex=True, squeeze=False)[:, 0]
        for axes, (unit, names, values, style) in zip(all_axes, panels, strict=True):
            for index, name in enumerate(names):
                axes.plot(
                    run.time,
                    values[name],
                    color=_COLORS[index % len(_COLORS)],
                    linestyle=_DASHES[index % len(_DASHES)],
                    drawstyle=style,
                    linewidth=1.2,
                    label=_plain(name),
                )
            axes.set_ylabel(_plain(unit or "1"))
            axes.yaxis.set_label_coords(-0.8 / _CURVES, 0.5)
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
        all_axes[-1].set_xlabel("time in s")
        all_axes[-1].set_xlim(run.time[0], run.time[-1])
        buffer = io.BytesIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


def _by_unit(names: Iterable[str], units: Mapping[str, str]) -> list[tuple[str, list[str]]]:
    groups: dict[str, list[str]] = {}
    for name in names:
        groups.setdefault(units[name], []).append(name)
    return list(groups.items())


def _plain(text: str) -> str:
    """Return the text without characters that would start a formula or hide the line from the legend."""
    return " " + text.replace("$", r"\$") if text.startswith("_") else text.replace("$", r"\$")
