"""The simplest system: a mass between two restrained preloaded springs (compare Fig. 1)."""

from __future__ import annotations

from figures.restrained_spring import restrained_spring
from figures.svg import LIGHT, Drawing, Point


def draw() -> Drawing:
    """The mass in its middle position, with a clearance on each side."""
    drawing = Drawing(620.0, 225.0, "A mass between opposing restrained preloaded springs")
    middle = Point(310.0, 125.0)
    gap, half_mass, length = 26.0, 38.0, 160.0
    ground = middle.y - 62.0
    drawing.hatch(Point(30.0, ground), Point(590.0, ground))
    for side in (-1.0, 1.0):
        wall = middle.moved(Point(side * (half_mass + gap + length), 0.0))
        restrained_spring(drawing, wall, 0.0, length=length, direction=-side)
        plate = middle.moved(Point(side * (half_mass + gap), 0.0))
        face = middle.moved(Point(side * half_mass, 0.0))
        start, end = sorted((face.moved(Point(0.0, 66.0)), plate.moved(Point(0.0, 66.0))))
        drawing.guide(face.moved(Point(0.0, 50.0)), face.moved(Point(0.0, 74.0)))
        drawing.guide(plate.moved(Point(0.0, 50.0)), plate.moved(Point(0.0, 74.0)))
        drawing.dimension(start, end, "x_0")
    mass = [middle.moved(Point(x, y)) for x, y in ((-38, -50), (38, -50), (38, 50), (-38, 50))]
    drawing.line(*mass, fill=LIGHT)
    drawing.text(middle, "m")
    for x in (-22.0, 22.0):
        drawing.circle(Point(middle.x + x, ground + 6.0), 5.5)
    return drawing
