"""Fitting an FMU's parameters to records, and saying how sure the answer is."""

from pyjoystick.fitting.defaults import CONSTANT_DAMPING, DISPLACEMENT_DAMPING, POWER_LAW_DAMPING, RELEASE
from pyjoystick.fitting.errors import FitError, FitInterruptedError
from pyjoystick.fitting.fit import fit
from pyjoystick.fitting.measurement import Measurement
from pyjoystick.fitting.result import Fit
from pyjoystick.fitting.settings import RELEASE_TIME, FitSettings, Free, Noise, Search, Uncertainty

__all__ = [
    "CONSTANT_DAMPING",
    "DISPLACEMENT_DAMPING",
    "POWER_LAW_DAMPING",
    "RELEASE",
    "RELEASE_TIME",
    "Fit",
    "FitError",
    "FitInterruptedError",
    "FitSettings",
    "Free",
    "Measurement",
    "Noise",
    "Search",
    "Uncertainty",
    "fit",
]
