"""How far the contact travels and the center of mass sinks: the cam of eq. (3), and the same linearized.

Angles are distances from the middle, 0 or more (rad). The differences between an angle and one that lies
`gap` further in are computed from the gap, so that nothing cancels near a turning point.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.cam import angle_of_travel


class Geometry(Protocol):
    """The two differences on which the potential energy depends, and the inverse of the travel."""

    def angle_of_travel(self, x: float) -> float:
        """The angle (rad) at which the contact travel is x (m)."""

    def advance(self, outer: float, gap: float) -> float:
        """x(outer) - x(outer - gap) (m)."""

    def lowering(self, outer: float, gap: float) -> float:
        """cos(outer - gap) - cos(outer): how far the center of mass sinks, in parts of h."""


@dataclass(frozen=True, slots=True)
class CamGeometry:
    """Eq. (3): x = a*tan(theta) + b*(1 - 1/cos(theta))."""

    parameters: JoystickParameters

    def angle_of_travel(self, x: float) -> float:
        """The inverse of eq. (3)."""
        return angle_of_travel(self.parameters, x)

    def advance(self, outer: float, gap: float) -> float:
        """(a*sin(gap) - b*lowering)/(cos(outer)*cos(outer - gap)), by the addition theorems."""
        a, b = self.parameters.a, self.parameters.b
        change = a * math.sin(gap) - b * self.lowering(outer, gap)
        return change / (math.cos(outer) * math.cos(outer - gap))

    def lowering(self, outer: float, gap: float) -> float:
        """2*sin(outer - gap/2)*sin(gap/2)."""
        return 2.0 * math.sin(outer - 0.5 * gap) * math.sin(0.5 * gap)


@dataclass(frozen=True, slots=True)
class LinearGeometry:
    """Lowest order in theta: x = a*theta, hence dx/dtheta = a, and cos(theta) = 1 - theta^2/2.

    The contact moment is then a*f_x(a*theta) and that of the weight m*g*h*theta: straight lines between the
    kinks.
    """

    parameters: JoystickParameters

    def angle_of_travel(self, x: float) -> float:
        """x/a."""
        return x / self.parameters.a

    def advance(self, outer: float, gap: float) -> float:
        """a*gap."""
        return self.parameters.a * gap

    def lowering(self, outer: float, gap: float) -> float:
        """(outer^2 - (outer - gap)^2)/2."""
        return (outer - 0.5 * gap) * gap
