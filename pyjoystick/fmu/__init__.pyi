from .batch import BatchResult as BatchResult
from .cosimulation import Fmu as Fmu
from .description import (
    DefaultExperiment as DefaultExperiment,
    FmuDescription as FmuDescription,
    Interface as Interface,
    Variable as Variable,
)
from .description_file import read_description as read_description
from .description_json import description_json as description_json
from .errors import (
    FmuCrashError as FmuCrashError,
    FmuEndedError as FmuEndedError,
    FmuFileError as FmuFileError,
    FmuFuelError as FmuFuelError,
    FmuMemoryError as FmuMemoryError,
    FmuNotFoundError as FmuNotFoundError,
    FmuRunError as FmuRunError,
    FmuTimeLimitError as FmuTimeLimitError,
    FmuTrapError as FmuTrapError,
    NotFiniteWarning as NotFiniteWarning,
    StepperEndedError as StepperEndedError,
    UnsupportedFmuError as UnsupportedFmuError,
)
from .files import MODELS as MODELS, build_folder as build_folder, find_fmu as find_fmu
from .inputs import Inputs as Inputs, checked_inputs as checked_inputs
from .linearization import Linearization as Linearization
from .model_exchange import run_model_exchange as run_model_exchange
from .plan import Plan as Plan
from .real_time import paced as paced
from .reductions import (
    Extremes as Extremes,
    Final as Final,
    Loss as Loss,
    Peaks as Peaks,
    Reduction as Reduction,
)
from .sensitivities import sensitivity_name as sensitivity_name
from .shipped import SENSITIVITIES as SENSITIVITIES
from .stepper import SavedState as SavedState, Stepper as Stepper
from .stepwise import stepped as stepped
from .values import (
    INTEGERS as INTEGERS,
    REALS as REALS,
    Value as Value,
    checked_outputs as checked_outputs,
    checked_parameters as checked_parameters,
    checked_value as checked_value,
    checked_varied as checked_varied,
)
from .variable_files import read_inputs as read_inputs, read_variables as read_variables
