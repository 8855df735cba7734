"""The style of figures, in which each color has one meaning.

The colors are those of Okabe and Ito, which color-blind readers can tell apart; lines that share a panel also
have different dashes, for printing in gray.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal, TypedDict

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyjoystick.support.errors import ParameterError
from pyjoystick.support.notebook import show_figures

BLACK: Final = "#000000"
AMBER: Final = "#E69F00"
SKY: Final = "#56B4E9"
GREEN: Final = "#009E73"
BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
PURPLE: Final = "#CC79A7"
GRAY: Final = "0.6"

#: Measurements, or synthetic data in their place.
MEASURED: Final = BLACK
#: Fits to them, and confidence bands.
FITTED: Final = VERMILION
BAND: Final = BLUE
#: The two damping laws.
CONSTANT_DAMPING: Final = BLUE
POWER_LAW: Final = VERMILION
#: The two sides: positive and negative angles.
FORWARD: Final = GREEN
BACKWARD: Final = PURPLE

#: Solid, long and short dashes, dashes with dots, dots.
SOLID: Final = "-"
LONG_DASHES: Final = (0, (6, 2))
SHORT_DASHES: Final = (0, (2, 1.5))
DASH_DOT: Final = (0, (6, 1.5, 1.5, 1.5))
DOTS: Final = (0, (1, 1))


class LineStyle(TypedDict):
    """Keyword arguments of a line: ``axes.plot(x, y, **style)``."""

    color: str
    linestyle: str | tuple[float, tuple[float, ...]]
    linewidth: float


#: For lines without a color of their own, in this order.
SERIES: Final = (
    LineStyle(color=BLACK, linestyle=SOLID, linewidth=1.1),
    LineStyle(color=VERMILION, linestyle=LONG_DASHES, linewidth=1.4),
    LineStyle(color=BLUE, linestyle=SHORT_DASHES, linewidth=1.4),
    LineStyle(color=GREEN, linestyle=DASH_DOT, linewidth=1.4),
    LineStyle(color=PURPLE, linestyle=DOTS, linewidth=1.6),
)
#: Lines of Fig. 10, dashed as there.
LAWS: Final = {
    "constant": LineStyle(color=CONSTANT_DAMPING, linestyle=SHORT_DASHES, linewidth=1.4),
    "power-law": LineStyle(color=POWER_LAW, linestyle=LONG_DASHES, linewidth=1.4),
}

#: What a line stands for, or its place among lines without a meaning of their own.
Role = Literal["measured", "constant", "power-law"] | int


def line_style(role: Role) -> LineStyle:
    """Style of a line in all figures: ``axes.plot(x, y, **line_style("measured"))``.

    Args:
        role: ``measured`` (or a substitute for measurements), a damping law (``constant`` or ``power-law``),
            or the number, from 0, of a line without its own meaning

    Raises:
        ParameterError: there is no such role
    """
    if isinstance(role, int) and 0 <= role < len(SERIES):
        return SERIES[role]
    roles = {"measured": SERIES[0], **LAWS}
    if role not in roles:
        raise ParameterError("role", role, f"{', '.join(roles)}, or a number from 0 to {len(SERIES) - 1}")
    return roles[role]


def dress(axes: Axes, *, zero: bool = False) -> None:
    """Add a light grid and remove the frame at the top and on the right; `zero` adds a line at zero."""
    if zero:
        axes.axhline(0.0, color=GRAY, linewidth=0.6, zorder=0)
    axes.grid(visible=True, color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def legend_above(
    figure: Figure,
    axes: Axes | Sequence[Axes],
    *,
    title: str = "",
    columns: int | None = None,
    marker_scale: float = 1.0,
) -> None:
    """Draw the legend of the lines of `axes` above the panels, where it covers no curve; each label once.

    It also draws the title of the figure, because Matplotlib would draw it over the legend.
    """
    panels = [axes] if isinstance(axes, Axes) else axes
    entries: dict[str, Artist] = {}
    for panel in panels:
        for handle, label in zip(*panel.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    figure.legend(
        handles=list(entries.values()),
        labels=list(entries),
        loc="outside upper center",
        ncols=columns or len(entries),
        frameon=False,
        title=title or None,
        markerscale=marker_scale,
    )


# Whoever draws figures loads this module; they are not made by pyplot, which would do it.
show_figures()
