"""The mechanism as the live page draws it, in the states of its springs that the colors show."""

from __future__ import annotations

import math
from typing import Final

from figures.svg import GRAY, LIGHT, Drawing, Point, polar, zigzag
from pyjoystick.model import NOMINAL, contact_travel
from pyjoystick.support import BLUE, GREEN, VERMILION

#: Pixels of a meter.
_SCALE: Final = 6_500.0
#: Before the balance spring is reached, so that all three states occur.
_LEAN: Final = 4.5
_REST: Final = Point(330.0, 250.0)
_FINGER: Final = 62.0
_SPRING: Final = 92.0


def draw() -> Drawing:
    """The joystick leans forward by a few degrees: only the forward return spring is compressed."""
    drawing = Drawing(660.0, 420.0, "The mechanism in the live page")
    a, b = _SCALE * NOMINAL.a, _SCALE * NOMINAL.b
    travel = _SCALE * float(contact_travel(NOMINAL, math.radians(_LEAN)))
    up, ahead = polar(90.0 - _LEAN), polar(-_LEAN)
    for side, moved, assembly in ((-1.0, 0.0, NOMINAL.backward), (1.0, travel, NOMINAL.forward)):
        tip = Point(_REST.x + side * a, _REST.y + b - moved)
        bar = tip.y - 55.0
        for offset, spring in ((-30.0, assembly.return_spring), (30.0, assembly.balance_spring)):
            x = tip.x + side * offset
            plate = _REST.y + b - 55.0 - _FINGER - _SCALE * spring.x_0
            _spring(drawing, x, plate, min(plate, bar - _FINGER))
            drawing.line(
                *(
                    Point(x + dx, y)
                    for dx, y in ((-8.0, bar), (-8.0, bar - _FINGER), (8.0, bar - _FINGER), (8.0, bar))
                ),
                fill=LIGHT,
            )
        drawing.line(
            *(
                Point(tip.x + dx, y)
                for dx, y in ((-40.0, bar), (40.0, bar), (40.0, bar + 10.0), (-40.0, bar + 10.0))
            ),
            fill=LIGHT,
        )
        drawing.line(
            *(
                Point(tip.x + dx, y)
                for dx, y in (
                    (-9.0, bar + 10.0),
                    (-9.0, tip.y - 9.0),
                    (0.0, tip.y),
                    (9.0, tip.y - 9.0),
                    (9.0, bar + 10.0),
                )
            ),
            fill=LIGHT,
        )
    foot = _REST.moved(up, b)
    ends = (foot.moved(ahead, -a - 50.0), foot.moved(ahead, a + 50.0))
    drawing.line(*ends, *(end.moved(up, 18.0) for end in reversed(ends)), fill=LIGHT)
    stem = (foot.moved(up, 18.0).moved(ahead, -16.0), foot.moved(up, 18.0).moved(ahead, 16.0))
    drawing.line(stem[0], stem[0].moved(up, 95.0), stem[1].moved(up, 95.0), stem[1], fill=LIGHT)
    contact = Point(_REST.x + a, _REST.y + b - travel)
    drawing.arrow(contact.moved(Point(0.0, 70.0)), contact, color=VERMILION)
    drawing.text(contact.moved(Point(22.0, 60.0)), "f_x", color=VERMILION)
    drawing.circle(_REST, 7.0)
    _words(drawing, a)
    return drawing


def _spring(drawing: Drawing, x: float, rest: float, plate: float) -> None:
    """A spring in its housing; its plate has left the lips where it is lower than at rest."""
    foot = rest - _SPRING
    color = GREEN if plate < rest else GRAY
    for side in (-1.0, 1.0):
        lip = (Point(x + side * 14.0, rest), Point(x + side * 27.0, rest), Point(x + side * 27.0, foot))
        drawing.line(*lip, color=BLUE, width=2.0)
    drawing.line(Point(x - 30.0, foot), Point(x + 30.0, foot), color=BLUE, width=2.0)
    drawing.line(*zigzag(Point(x, plate - 6.0), Point(x, foot), 6, 18.0), color=color)
    corners = ((-23.0, plate), (23.0, plate), (23.0, plate - 6.0), (-23.0, plate - 6.0))
    drawing.line(*(Point(x + dx, y) for dx, y in corners), color=color, fill=color)


def _words(drawing: Drawing, a: float) -> None:
    drawing.note(Point(_REST.x - a, 22.0), "lifted off", color=GRAY)
    drawing.note(Point(_REST.x + a - 32.0, 22.0), "released", color=GREEN)
    drawing.note(Point(_REST.x + a + 42.0, 22.0), "lifted off", color=GRAY)
    drawing.note(Point(_REST.x - a, 395.0), "backward")
    drawing.note(Point(_REST.x + a, 395.0), "forward")
