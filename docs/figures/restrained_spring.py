"""The restrained preloaded spring in its three states (compare Fig. 8)."""

from __future__ import annotations

from typing import Final

from figures.svg import GRAY, LIGHT, Drawing, Point, zigzag
from pyjoystick.support import BLUE, GREEN, VERMILION

_WIDTH: Final = 250.0
#: From the wall to the lips of the housing, and half of the housing's height.
_LENGTH: Final = 130.0
_HALF: Final = 42.0


def draw() -> Drawing:
    """Without a force, with one below the preload, and with one above it."""
    drawing = Drawing(3.0 * _WIDTH, 300.0, "A restrained preloaded spring in three states")
    states = (
        ("at rest", "δ = 0", 0.0, "", "F_0", "F_0"),
        ("k_h δ ≤ F_0", "f_x = (k_h + k_s) δ", 5.0, "f_x", "F_0 + k_s δ", "F_0 - k_h δ"),
        ("k_h δ > F_0", "f_x = F_0 + k_s δ", 42.0, "f_x", "F_0 + k_s δ", "0"),
    )
    for i, (condition, law, travel, force, spring, housing) in enumerate(states):
        wall = Point(28.0 + i * _WIDTH, 168.0)
        restrained_spring(drawing, wall, travel, loose=i == 2)
        plate = wall.moved(Point(_LENGTH - travel, 0.0))
        if force:
            drawing.arrow(plate.moved(Point(72.0, 0.0)), plate.moved(Point(8.0, 0.0)), color=VERMILION)
            drawing.text(plate.moved(Point(62.0, 18.0)), force, color=VERMILION)
        if travel:
            rest = wall.moved(Point(_LENGTH, 0.0))
            drawing.guide(rest.moved(Point(0.0, -_HALF - 6.0)), rest.moved(Point(0.0, -_HALF - 34.0)))
            drawing.guide(plate.moved(Point(0.0, -_HALF + 8.0)), plate.moved(Point(0.0, -_HALF - 34.0)))
            drawing.text(rest.moved(Point(14.0, -_HALF - 26.0)), "δ")
        middle = wall.moved(Point(0.5 * _LENGTH, 0.0))
        drawing.text(middle.moved(Point(0.0, 100.0)), condition)
        drawing.text(middle.moved(Point(0.0, _HALF + 24.0)), f"k_h:  {housing}", color=BLUE)
        drawing.text(middle.moved(Point(0.0, -_HALF - 54.0)), f"k_s:  {spring}", color=GREEN)
        drawing.text(middle.moved(Point(0.0, -_HALF - 90.0)), law)
    for i in (1, 2):
        edge = i * _WIDTH - 8.0
        drawing.line(Point(edge, 20.0), Point(edge, 280.0), color=LIGHT)
    return drawing


def restrained_spring(
    drawing: Drawing,
    wall: Point,
    travel: float,
    *,
    length: float = _LENGTH,
    half: float = _HALF,
    loose: bool = False,
    direction: float = 1.0,
) -> None:
    """A spring between a wall and a plate that a housing holds back.

    Args:
        drawing: what it is drawn into
        wall: middle of the wall
        travel: how far the plate is pushed in
        length: from the wall to the housing's lips
        half: half of the housing's height
        loose: the plate has left the lips
        direction: 1, or -1 with the plate to the left of the wall
    """

    def at(along: float, across: float) -> Point:
        return wall.moved(Point(direction * along, across))

    plate = length - travel
    # Where the housing still pulls, its lips go along with the plate, if only by a hair.
    lips = length if loose else plate
    drawing.hatch(*((at(0.0, -half - 10.0), at(0.0, half + 10.0))[:: -1 if direction > 0 else 1]))
    for side in (-1.0, 1.0):
        inner = side * (half - 14.0)
        drawing.line(
            at(0.0, side * half), at(lips + 6.0, side * half), at(lips + 6.0, inner), color=BLUE, width=3.0
        )
    coils = zigzag(at(0.0, 0.0), at(plate - 4.0, 0.0), 6, half - 22.0)
    drawing.line(*coils, color=GREEN, width=2.0)
    drawing.line(at(plate - 2.0, -half + 6.0), at(plate - 2.0, half - 6.0), color=GRAY, width=5.0)
