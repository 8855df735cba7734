"""An actuator assembly as it is modeled: return spring and balance spring side by side (compare Fig. 7a)."""

from __future__ import annotations

from figures.restrained_spring import restrained_spring
from figures.svg import LIGHT, Drawing, Point
from pyjoystick.support import VERMILION


def draw() -> Drawing:
    """The plunger reaches the return spring after x_0 and the balance spring after x_2; not to scale."""
    drawing = Drawing(640.0, 330.0, "Return spring and balance spring of an actuator")
    face, upper, lower = 190.0, 225.0, 95.0
    gaps = {upper: ("x_0", 24.0, "return spring", "ret"), lower: ("x_2", 96.0, "balance spring", "bal")}
    wall = 490.0
    for height, (label, gap, name, short) in gaps.items():
        length = wall - face - gap
        restrained_spring(drawing, Point(wall, height), 0.0, length=length, direction=-1.0)
        edge = Point(face, height)
        drawing.line(Point(105.0, height - 8.0), edge.moved(Point(0.0, -8.0)), edge.moved(Point(0.0, 8.0)),
                     Point(105.0, height + 8.0), fill=LIGHT)  # fmt: skip
        foot = height - 62.0
        drawing.guide(edge.moved(Point(0.0, -14.0)), Point(face, foot - 6.0))
        drawing.guide(Point(face + gap, height - 44.0), Point(face + gap, foot - 6.0))
        drawing.dimension(Point(face, foot), Point(face + gap, foot), label, side=Point(0.0, -1.0))
        drawing.note(Point(wall + 24.0, height + 20.0), name, anchor="start")
        drawing.text(Point(wall + 24.0, height - 6.0), f"k_{{s,{short}}}, k_{{h,{short}}}", anchor="start")
        drawing.text(Point(wall + 24.0, height - 30.0), f"F_{{0,{short}}}", anchor="start")
    corners = ((85.0, lower - 24.0), (105.0, lower - 24.0), (105.0, upper + 24.0), (85.0, upper + 24.0))
    drawing.line(*(Point(x, y) for x, y in corners), fill=LIGHT)
    middle = 0.5 * (upper + lower)
    drawing.note(Point(95.0, upper + 42.0), "plunger")
    drawing.arrow(Point(20.0, middle), Point(80.0, middle), color=VERMILION)
    drawing.text(Point(40.0, middle + 20.0), "f_x", color=VERMILION)
    drawing.arrow(Point(95.0, upper + 62.0), Point(150.0, upper + 62.0), width=1.2)
    drawing.text(Point(162.0, upper + 62.0), "x")
    return drawing
