"""Motions shared by several tests."""

from __future__ import annotations

import math
from typing import Final

from pyjoystick.forced_motion import SHAPES, ForwardAndReturn
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW

JOYSTICKS: Final = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}
#: Both sides, unequal times, with and without rest and dwell.
MOTIONS: Final = {
    f"{shape} {degrees:+g} deg": ForwardAndReturn(
        amplitude=math.radians(degrees),
        rise=0.15,
        fall=0.2,
        dwell=0.05 if degrees > 0.0 else 0.0,
        rest=0.02 if degrees > 0.0 else 0.0,
        shape=shape,
    )
    for shape in SHAPES
    for degrees in (15.0, -18.0)
}
