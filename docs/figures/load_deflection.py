"""The load-deflection curves of Table 1 with their four segments (compare Fig. 7)."""

from __future__ import annotations

from figures.axes import Axes
from figures.svg import Drawing, Point
from pyjoystick.model import NOMINAL, ActuatorAssembly, assembly_force
from pyjoystick.support import BACKWARD, BLACK, FORWARD

_DASHES = "7 3"


def draw() -> Drawing:
    """The whole curve of both sides, and both steep stretches of the forward one enlarged."""
    drawing = Drawing(776.0, 350.0, "Load-deflection curves of the actuators")
    whole = Axes(drawing, Point(52.0, 52.0), 330.0, 250.0, (0.0, 3.5), (0.0, 80.0))
    whole.frame("x (mm)", "f_x (N)", ("0", "1", "2", "3"), ("0", "20", "40", "60", "80"))
    for side, color, dashes, label, height in (
        (NOMINAL.forward, FORWARD, "", "forward", 0.6),
        (NOMINAL.backward, BACKWARD, _DASHES, "backward", 0.45),
    ):
        _curve(whole, side, color, dashes)
        start = Point(whole.corner.x + 150.0, whole.corner.y + height * 150.0)
        drawing.line(start, start.moved(Point(34.0, 0.0)), color=color, width=2.0, dashes=dashes)
        drawing.note(start.moved(Point(42.0, 0.0)), label, anchor="start")

    first = Axes(drawing, Point(446.0, 52.0), 120.0, 250.0, (0.0, 0.3), (0.0, 60.0))
    first.frame("x (mm)", "f_x (N)", ("0", "0.1", "0.2", "0.3"), ("0", "20", "40", "60"))
    _curve(first, NOMINAL.forward, FORWARD)
    _kinks(first, ("x_0", "x_1"), ("k_0", "k_1"), (0, 1))
    second = Axes(drawing, Point(630.0, 52.0), 120.0, 250.0, (2.92, 2.96), (55.0, 75.0))
    second.frame("x (mm)", "f_x (N)", ("2.92", "2.94", "2.96"), ("55", "65", "75"))
    _curve(second, NOMINAL.forward, FORWARD)
    _kinks(second, ("x_2", "x_3"), ("k_2", "k_3"), (2, 3))
    return drawing


def _curve(axes: Axes, side: ActuatorAssembly, color: str, dashes: str = "") -> None:
    low, high = axes.x_range
    kinks = (1e3 * kink for kink in side.kinks)
    travels = [low, *(kink for kink in kinks if low < kink < high), high]
    forces = [float(assembly_force(side, 1e-3 * travel)) for travel in travels]
    axes.curve(travels, forces, color, dashes)


def _kinks(axes: Axes, kinks: tuple[str, str], slopes: tuple[str, str], places: tuple[int, int]) -> None:
    travels = [1e3 * NOMINAL.forward.kinks[place] for place in places]
    forces = [float(assembly_force(NOMINAL.forward, 1e-3 * travel)) for travel in travels]
    for travel, force, label in zip(travels, forces, kinks, strict=True):
        axes.drawing.guide(axes.at(travel, force), axes.at(travel, axes.y_range[0]))
        axes.drawing.circle(axes.at(travel, force), 3.5, fill=FORWARD, color=FORWARD)
        axes.drawing.text(axes.at(travel, axes.y_range[0]).moved(Point(-12.0, 12.0)), label)
    steep = axes.at(sum(travels) / 2.0, sum(forces) / 2.0)
    axes.drawing.text(steep.moved(Point(-16.0, 4.0)), slopes[0], color=BLACK)
    gentle = axes.at(travels[1], forces[1]).moved(Point(26.0, 16.0))
    axes.drawing.text(gentle, slopes[1], color=BLACK)
