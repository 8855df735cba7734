"""What a minimum means: each record beside its fit, tied parameters, criteria, and the checks of trust."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from pyjoystick.identification.fitting import trust
from pyjoystick.identification.fitting.noise_model import relative_sizes
from pyjoystick.identification.fitting.peak_prediction import missing_peaks
from pyjoystick.identification.fitting.prediction import TrajectoryPredictor
from pyjoystick.identification.fitting.problem import Problem
from pyjoystick.identification.fitting.result import Criteria, Derived, RecordFit, criteria
from pyjoystick.identification.fitting.search import Minimum
from pyjoystick.identification.fitting.settings import FitSettings
from pyjoystick.identification.fitting.uncertainty import Identifiability, StandardErrors
from pyjoystick.identification.fitting.variables import Variables
from pyjoystick.support import FloatArray


def record_fits(problem: Problem, x: FloatArray) -> tuple[RecordFit, ...]:
    """Each record beside the prediction at x."""
    found = []
    for number, (predictor, predicted, weights) in enumerate(
        zip(problem.predictors, problem.predictions(x), problem.weights, strict=True)
    ):
        sizes = relative_sizes(predictor)
        sigma = {
            label: float(1.0 / (weights[k] * sizes[k]))
            for label in dict.fromkeys(predictor.labels)
            for k in [predictor.labels.index(label)]
        }
        found.append(
            RecordFit(
                predictor.record.name,
                predictor.labels,
                predictor.times,
                predictor.data,
                predicted,
                sigma,
                predictor.curve(problem.variables.row(x, number), problem.variables.release_time(x, number))
                if isinstance(predictor, TrajectoryPredictor)
                else None,
            )
        )
    return tuple(found)


def all_checks(
    problem: Problem,
    settings: FitSettings,
    best: Minimum,
    known: Identifiability,
    errors: StandardErrors,
    records: Sequence[RecordFit],
    numerical_noise: float,
) -> list[trust.Check]:
    """Every check of trust that applies.

    Args:
        problem: the problem, with the weights of the noise
        settings: what was asked
        best: the minimum
        known: rank of the Jacobian there
        errors: standard errors there
        records: each record beside its fit
        numerical_noise: scatter of the FMU's results, in the unit of the data
    """
    variables = problem.variables
    found = [
        trust.check_convergence(best),
        trust.check_bounds(variables, best.x),
        trust.check_rank(known),
        trust.check_precision(variables.labels, best.x, errors.errors),
    ]
    residuals = [one.residuals() for one in records]
    if settings.comparison == "peaks":
        relative = [r / relative_sizes(p) for r, p in zip(residuals, problem.predictors, strict=True)]
        return [
            *found,
            trust.check_peaks([(one.name, missing_peaks(one.predicted)) for one in records]),
            trust.check_peak_errors(relative),
        ]
    if settings.noise.sigma:
        found.append(trust.check_chi_squared(best.cost, errors.degrees_of_freedom))
    else:
        found.append(trust.check_size(residuals, [one.data for one in records]))
    series, names = [], []
    for one in records:
        for label in dict.fromkeys(one.labels):
            series.append(one.residuals()[np.array(one.labels) == label])
            names.append(one.name if len(settings.outputs) == 1 else f"{label} of {one.name}")
    # Exact data leave the error of the integration, which is no noise.
    least = max(100.0 * numerical_noise, settings.tolerance)
    return [*found, trust.check_whiteness(names, series, least)]


def derived_parameters(
    variables: Variables, x: FloatArray, errors: StandardErrors, names: Sequence[str]
) -> Iterator[Derived]:
    """Tied parameters with the errors that follow from those of the variables, one for all records or each.

    Args:
        variables: what x means
        x: the minimum
        errors: standard errors there
        names: of the records
    """
    own = np.array([one.record is not None for one in variables.free])
    for k, record in enumerate(names if variables.tied else ()):
        slopes = _tied_slopes(variables, x, k)
        for name, value, slope in zip(variables.tied, variables.tied_values(x, k), slopes, strict=True):
            of_record = bool(np.any(slope[own] != 0.0))
            if of_record or k == 0:
                yield Derived(name, record if of_record else "", float(value), errors.of(slope), slope)


def _tied_slopes(variables: Variables, x: FloatArray, record: int) -> FloatArray:
    """Derivatives of the tied values of a record, shape (tied, variables)."""
    columns = []
    for unit, one in zip(np.eye(len(x)), variables.free, strict=True):
        step = 1e-6 * one.scale
        ends = (
            variables.tied_values(x + step * unit, record),
            variables.tied_values(x - step * unit, record),
        )
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    return np.column_stack(columns)


def criteria_of(
    settings: FitSettings, records: Sequence[RecordFit], rank: int, cost: float
) -> Criteria | None:
    """AICc and BIC of white normal noise; None where peaks are compared, whose errors have no such model."""
    if settings.comparison == "peaks":
        return None
    samples = sum(len(one.data) for one in records)
    logs, levels = 0.0, set()
    for one in records:
        for label in one.labels:
            logs += math.log(one.sigma[label])
            levels.add((label, one.sigma[label]))
    estimated = 0 if settings.noise.sigma else len(levels)
    # With an estimated sigma the likelihood is highest where it is the root mean square itself.
    spare = max(samples - rank, 1) / samples if estimated else 1.0
    logs += 0.5 * samples * math.log(spare)
    likelihood = -0.5 * cost / spare - logs - 0.5 * samples * math.log(2.0 * math.pi)
    return criteria(likelihood, rank + estimated, samples)
