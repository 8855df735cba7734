"""The cam plate's geometry, eqs. (2) to (5), at the scale of the paper's joystick (compare Fig. 6)."""

from __future__ import annotations

import math

from figures.svg import GRAY, LIGHT, Drawing, Point, polar
from pyjoystick.model import NOMINAL, STOP_ANGLE, contact_travel
from pyjoystick.support import BLUE, VERMILION

#: Pixels of a meter.
_SCALE = 13_000.0


def draw() -> Drawing:
    """The plate at the stop, forward; the plunger's tip is a point that moves down its axis by x."""
    drawing = Drawing(620.0, 410.0, "Geometry of the cam plate")
    lean = math.degrees(STOP_ANGLE)
    a, b = _SCALE * NOMINAL.a, _SCALE * NOMINAL.b
    x = _SCALE * float(contact_travel(NOMINAL, STOP_ANGLE))
    pivot = Point(150.0, 215.0)
    up, ahead = polar(90.0 - lean), polar(-lean)
    foot = pivot.moved(up, b)
    contact = Point(pivot.x + a, pivot.y + b - x)
    # Eqs. (2a, b): the contact is on the lower surface, which passes `foot` along the plate.
    assert abs(foot.to(contact).x * up.x + foot.to(contact).y * up.y) < 1e-9

    plate = [foot.moved(ahead, -75.0), foot.moved(ahead, 400.0)]
    drawing.line(*plate, *(p.moved(up, 22.0) for p in reversed(plate)), fill=LIGHT)
    drawing.guide(Point(40.0, pivot.y + b), Point(560.0, pivot.y + b))
    drawing.guide(Point(contact.x, 30.0), Point(contact.x, pivot.y + b + 85.0))
    drawing.guide(pivot, Point(pivot.x, pivot.y + b + 85.0))
    drawing.guide(pivot, pivot.moved(up, b + 100.0))
    drawing.guide(pivot, Point(560.0, pivot.y))

    drawing.dimension(
        Point(pivot.x, pivot.y + b + 78.0), Point(contact.x, pivot.y + b + 78.0), "a", side=Point(0.0, 1.0)
    )
    drawing.dimension(Point(70.0, pivot.y), Point(70.0, pivot.y + b), "b", side=Point(-1.0, 0.0))
    drawing.guide(Point(58.0, pivot.y), pivot)
    drawing.dimension(Point(545.0, pivot.y + b), Point(545.0, contact.y), "x", side=Point(1.0, 0.0))
    drawing.dimension(Point(505.0, pivot.y), Point(505.0, contact.y), "d", side=Point(1.0, 0.0))
    drawing.guide(contact, Point(560.0, contact.y))
    drawing.arc(pivot, 150.0, 90.0, 90.0 - lean, color=GRAY, width=1.0)
    drawing.text(pivot.moved(polar(90.0 - lean / 2.0, 165.0)), "θ")
    drawing.dimension(foot, contact, "r", side=Point(up.x, up.y))

    _plunger(drawing, contact)
    force = 90.0
    drawing.arrow(contact, contact.moved(Point(0.0, force)), color=VERMILION)
    drawing.text(contact.moved(Point(-20.0, force - 6.0)), "f_V", color=VERMILION)
    push = force * math.tan(STOP_ANGLE)
    drawing.arrow(contact, contact.moved(Point(push, 0.0)), color=VERMILION)
    drawing.text(contact.moved(Point(push + 2.0, -26.0)), "f_H", color=VERMILION)
    drawing.arrow(contact, contact.moved(Point(push, force)), color=BLUE)
    drawing.note(contact.moved(Point(push + 8.0, force + 2.0)), "normal force", color=BLUE, anchor="start")
    drawing.circle(contact, 3.5, fill="black")

    drawing.circle(pivot, 8.0)
    drawing.circle(pivot, 2.0, fill="black")
    drawing.note(pivot.moved(Point(-4.0, -22.0)), "pivot")
    drawing.note(Point(250.0, pivot.y + b + 12.0), "cam surface at rest", color=GRAY, anchor="start")
    return drawing


def _plunger(drawing: Drawing, tip: Point) -> None:
    radius = 13.0
    middle = tip.moved(Point(0.0, -radius))
    drawing.arc(middle, radius, 180.0, 0.0)
    for side in (-radius, radius):
        drawing.line(middle.moved(Point(side, 0.0)), Point(middle.x + side, 30.0))
    drawing.note(Point(tip.x - 22.0, 45.0), "plunger", anchor="end")
