"""The parameters of the joystick as frozen, checked values in SI units, and the paper's numbers."""

from pyjoystick.parameters.damping import ConstantDamping, Damping, PowerLawDamping
from pyjoystick.parameters.joystick import JoystickParameters
from pyjoystick.parameters.paper import (
    BACKWARD_TABLE,
    FORWARD_TABLE,
    NOMINAL,
    NOMINAL_POWER_LAW,
    PIVOT_TO_TOP,
    STOP_ANGLE,
)
from pyjoystick.parameters.springs import ActuatorAssembly, RestrainedSpring, SegmentTable

__all__ = [
    "BACKWARD_TABLE",
    "FORWARD_TABLE",
    "NOMINAL",
    "NOMINAL_POWER_LAW",
    "PIVOT_TO_TOP",
    "STOP_ANGLE",
    "ActuatorAssembly",
    "ConstantDamping",
    "Damping",
    "JoystickParameters",
    "PowerLawDamping",
    "RestrainedSpring",
    "SegmentTable",
]
