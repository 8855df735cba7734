"""From records and settings to the least-squares problem."""

from __future__ import annotations

from collections.abc import Iterable

from pyjoystick.fmu import Fmu
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.measurement import Measurement, measurements
from pyjoystick.identification.fitting.noise_model import first_weights
from pyjoystick.identification.fitting.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.prediction import FmuSettings, Predictor, TrajectoryPredictor
from pyjoystick.identification.fitting.problem import Problem
from pyjoystick.identification.fitting.settings import RELEASE_TIME, FitSettings
from pyjoystick.identification.fitting.variables import Variables
from pyjoystick.motion import Record
from pyjoystick.support import ParameterError, UnknownVariableError


def make_problem(records: Iterable[Record | Measurement], settings: FitSettings, fmu: Fmu) -> Problem:
    """The least-squares problem that `fit` solves; raises as it does."""
    measured = measurements(records)
    if not measured:
        raise FitError("records", "there is none")
    if settings.noise.per_record and len(measured) < 2:
        raise ParameterError("noise.per_record", True, "left out for a single record")
    variables = Variables(settings, fmu.description, measured)
    constants = {name: value for name, value in settings.fixed.items() if name != RELEASE_TIME}
    shared = FmuSettings(fmu, variables.varied, constants, settings.tolerance)
    predictors = [
        _predictor(shared, settings, record, variables.release_variable(k) is not None)
        for k, record in enumerate(measured)
    ]
    problem = Problem(variables, predictors, first_weights(predictors, settings.noise))
    problem.predictions(variables.start)
    return problem


def _predictor(
    shared: FmuSettings, settings: FitSettings, record: Measurement, free_release: bool
) -> Predictor:
    known = shared.fmu.description.variables
    needed = settings.outputs if free_release or settings.comparison == "peaks" else ()
    derivatives = {}
    for name in needed:
        if settings.derivatives.get(name) not in known:
            raise UnknownVariableError(settings.derivatives.get(name, f"derivative of {name}"), known)
        derivatives[name] = settings.derivatives[name]
    if settings.comparison == "peaks":
        name = settings.outputs[0]
        return PeakPredictor(shared, record, name, derivatives[name], settings.peaks)
    return TrajectoryPredictor(shared, record, settings.outputs, derivatives, settings.inputs)
