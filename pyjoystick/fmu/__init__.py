"""FMUs: finding, describing and running them through FMPy."""

from pyjoystick.defaults import DEFAULT_TOLERANCE
from pyjoystick.fmu.batch import BatchResult
from pyjoystick.fmu.cosimulation import Fmu
from pyjoystick.fmu.description import (
    DefaultExperiment,
    FmuDescription,
    Variable,
    read_description,
)
from pyjoystick.fmu.errors import FmuFileError, FmuNotFoundError, FmuRunError, UnsupportedFmuError
from pyjoystick.fmu.files import MODELS, build_folder, find_fmu
from pyjoystick.fmu.inputs import Inputs
from pyjoystick.fmu.linearization import Linearization
from pyjoystick.fmu.model_exchange import run_model_exchange
from pyjoystick.fmu.plan import Plan
from pyjoystick.fmu.reductions import Extremes, Final, Loss, Peaks, Reduction

__all__ = [
    "DEFAULT_TOLERANCE",
    "MODELS",
    "BatchResult",
    "DefaultExperiment",
    "Extremes",
    "Final",
    "Fmu",
    "FmuDescription",
    "FmuFileError",
    "FmuNotFoundError",
    "FmuRunError",
    "Inputs",
    "Linearization",
    "Loss",
    "Peaks",
    "Plan",
    "Reduction",
    "UnsupportedFmuError",
    "Variable",
    "build_folder",
    "find_fmu",
    "read_description",
    "run_model_exchange",
]
