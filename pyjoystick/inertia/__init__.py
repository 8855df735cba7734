"""Mass, center of mass and moment of inertia: from a swing test, and from the parts (section 3.2)."""

from pyjoystick.inertia.budget import Estimate, Measured, combined
from pyjoystick.inertia.parts import PartsResult, from_parts, read_parts
from pyjoystick.inertia.swing import SwingPeriod, inertia_of_swing, period_of_readings
from pyjoystick.inertia.swing_record import period_of_record

__all__ = [
    "Estimate",
    "Measured",
    "PartsResult",
    "SwingPeriod",
    "combined",
    "from_parts",
    "inertia_of_swing",
    "period_of_readings",
    "period_of_record",
    "read_parts",
]
