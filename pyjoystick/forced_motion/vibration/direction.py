"""How a base shakes: along itself, up and down, or turning, and what the joystick on it feels of that."""

from __future__ import annotations

import math
from enum import StrEnum

#: Inputs of the FMU.
ALONG, UPWARD, TURNING = "a_base", "a_base_z", "alpha_base"


class Direction(StrEnum):
    """How a base shakes in the plane of the handle; with pitch it turns about the pivot."""

    HORIZONTAL = "horizontal"
    VERTICAL = "vertical"
    PITCH = "pitch"

    @property
    def unit(self) -> str:
        """The unit of the base's acceleration."""
        return "rad/s2" if self is Direction.PITCH else "m/s2"

    @property
    def seen(self) -> str:
        """What is compared with the base in space."""
        return "handle" if self is Direction.PITCH else "top"

    def shares(self, frequency: float, gravity: float) -> dict[str, float]:
        """What the FMU's inputs are, by name, of the base's acceleration; of pitch a small one.

        A base that turns by phi = -alpha/(2*pi*f)^2 tilts gravity: g*sin(phi) pulls the handle forward, which
        is to the joystick as though its base went backward.

        Args:
            frequency: f (Hz)
            gravity: g (m/s2)
        """
        if self is Direction.PITCH:
            return {TURNING: 1.0, ALONG: gravity / (2.0 * math.pi * frequency) ** 2}
        return {ALONG if self is Direction.HORIZONTAL else UPWARD: 1.0}

    def arm(self, held: float, pivot_to_top: float) -> float:
        """What the motion in space has more than the base's, over the angle of the handle (m/rad, or 1).

        With pitch that motion is the handle's angle in space, else that of its top in the base's direction.

        Args:
            held: the angle of the handle (rad)
            pivot_to_top: m
        """
        if self is Direction.PITCH:
            return 1.0
        return pivot_to_top * (math.cos(held) if self is Direction.HORIZONTAL else -math.sin(held))
