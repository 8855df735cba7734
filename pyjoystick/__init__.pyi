from .fmu.cosimulation import Fmu as Fmu
from .fmu.errors import (
    FmuFileError as FmuFileError,
    FmuNotFoundError as FmuNotFoundError,
    FmuRunError as FmuRunError,
)
from .model.parameters.file import NOMINAL as NOMINAL, NOMINAL_POWER_LAW as NOMINAL_POWER_LAW
from .model.parameters.joystick import (
    ConstantDamping as ConstantDamping,
    JoystickParameters as JoystickParameters,
    PowerLawDamping as PowerLawDamping,
)
from .model.parameters.springs import (
    ActuatorAssembly as ActuatorAssembly,
    RestrainedSpring as RestrainedSpring,
)
from .motion.comparison import compare as compare
from .motion.peaks import find_peaks as find_peaks
from .runs.experiments import (
    free_oscillation as free_oscillation,
    reference_free_oscillation as reference_free_oscillation,
)
from .runs.fmu_comparison.compare import compare_fmus as compare_fmus
from .support.errors import (
    ParameterError as ParameterError,
    PyJoystickError as PyJoystickError,
    SeriesError as SeriesError,
    SimulationError as SimulationError,
    UnknownParameterError as UnknownParameterError,
)
