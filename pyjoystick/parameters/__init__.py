"""The parameters of the joystick as frozen, checked values in SI units, and the paper's numbers."""

from pyjoystick.parameters.damping import ConstantDamping, Damping, PowerLawDamping
from pyjoystick.parameters.file import (
    SIDES,
    LawName,
    ParameterFile,
    Side,
    law_name,
    read_parameter_file,
    read_parameters,
)
from pyjoystick.parameters.file_writing import updated_text, write_parameters
from pyjoystick.parameters.joystick import JoystickParameters
from pyjoystick.parameters.paper import (
    BACKWARD_TABLE,
    FORWARD_TABLE,
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    PIVOT_TO_TOP,
    STOP_ANGLE,
)
from pyjoystick.parameters.rounding import rounded, rounded_error
from pyjoystick.parameters.springs import ActuatorAssembly, RestrainedSpring, SegmentTable

__all__ = [
    "BACKWARD_TABLE",
    "FORWARD_TABLE",
    "NOMINAL",
    "NOMINAL_POWER_LAW",
    "PAPER",
    "PIVOT_TO_TOP",
    "SIDES",
    "STOP_ANGLE",
    "ActuatorAssembly",
    "ConstantDamping",
    "Damping",
    "JoystickParameters",
    "LawName",
    "ParameterFile",
    "PowerLawDamping",
    "RestrainedSpring",
    "SegmentTable",
    "Side",
    "law_name",
    "read_parameter_file",
    "read_parameters",
    "rounded",
    "rounded_error",
    "updated_text",
    "write_parameters",
]
