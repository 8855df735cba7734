"""Angle and transmissibility of a handle on a shaking base, alone and in a hand, by the closed form."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from figures.axes import Axes
from figures.svg import Drawing, Point
from pyjoystick.model import NOMINAL, PIVOT_TO_TOP, ConstantDamping, contact_moment
from pyjoystick.support import BLACK, VERMILION

_HELD: Final = math.radians(10.0)
_FREQUENCIES: Final = np.linspace(0.5, 16.0, 311)
#: Stiffness (N m/rad) and damping (N m s/rad) of the preset hand.
_HAND: Final = (25.0, 0.7)


def draw() -> Drawing:
    """Both on one scale of the frequency, the angle above."""
    drawing = Drawing(640.0, 470.0, "Angle and transmissibility over frequency, alone and in a hand")
    ticks = ("2", "4", "6", "8", "10", "12", "14", "16")
    upper = Axes(drawing, Point(60.0, 282.0), 560.0, 150.0, (0.0, 16.0), (0.0, 6.0))
    lower = Axes(drawing, Point(60.0, 56.0), 560.0, 150.0, (0.0, 16.0), (0.0, 7.0))
    upper.frame("frequency (Hz)", "angle (deg per m/s²)", ticks, ("0", "2", "4", "6"))
    lower.frame("frequency (Hz)", "top over base in space", ticks, ("0", "1", "3", "5", "7"))
    for hand, color in (((0.0, 0.0), BLACK), (_HAND, VERMILION)):
        response = _response(*hand)
        in_space = 1.0 - PIVOT_TO_TOP * math.cos(_HELD) * (2.0 * np.pi * _FREQUENCIES) ** 2 * response
        upper.curve(_FREQUENCIES.tolist(), np.degrees(np.abs(response)).tolist(), color)
        lower.curve(_FREQUENCIES.tolist(), np.abs(in_space).tolist(), color)
    drawing.note(upper.at(3.3, 4.6), "alone", anchor="start")
    drawing.note(upper.at(4.9, 0.8), "in a hand", color=VERMILION, anchor="start")
    drawing.note(lower.at(3.3, 5.4), "alone", anchor="start")
    drawing.note(lower.at(7.0, 2.3), "in a hand", color=VERMILION, anchor="start")
    return drawing


def _response(stiffness: float, damping: float) -> NDArray[np.complex128]:
    """Theta over a_base (rad per m/s2) of small vibrations about the angle, with a hand."""
    joystick, step = NOMINAL, 1e-5
    assert isinstance(joystick.damping, ConstantDamping)
    springs = float(np.diff(contact_moment(joystick, [_HELD - step, _HELD + step]))[0]) / (2.0 * step)
    weight = joystick.m * joystick.h * math.cos(_HELD)
    s = 2j * np.pi * _FREQUENCIES
    holding = springs + stiffness - weight * joystick.g
    return np.asarray(-weight / (joystick.J * s**2 + (joystick.damping.C + damping) * s + holding))
