"""Two FMUs of the same model compared, as when they come from different compilers."""

from pyjoystick.fmu_comparison.as_json import as_json
from pyjoystick.fmu_comparison.compare import FmuComparison, Limits, RunComparison, compare_fmus
from pyjoystick.fmu_comparison.declarations import AttributeDifference, Declarations, compare_declarations
from pyjoystick.fmu_comparison.experiments import Experiment, experiments_for
from pyjoystick.fmu_comparison.reference import compare_with_reference
from pyjoystick.fmu_comparison.runs import Tolerances

__all__ = [
    "AttributeDifference",
    "Declarations",
    "Experiment",
    "FmuComparison",
    "Limits",
    "RunComparison",
    "Tolerances",
    "as_json",
    "compare_declarations",
    "compare_fmus",
    "compare_with_reference",
    "experiments_for",
]
