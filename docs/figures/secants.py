"""The restoring moment over the angle, and what the springs average to for a large and a small swing."""

from __future__ import annotations

import math

from figures.axes import Axes
from figures.svg import Drawing, Point
from pyjoystick.model import NOMINAL, angle_of_travel, contact_moment, gravity_moment
from pyjoystick.support import BLACK, BLUE, VERMILION

#: Amplitude (deg), color, label and where it stands (deg, N.m).
_SWINGS = ((16.0, BLUE, "large swing", (15.5, 1.2)), (4.0, VERMILION, "small swing", (4.0, 1.8)))


def draw() -> Drawing:
    """A straight line through the turning points of a swing is the steeper the smaller the swing is."""
    drawing = Drawing(620.0, 360.0, "Restoring moment and its secants")
    axes = Axes(drawing, Point(60.0, 52.0), 540.0, 260.0, (-20.0, 20.0), (-2.5, 2.5))
    axes.frame(
        "θ (deg)", "M_s - m g h sin θ (N.m)", ("-20", "-10", "0", "10", "20"), ("-2", "-1", "0", "1", "2")
    )
    angles = _angles()
    axes.curve([math.degrees(angle) for angle in angles], [_moment(angle) for angle in angles], BLACK)
    for swing, color, label, place in _SWINGS:
        slope = _moment(math.radians(swing)) / swing
        reach = 1.12 * swing
        axes.curve((-reach, reach), (-slope * reach, slope * reach), color, "7 4")
        tip = axes.at(swing, _moment(math.radians(swing)))
        drawing.circle(tip, 4.0, fill=color, color=color)
        drawing.note(axes.at(*place), label, color=color)
    return drawing


def _moment(angle: float) -> float:
    return float(contact_moment(NOMINAL, angle) - gravity_moment(NOMINAL, angle))


def _angles() -> list[float]:
    """Every degree, and the kinks of both sides."""
    kinks = [
        sign * angle_of_travel(NOMINAL, kink)
        for sign, side in ((1.0, NOMINAL.forward), (-1.0, NOMINAL.backward))
        for kink in side.kinks
    ]
    return sorted([*(math.radians(degrees) for degrees in range(-20, 21)), *kinks])
