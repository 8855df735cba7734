"""The joystick's free body diagram (compare Fig. 5 of the paper)."""

from __future__ import annotations

import math

from figures.svg import GRAY, LIGHT, Drawing, Point, polar
from pyjoystick.support import BLUE, GREEN, VERMILION
from pyjoystick.support.figure_style import PURPLE

#: Lengths (px), not to scale: the real handle is eleven times as long as a.
_LEAN, _TOP, _H, _A, _B = 16.0, 300.0, 165.0, 110.0, 26.0


def draw() -> Drawing:
    """The joystick leans forward; forces in one color, moments about the pivot in another."""
    drawing = Drawing(560.0, 450.0, "Free body diagram of the joystick")
    pivot = Point(260.0, 100.0)
    up, ahead = polar(90.0 - _LEAN), polar(-_LEAN)
    center = pivot.moved(up, _H)

    drawing.guide(pivot.moved(Point(0.0, -40.0)), pivot.moved(Point(0.0, 335.0)))
    _handle(drawing, pivot, up, ahead)

    drawing.arc(pivot, 235.0, 90.0, 90.0 - _LEAN, color=GRAY, width=1.0)
    drawing.text(pivot.moved(polar(90.0 - _LEAN / 2.0, 250.0)), "θ")
    drawing.dimension(pivot.moved(ahead, -58.0), center.moved(ahead, -58.0), "h", side=Point(-1.0, 0.2))
    drawing.guide(center.moved(ahead, -64.0), center)
    drawing.guide(pivot.moved(ahead, -64.0), pivot)

    drawing.circle(center, 6.0, fill="black")
    drawing.arrow(center, center.moved(Point(0.0, -95.0)), color=GREEN)
    drawing.text(center.moved(Point(24.0, -84.0)), "m g", color=GREEN)

    contact = _contact(pivot, up, ahead)
    drawing.arrow(contact.moved(up, -75.0), contact, color=VERMILION)
    drawing.note(contact.moved(up, -86.0), "contact force", color=VERMILION)
    drawing.circle(contact, 3.5, fill=VERMILION, color=VERMILION)

    for label, radius, start, end, color in (
        ("T", 205.0, 38.0, 12.0, BLUE),
        ("M_g", 165.0, 38.0, 12.0, GREEN),
        ("M_s", 165.0, 172.0, 203.0, VERMILION),
        ("M_d", 205.0, 172.0, 203.0, PURPLE),
    ):
        drawing.arc_arrow(pivot, radius, start, end, color=color)
        drawing.text(pivot.moved(polar(start + math.copysign(7.0, start - end), radius)), label, color=color)

    drawing.circle(pivot, 8.0)
    drawing.circle(pivot, 2.0, fill="black")
    drawing.note(pivot.moved(Point(-12.0, -22.0)), "pivot", anchor="end")
    drawing.arrow(Point(415.0, 410.0), Point(475.0, 410.0), color=GRAY, width=1.2)
    drawing.note(Point(482.0, 410.0), "forward", color=GRAY, anchor="start")
    return drawing


def _handle(drawing: Drawing, pivot: Point, up: Point, ahead: Point) -> None:
    plate = [
        pivot.moved(up, _B).moved(ahead, -_A - 28.0),
        pivot.moved(up, _B).moved(ahead, _A + 28.0),
        pivot.moved(up, _B + 16.0).moved(ahead, _A + 28.0),
        pivot.moved(up, _B + 16.0).moved(ahead, -_A - 28.0),
    ]
    drawing.line(*plate, fill=LIGHT)
    grip = [
        pivot.moved(ahead, -7.0),
        pivot.moved(up, 130.0).moved(ahead, -7.0),
        pivot.moved(up, 160.0).moved(ahead, -20.0),
        pivot.moved(up, _TOP).moved(ahead, -22.0),
        pivot.moved(up, _TOP + 14.0),
        pivot.moved(up, _TOP).moved(ahead, 22.0),
        pivot.moved(up, 160.0).moved(ahead, 20.0),
        pivot.moved(up, 130.0).moved(ahead, 7.0),
        pivot.moved(ahead, 7.0),
    ]
    drawing.line(*grip, fill=LIGHT)


def _contact(pivot: Point, up: Point, ahead: Point) -> Point:
    """Where the lower surface of the plate crosses the plunger's axis."""
    surface = pivot.moved(up, _B)
    return surface.moved(ahead, (_A - (surface.x - pivot.x)) / ahead.x)
