"""Setup of the least-squares problem from records, settings and an FMU."""

from __future__ import annotations

from collections.abc import Iterable

from pyjoystick.fmu import Fmu
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings
from pyjoystick.identification.fitting.problem.forward_model import ForwardModel
from pyjoystick.identification.fitting.problem.instrument import CLOCK, INSTRUMENT
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.measurement import Measurement, measurements
from pyjoystick.identification.fitting.problem.noise_model import first_noise
from pyjoystick.identification.fitting.problem.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.problem.predictor import Predictor
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.motion import Record
from pyjoystick.support import ParameterError, UnknownVariableError


def make_problem(records: Iterable[Record | Measurement], settings: FitSettings, fmu: Fmu) -> Problem:
    """Make the least-squares problem that `fit` solves; raises as it does."""
    measured = measurements(records)
    if not measured:
        raise FitError("records", "there is none")
    if settings.noise.per_record and len(measured) < 2:
        raise ParameterError("noise.per_record", True, "left out for a single record")
    variables = Variables(settings, fmu.description, measured)
    constants = {name: value for name, value in settings.fixed.items() if name not in INSTRUMENT}
    shared = FmuSettings(fmu, variables.varied, constants, settings.tolerance)
    free_clock = any(one.name in CLOCK for one in settings.free)
    predictors = [_predictor(shared, settings, record, free_clock) for record in measured]
    model = ForwardModel(variables, predictors, settings.tolerance)
    model.predictions(variables.start)
    return Problem.of(model, first_noise(predictors, settings.noise))


def _predictor(
    shared: FmuSettings, settings: FitSettings, record: Measurement, free_clock: bool
) -> Predictor:
    known = shared.fmu.description.variables
    is_needed = free_clock or settings.comparison == "peaks"
    # A driven motion is extrapolated before its origin if its slope is known.
    is_useful = bool(settings.inputs) and all(
        settings.derivatives.get(one) in known for one in settings.outputs
    )
    needed = settings.outputs if is_needed or is_useful else ()
    derivatives = {}
    for name in needed:
        if settings.derivatives.get(name) not in known:
            raise UnknownVariableError(settings.derivatives.get(name, f"derivative of {name}"), known)
        derivatives[name] = settings.derivatives[name]
    if settings.comparison == "peaks":
        name = settings.outputs[0]
        return PeakPredictor(shared, record, name, derivatives[name], settings.peaks)
    return TrajectoryPredictor(shared, record, settings.outputs, derivatives, settings.inputs)
