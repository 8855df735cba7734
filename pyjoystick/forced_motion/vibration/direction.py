"""Directions of base vibration, and their effect on the joystick."""

from __future__ import annotations

import math
from enum import StrEnum

#: Inputs of the FMU.
ALONG, UPWARD, TURNING = "a_base", "a_base_z", "alpha_base"


class Direction(StrEnum):
    """Direction of base vibration in the plane of the handle; pitch is rotation about the pivot."""

    HORIZONTAL = "horizontal"
    VERTICAL = "vertical"
    PITCH = "pitch"

    @property
    def unit(self) -> str:
        """The unit of the base's acceleration."""
        return "rad/s2" if self is Direction.PITCH else "m/s2"

    @property
    def seen(self) -> str:
        """The motion in space that is compared with the base's."""
        return "handle" if self is Direction.PITCH else "top"

    def shares(self, frequency: float, gravity: float) -> dict[str, float]:
        """Values of the FMU's inputs, by name, per unit of the base's acceleration; for small pitch.

        A base rotated by phi = -alpha/(2*pi*f)^2 tilts gravity: g*sin(phi) pulls the handle forward, as a
        backward acceleration of the base would.

        Args:
            frequency: f (Hz)
            gravity: g (m/s2)
        """
        if self is Direction.PITCH:
            return {TURNING: 1.0, ALONG: gravity / (2.0 * math.pi * frequency) ** 2}
        return {ALONG if self is Direction.HORIZONTAL else UPWARD: 1.0}

    def arm(self, held: float, pivot_to_top: float) -> float:
        """Motion in space minus the base's, per angle of the handle (m/rad, or 1).

        With pitch, this is the handle's angle in space; otherwise the motion of its top in the base's
        direction.

        Args:
            held: angle of the handle (rad)
            pivot_to_top: m
        """
        if self is Direction.PITCH:
            return 1.0
        return pivot_to_top * (math.cos(held) if self is Direction.HORIZONTAL else -math.sin(held))
