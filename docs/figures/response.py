"""Amplitude over frequency of a shaken joystick: the table of the page, drawn, with the free oscillation."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

import numpy as np

from figures.axes import Axes
from figures.svg import Drawing, Point
from pyjoystick.forced_motion import backbone
from pyjoystick.model import NOMINAL
from pyjoystick.support import BLACK, BLUE, VERMILION

_PAGE: Final = Path(__file__).parents[1] / "response.md"
_ROWS: Final = re.compile(r"^\| ([\d.]+) \| ([\d.]+) \| ([\d.]*) ?\|$", re.MULTILINE)
_FREQUENCIES: Final = (3.2, 6.4)
#: Where both motions meet: frequency (Hz) and amplitude (deg).
_FOLD: Final = (3.487, 25.94)
#: The largest angle of the small motion (deg).
_SMALL: Final = 0.6


def draw() -> Drawing:
    """The stable branch, the unstable one dashed, the backbone, the jump."""
    drawing = Drawing(640.0, 400.0, "Amplitude over frequency at 0.6 N m")
    axes = Axes(drawing, Point(60.0, 66.0), 560.0, 290.0, _FREQUENCIES, (0.0, 35.0))
    ticks = ("3.5", "4", "4.5", "5", "5.5", "6"), ("0", "10", "20", "30")
    axes.frame("frequency (Hz)", "amplitude (deg)", *ticks)
    free = backbone(NOMINAL, np.radians(np.linspace(4.0, 40.0, 120)))
    degrees = np.degrees(free["amplitude"])
    inside = free["frequency"].between(*_FREQUENCIES) & (degrees < 35.0)
    axes.curve(free["frequency"][inside].tolist(), degrees[inside].tolist(), BLUE, "2,5")
    frequencies, stable, unstable = _table()
    axes.curve([_FOLD[0], *frequencies], [_FOLD[1], *stable], BLACK)
    axes.curve([_FOLD[0], *frequencies[: len(unstable)]], [_FOLD[1], *unstable], BLACK, "7,5")
    axes.curve(_FREQUENCIES, (_SMALL, _SMALL), VERMILION)
    start = axes.at(*_FOLD)
    drawing.arrow(start.moved(Point(0.0, -8.0)), axes.at(_FOLD[0], 1.6), color=VERMILION, width=1.6)
    drawing.note(axes.at(4.45, 22.0), "large motion", anchor="start")
    drawing.note(axes.at(4.05, 7.0), "unstable")
    drawing.note(axes.at(3.36, 14.0), "jump", color=VERMILION)
    drawing.note(axes.at(5.3, 2.4), "small motion", color=VERMILION)
    drawing.note(axes.at(4.5, 7.2), "free, undamped", color=BLUE, anchor="start")
    return drawing


def _table() -> tuple[list[float], list[float], list[float]]:
    """Frequencies (Hz), amplitudes (deg) of the large motion and, where it exists, of the unstable one."""
    rows = _ROWS.findall(_PAGE.read_text(encoding="utf-8"))
    if not rows:
        raise ValueError(f"{_PAGE.name} has no table of amplitudes")
    unstable = [float(row[2]) for row in rows if row[2]]
    return [float(row[0]) for row in rows], [float(row[1]) for row in rows], unstable
