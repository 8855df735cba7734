"""A word on angles that the real joystick cannot reach."""

from __future__ import annotations

import math
from typing import Final

from pyjoystick.cli.console import print_note
from pyjoystick.model import STOP_ANGLE

#: The paper gives its stops as "about" 20 degrees.
_ABOUT: Final = 1.05


def note_stops(largest: float) -> None:
    """Say so where the largest angle (rad) is beyond the stops, which no model here has."""
    if largest > _ABOUT * STOP_ANGLE:
        print_note(
            f"note: {math.degrees(largest):.4g} degrees are beyond the paper's stops at about "
            f"{math.degrees(STOP_ANGLE):.0f}, which are not modeled"
        )
