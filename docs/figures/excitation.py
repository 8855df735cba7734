"""What each excitation of a driven record identifies: the table of docs/fitting-accuracy.md, drawn."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

from figures.axes import Axes
from figures.svg import LIGHT, Drawing, Point
from pyjoystick.support import BLACK, BLUE, GREEN, VERMILION

_PAGE: Final = Path(__file__).parents[1] / "fitting-accuracy.md"
_TABLE: Final = re.compile(
    r"^\| excitation \|(?P<heads>.*)\|\n\|[-:| ]*\n(?P<rows>(?:\|.*\n)+)", re.MULTILINE
)
_COLORS: Final = (BLACK, BLUE, GREEN, VERMILION)
_TICKS: Final = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
_PERCENT: Final = " (%)"


def draw() -> Drawing:
    """A point for each parameter and excitation; the standard errors are on a logarithmic scale."""
    names, errors = _table()
    drawing = Drawing(660.0, 400.0, "Standard errors by excitation")
    ends = math.log10(_TICKS[0]), math.log10(_TICKS[-1])
    axes = Axes(drawing, Point(70.0, 62.0), 560.0, 250.0, (-0.5, len(names) - 0.5), ends)
    for tick in _TICKS:
        foot = axes.at(-0.5, math.log10(tick))
        drawing.line(foot, axes.at(len(names) - 0.5, math.log10(tick)), color=LIGHT, width=1.0)
        drawing.note(foot.moved(Point(-7.0, 0.0)), f"{tick:g}", anchor="end")
    axes.frame("", "standard error (%)", (), ())
    for i, name in enumerate(names):
        drawing.note(axes.at(i, ends[0]).moved(Point(0.0, -16.0)), name)
    for color, (excitation, values), place in zip(_COLORS, errors.items(), _corners(drawing), strict=True):
        points = [axes.at(i, math.log10(value)) for i, value in enumerate(values)]
        drawing.line(*points, color=color, width=1.2, dashes="2,5")
        for point in points:
            drawing.circle(point, 5.0, fill=color, color="white")
        drawing.circle(place, 5.0, fill=color, color="white")
        drawing.note(place.moved(Point(12.0, 0.0)), excitation, color=color, anchor="start")
    return drawing


def _corners(drawing: Drawing) -> tuple[Point, ...]:
    """Where the names of the excitations begin, two above each other."""
    return tuple(Point(x, drawing.height - y) for x in (250.0, 450.0) for y in (24.0, 48.0))


def _table() -> tuple[list[str], dict[str, list[float]]]:
    """The parameters that have errors in percent, and the errors by excitation."""
    found = _TABLE.search(_PAGE.read_text(encoding="utf-8"))
    if found is None:
        raise ValueError(f"{_PAGE.name} has no table of excitations")
    heads = [cell.strip() for cell in found["heads"].split("|")]
    columns = [i for i, head in enumerate(heads) if head.endswith(_PERCENT)]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in found["rows"].splitlines()]
    errors = {row[0]: [float(row[1 + i]) for i in columns] for row in rows}
    return [heads[i].removesuffix(_PERCENT) for i in columns], errors
