"""The peaks of a free oscillation under damping and under dry friction, and where it may stick."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from figures.axes import Axes
from figures.svg import LIGHT, Drawing, Point
from pyjoystick.model import NOMINAL, JoystickParameters, contact_moment, gravity_moment, simulate
from pyjoystick.support import BLACK, BLUE, VERMILION

_FRICTION = 0.2
_DAMPED = NOMINAL
_RUBBED = NOMINAL.replace({"damping.C": 0.0, "friction.T_c": _FRICTION})
_TICKS = ("0.1", "0.2", "0.5", "1", "2", "5", "10", "20")
_END = 1.25


def draw() -> Drawing:
    """On a logarithmic scale damping gives a straight line; dry friction falls ever faster, and ends."""
    drawing = Drawing(620.0, 380.0, "Decay by damping and by dry friction")
    axes = Axes(drawing, Point(60.0, 52.0), 540.0, 280.0, (0.0, _END), (math.log10(0.1), math.log10(25.0)))
    band = _level(_edge_of_band())
    low, high = axes.at(0.0, axes.y_range[0]), axes.at(_END, band)
    corners = (low, Point(high.x, low.y), high, Point(low.x, high.y))
    drawing.line(*corners, color=LIGHT, fill=LIGHT)
    axes.frame("time (s)", "peaks of |θ| (deg)", ("0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"), ())
    for tick in _TICKS:
        foot = axes.at(0.0, _level(float(tick)))
        drawing.line(foot, axes.at(_END, _level(float(tick))), color=LIGHT, width=1.0)
        drawing.note(foot.moved(Point(-7.0, 0.0)), tick, anchor="end")
    for joystick, color in ((_DAMPED, BLUE), (_RUBBED, VERMILION)):
        _peaks(axes, joystick, color)
    drawing.note(axes.at(0.92, _level(4.6)), "damping", color=BLUE)
    drawing.note(axes.at(0.72, _level(0.9)), "dry friction", color=VERMILION)
    drawing.note(axes.at(0.26, _level(0.13)), "here it may stick", color=BLACK)
    return drawing


def _peaks(axes: Axes, joystick: JoystickParameters, color: str) -> None:
    """The peaks, and where it sticks if it does."""
    motion = simulate(joystick, time=[0.0, _END], theta_start=math.radians(20.0))
    rests = [(event.time, event.theta) for event in motion.events if event.kind == "sticks"]
    found = [(0.0, math.radians(20.0)), *((turn.time, turn.theta) for turn in motion.turning_points), *rests]
    times = [time for time, _ in found]
    levels = [_level(math.degrees(abs(theta))) for _, theta in found]
    axes.curve(times, levels, color)
    for time, level in zip(times, levels, strict=True):
        axes.drawing.circle(axes.at(time, level), 4.0, fill=color, color=color)


def _level(degrees: float) -> float:
    return float(np.log10(max(degrees, 0.1)))


def _edge_of_band() -> float:
    """The largest angle (deg) at which the friction holds against the springs."""

    def excess(theta: float) -> float:
        return float(contact_moment(NOMINAL, theta) - gravity_moment(NOMINAL, theta)) - _FRICTION

    return math.degrees(brentq(excess, 0.0, math.radians(1.0)))
