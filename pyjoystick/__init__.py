"""Dynamics of joysticks with opposing restrained preloaded springs: FMUs, parameters, reference model, peaks.

The names below are the ones that most uses need; the sub-packages hold the rest. Each is loaded when it is
first used, so that importing this package takes no time.
"""

from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pyjoystick.comparison import compare
    from pyjoystick.errors import (
        ParameterError,
        PyJoystickError,
        SeriesError,
        SimulationError,
        UnknownParameterError,
    )
    from pyjoystick.experiments import free_oscillation, reference_free_oscillation
    from pyjoystick.fmu import Fmu, FmuFileError, FmuNotFoundError, FmuRunError
    from pyjoystick.fmu_comparison import compare_fmus
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
else:

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
        globals()[name] = value
        return value


__all__ = [
    "NOMINAL",
    "NOMINAL_POWER_LAW",
    "ActuatorAssembly",
    "ConstantDamping",
    "Fmu",
    "FmuFileError",
    "FmuNotFoundError",
    "FmuRunError",
    "JoystickParameters",
    "ParameterError",
    "PowerLawDamping",
    "PyJoystickError",
    "RestrainedSpring",
    "SeriesError",
    "SimulationError",
    "UnknownParameterError",
    "compare",
    "compare_fmus",
    "find_peaks",
    "free_oscillation",
    "reference_free_oscillation",
]

_HOMES = MappingProxyType(
    {
        "NOMINAL": "parameters",
        "NOMINAL_POWER_LAW": "parameters",
        "ActuatorAssembly": "parameters",
        "ConstantDamping": "parameters",
        "Fmu": "fmu",
        "FmuFileError": "fmu",
        "FmuNotFoundError": "fmu",
        "FmuRunError": "fmu",
        "JoystickParameters": "parameters",
        "ParameterError": "errors",
        "PowerLawDamping": "parameters",
        "PyJoystickError": "errors",
        "RestrainedSpring": "parameters",
        "SeriesError": "errors",
        "SimulationError": "errors",
        "UnknownParameterError": "errors",
        "compare": "comparison",
        "compare_fmus": "fmu_comparison",
        "find_peaks": "peaks",
        "free_oscillation": "experiments",
        "reference_free_oscillation": "experiments",
    }
)


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
