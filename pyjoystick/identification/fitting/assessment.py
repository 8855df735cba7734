"""Assessment of a minimum: fitted records, tied parameters, information criteria and checks."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from pyjoystick.identification.fitting.checks import residual_checks, trust
from pyjoystick.identification.fitting.checks.residual_view import ResidualView
from pyjoystick.identification.fitting.checks.rivals import Make, tried
from pyjoystick.identification.fitting.checks.score_test import Finding, score_test, significant
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.checks.suspects import suspects
from pyjoystick.identification.fitting.checks.torque_noise import check_torque_noise
from pyjoystick.identification.fitting.checks.unseen import Unseen, unseen
from pyjoystick.identification.fitting.problem.instrument import ZERO_OFFSET
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_model import NoiseModel, relative_sizes
from pyjoystick.identification.fitting.problem.peak_prediction import missing_peaks
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.identification.fitting.result import Criteria, Derived, RecordFit, criteria
from pyjoystick.identification.fitting.solution.search import Minimum
from pyjoystick.identification.fitting.solution.uncertainty import Identifiability, StandardErrors
from pyjoystick.support import FloatArray


def record_fits(problem: Problem, x: FloatArray) -> tuple[RecordFit, ...]:
    """Compare each record with the prediction at x."""
    found = []
    for number, (predictor, predicted, weights) in enumerate(
        zip(problem.predictors, problem.predictions(x), problem.noise.weights, strict=True)
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
                predictor.curve(problem.variables.row(x, number), problem.variables.instrument(x, number))
                if isinstance(predictor, TrajectoryPredictor)
                else None,
                torque_noise=problem.noise.torque_level(number),
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
    least: float,
    make: Make,
) -> list[trust.Check]:
    """Run all checks that apply.

    Args:
        problem: the problem, weighted by the noise
        settings: settings of the fit
        best: the minimum
        known: rank of the Jacobian there
        errors: standard errors there
        records: each record and its fit
        least: residuals up to this size, in the unit of the data, are not noise
        make: makes the problem for other settings, to try effects that the model may lack
    """
    variables = problem.variables
    found = [
        trust.check_convergence(best),
        trust.check_bounds(variables, best.x),
        trust.check_rank(known),
        trust.check_precision(variables.free, best.x, errors.errors),
    ]
    if any(one.uncertainty is not None for one in variables.free):
        found.append(trust.check_known(variables.free, best.x, errors.errors))
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
        counted = [one * share for one, share in zip(residuals, problem.noise.shares, strict=True)]
        found.append(trust.check_size(counted, [one.data for one in records]))
    offsets = [
        (one, value, error)
        for one, value, error in zip(variables.free, best.x, errors.errors, strict=True)
        if one.name == ZERO_OFFSET
    ]
    if offsets:
        found.append(trust.check_zero(offsets))
    torque = check_torque_noise(problem, best.x, errors.errors)
    if torque is not None:
        found.append(torque)
    return [*found, *_residual_checks(problem, settings, best.x, records, least, make)]


def _residual_checks(
    problem: Problem,
    settings: FitSettings,
    x: FloatArray,
    records: Sequence[RecordFit],
    least: float,
    make: Make,
) -> Iterator[trust.Check]:
    """Check whether the residuals are noise; exact data are not checked."""
    names = [one.name for one in records]
    data, levels, titles = [], [], []
    for k, one in enumerate(records):
        late = one.times > problem.variables.instrument(x, k).origin  # held before
        for label, sigma in one.sigma.items():
            data.append(one.data[late & (np.array(one.labels) == label)])
            levels.append(sigma)
            titles.append(one.name if len(one.sigma) == 1 else f"{label} of {one.name}")
    yield residual_checks.check_clipping(titles, data, levels)
    if all(float(np.max(np.abs(one.residuals()))) <= least for one in records):
        return
    view = ResidualView(problem, x)
    times = [one.times for one in records]
    yield residual_checks.check_outliers(view.outliers(), names, times, robust=settings.noise.robust)
    causes, judged, imitated, missed = _causes(problem, settings, x, view, make)
    yield _whiteness(problem, x, view, explained=bool(causes))
    own = sum(one.per_record for one in settings.free)
    shared = len(settings.free) - own
    if not settings.inputs:
        lack = residual_checks.check_repeats(view.repeats, view.innovations, shared, own)
        if lack is not None:
            yield lack
    yield residual_checks.check_suspects(causes, judged, imitated, missed)


def _causes(
    problem: Problem, settings: FitSettings, x: FloatArray, view: ResidualView, make: Make
) -> tuple[list[Finding], int, list[str], list[Unseen]]:
    """Effects that explain the residuals better than noise, the number tried, and any not judged or seen."""
    known: dict[str, list[Suspect]] = {}
    # In colored noise, whose correlation is an estimate, the usual suspects would be found too often.
    is_white = problem.noise.correlation == 0.0
    for suspect in suspects(problem, x):
        known.setdefault(suspect.name, []).append(replace(suspect, usual=suspect.usual and is_white))
    every = [one for several in known.values() for one in several]
    findings = score_test(problem, view.residuals, view.jacobian, every)
    level = 2.0 * residual_checks.CHANCE
    causes = significant(findings, level)
    if causes:
        first = {name: several[0] for name, several in known.items()}
        causes = tried(causes, first, problem, settings, x, make)
    judged = {one.name for one in findings}
    unusual = sum(not one.usual for one in findings)
    imitated = [name for name in known if name not in judged]
    if causes:
        return causes, len(judged), imitated, []
    missed = unseen(problem, x, view.jacobian, every, level / max(unusual, 1), 2.0 * level)
    return [], len(judged), imitated, missed


def _whiteness(problem: Problem, x: FloatArray, view: ResidualView, *, explained: bool) -> trust.Check:
    """Check whether the residuals are white; effects that explain them are not taken for colored noise."""
    if not explained or problem.noise.correlation == 0.0:
        return residual_checks.check_whiteness(
            residual_checks.whiteness(view.series()), problem.noise.correlation
        )
    white = replace(problem, noise=problem.noise.colored(problem.predictors, 0.0))
    found = residual_checks.whiteness(ResidualView(white, x).series())
    return residual_checks.check_whiteness(found, 0.0)


def derived_parameters(
    variables: Variables, x: FloatArray, errors: StandardErrors, names: Sequence[str]
) -> Iterator[Derived]:
    """Tied parameters with errors propagated from the variables, once for all records or for each record.

    Args:
        variables: meaning of x
        x: the minimum
        errors: standard errors there
        names: names of the records
    """
    own = np.array([one.record is not None for one in variables.free])
    for k, record in enumerate(names if variables.tied else ()):
        slopes = _tied_slopes(variables, x, k)
        for name, value, slope in zip(variables.tied, variables.tied_values(x, k), slopes, strict=True):
            of_record = bool(np.any(slope[own] != 0.0))
            if of_record or k == 0:
                yield Derived(name, record if of_record else "", float(value), errors.of(slope), slope)


def _tied_slopes(variables: Variables, x: FloatArray, record: int) -> FloatArray:
    """Derivatives of a record's tied values, shape (tied, variables)."""
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
    settings: FitSettings, records: Sequence[RecordFit], rank: int, cost: float, noise: NoiseModel
) -> Criteria | None:
    """AICc and BIC for normal noise, white or autoregressive, and for that of a measured torque.

    None if peaks are compared, whose errors have no such model. With outliers down-weighted, the weights
    differ between models, so their criteria are hardly comparable.
    """
    if settings.comparison == "peaks":
        return None
    samples = sum(len(one.data) for one in records)
    logs, levels = 0.0, set()
    for one in records:
        for label in one.labels:
            logs += math.log(one.sigma[label])
            levels.add((label, one.sigma[label]))
    estimated = 0 if settings.noise.sigma else len(levels)
    # With an estimated sigma, the likelihood is largest at the root mean square of the residuals.
    spare = max(samples - rank, 1) / samples if estimated else 1.0
    logs += 0.5 * samples * math.log(spare)
    likelihood = -0.5 * cost / spare - logs - 0.5 * samples * math.log(2.0 * math.pi)
    squares = [one.previous**2 for one in noise.memories]
    likelihood -= 0.5 * sum(float(np.sum(np.log1p(-one))) for one in squares)
    likelihood -= 0.5 * sum(one.logarithm for one in noise.whiteners)
    more = any(one.any() for one in squares) + (noise.torque_part > 0.0)
    return criteria(likelihood, rank + estimated + more, samples)
