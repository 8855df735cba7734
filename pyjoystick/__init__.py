"""Dynamics of joysticks with opposing restrained preloaded springs: parameters, reference model, peaks.

The names below are the ones that most uses need; `pyjoystick.reference` holds the pure-Python model.
"""

from pyjoystick.errors import (
    ParameterError,
    PyJoystickError,
    SeriesError,
    SimulationError,
    UnknownParameterError,
)
from pyjoystick.parameters import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    ActuatorAssembly,
    ConstantDamping,
    JoystickParameters,
    PowerLawDamping,
    RestrainedSpring,
)
from pyjoystick.peaks import find_peaks

__all__ = [
    "NOMINAL",
    "NOMINAL_POWER_LAW",
    "ActuatorAssembly",
    "ConstantDamping",
    "JoystickParameters",
    "ParameterError",
    "PowerLawDamping",
    "PyJoystickError",
    "RestrainedSpring",
    "SeriesError",
    "SimulationError",
    "UnknownParameterError",
    "find_peaks",
]
