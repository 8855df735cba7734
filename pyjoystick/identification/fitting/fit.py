"""The fit, from records and settings to a result: setup, search, uncertainty."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from pyjoystick.fmu import Fmu
from pyjoystick.identification.errors import FitError, FitInterruptedError
from pyjoystick.identification.fitting.assessment import (
    all_checks,
    criteria_of,
    derived_parameters,
    record_fits,
)
from pyjoystick.identification.fitting.checks.noise_shape import has_settled, with_noise_of
from pyjoystick.identification.fitting.checks.rivals import Make
from pyjoystick.identification.fitting.checks.trust import Check, check_profiles, check_sign
from pyjoystick.identification.fitting.order import as_given, ordered_records, ordered_settings
from pyjoystick.identification.fitting.problem.difference_steps import StepChoice, choose_steps
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.measurement import Measurement, measurements
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.identification.fitting.solution.bootstrap import Bootstrap, bootstrap
from pyjoystick.identification.fitting.solution.profile import Profile, profile
from pyjoystick.identification.fitting.solution.scan import scan
from pyjoystick.identification.fitting.solution.search import (
    EXACT,
    REFINED,
    Minimum,
    merge,
    multi_start,
    search,
)
from pyjoystick.identification.fitting.solution.stationary import stationary_point
from pyjoystick.identification.fitting.solution.uncertainty import (
    SCATTER,
    StandardErrors,
    identifiability,
    standard_errors,
)
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray, ParameterError, notebook_progress, type_text

_LOG = logging.getLogger(__name__)

#: Called with the stage, the amount done and the total.
OnProgress = Callable[[str, int, int], None]

#: Noise and minimum are estimated in turn until they agree, at most this many times.
_MOST_ROUNDS: Final = 10
_UNSETTLED: Final = Check(
    "noise", False, "the estimate of the noise and the minimum do not agree: give the noise's sigma"
)
#: Tolerance of the FMU at the solution. At this tolerance only rounding errors scatter its results, so that
#: differences can distinguish a weak influence from none.
_SOLUTION_TOLERANCE: Final = 1e-10


def fit(
    records: Iterable[Record | Measurement],
    settings: FitSettings,
    *,
    fmu: Fmu | None = None,
    on_progress: OnProgress | None = None,
) -> Fit:
    """Fit parameters of an FMU to records.

    Args:
        records: measured records
        settings: what to fit and how
        fmu: the FMU of the settings, if already open
        on_progress: called during the fit; if None, a notebook shows a progress bar

    Raises:
        FitError: a record or the FMU does not match the settings, or the first run fails
        FitInterruptedError: Ctrl-C before the search was finished
        ParameterError, UnknownParameterError, UnknownVariableError: a name, value or type is not allowed
        UnsupportedFmuError: the FMU in the ``sensitivities`` folder next to the FMU is of another model
    """
    begun = time.perf_counter()
    if not isinstance(settings, FitSettings):
        raise ParameterError("settings", type_text(settings), "FitSettings, as CONSTANT_DAMPING")
    if fmu is not None and not isinstance(fmu, Fmu):
        raise ParameterError("fmu", fmu, "an open Fmu; the settings name another one by replace(..., fmu=)")
    given = measurements(records)
    ordered, measured = ordered_settings(settings), ordered_records(given)
    progress = notebook_progress("fit") if on_progress is None else nullcontext(on_progress)
    with nullcontext(fmu) if fmu is not None else Fmu(settings.fmu) as opened, progress as tell:
        found = _searched(measured, ordered, opened, tell)

        def make(other: FitSettings, fmu: Fmu | None, *, mirrored: bool = False) -> Problem:
            tell("looking for causes", 0, 1)
            shown = [one.mirrored() for one in measured] if mirrored else measured
            return make_problem(shown, other, fmu or opened)

        judged = _judged(found, ordered, make, tell)
        runs = judged.runs + found.runs_before
    _LOG.info("fitted with %d runs of the FMU", runs)
    judged = as_given(judged, settings, [one.name for one in given])
    return replace(judged, runs=runs, seconds=time.perf_counter() - begun)


def fitted_values(
    records: Iterable[Record | Measurement], settings: FitSettings, fmu: Fmu
) -> dict[str, float]:
    """Fit only the parameters that all records share, without errors and checks.

    Raises:
        as `fit`
    """
    ordered, measured = ordered_settings(settings), ordered_records(measurements(records))
    found = _searched(measured, ordered, fmu, lambda stage, done, total: None)
    values = zip(found.problem.variables.free, found.minima[0].x, strict=True)
    return {one.name: float(value) for one, value in values if one.record is None}


class _Found(NamedTuple):
    """Result of a search.

    Attributes:
        problem: at the tolerance of the solution, with the noise and the difference steps estimated there
        minima: best first
        steps: difference steps at the best minimum
        settled: whether minimum and noise agree
        runs_before: FMU runs at the larger tolerance, before refinement
    """

    problem: Problem
    minima: tuple[Minimum, ...]
    steps: StepChoice
    settled: bool
    runs_before: int


def _searched(measured: Sequence[Measurement], settings: FitSettings, fmu: Fmu, tell: OnProgress) -> _Found:
    """Search at the tolerance of the settings, then refine the best minimum at that of the solution.

    Estimating the noise from the residuals alternates with refining the minimum until the two agree.
    """
    first = make_problem(measured, settings, fmu)
    names = ", ".join(first.variables.labels)
    _LOG.info("fit of %d values to %d records: %s", len(first.variables.free), len(measured), names)
    solution = _at_solution(first, measured, settings, fmu)
    best, *others = _coarse_minima(first, settings, tell)
    _LOG.info("searched: %d minima, the least sum of squares %.9g", 1 + len(others), best.cost)
    steps = choose_steps(solution.model, best.x)
    problem = replace(solution, steps=steps.steps)
    best = _refined(problem, best, settings)
    settled = False
    for number in range(1, _MOST_ROUNDS + 1):
        tell("estimating the noise", 0, 1)
        before, problem = problem, with_noise_of(problem, best.x, settings, steps.least(settings.tolerance))
        settled = has_settled(before, problem, settings)
        _LOG.info("noise, round %d: %s", number, "settled" if settled else "has changed")
        if settled:
            break
        best = _refined(problem, best, settings)
    best, *others = (_recosted(problem, one) for one in (best, *others))
    others.sort(key=lambda one: one.cost)
    runs_before = first.model.runs if solution is not first else 0
    return _Found(problem, (best, *others), steps, settled, runs_before)


def _at_solution(
    problem: Problem, measured: Sequence[Measurement], settings: FitSettings, fmu: Fmu
) -> Problem:
    """The same problem at a tighter tolerance of the FMU, or the problem itself if the FMU fails there."""
    if settings.tolerance <= _SOLUTION_TOLERANCE:
        return problem
    try:
        return make_problem(measured, replace(settings, tolerance=_SOLUTION_TOLERANCE), fmu)
    except FitError:
        return problem


def _coarse_minima(problem: Problem, settings: FitSettings, tell: OnProgress) -> list[Minimum]:
    """Minima from all starts and from the scan, best first."""
    start = problem.variables.start
    problem = replace(problem, steps=choose_steps(problem.model, start, central=False).steps)
    tell("searching", 0, settings.search.starts)
    minima = multi_start(problem, start, settings.search, lambda done, total: tell("searching", done, total))
    for one in scan(problem, minima[0], settings.scanned, settings.search.evaluations):
        merge(minima, one, problem)
    return sorted(minima, key=lambda one: one.cost)


def _recosted(problem: Problem, minimum: Minimum) -> Minimum:
    """The minimum with its sum of squares recomputed for the estimated noise."""
    return replace(minimum, cost=float(np.sum(problem.residuals(minimum.x) ** 2)))


def _refined(problem: Problem, minimum: Minimum, settings: FitSettings) -> Minimum:
    """Refine the minimum with the derivatives of the solution."""
    evaluations = settings.search.evaluations
    is_exact = all(problem.model.exact)
    tolerance = EXACT if is_exact else REFINED
    found = search(problem, minimum.x, evaluations=evaluations, tolerance=tolerance, central=True)
    if is_exact:
        found = stationary_point(problem, found)
    return replace(found, evaluations=minimum.evaluations + found.evaluations, found=minimum.found)


def _judged(found: _Found, settings: FitSettings, make: Make, tell: OnProgress) -> Fit:
    """Complete a search: uncertainties, checks, profiles, bootstrap."""
    problem, steps, best = found.problem, found.steps, found.minima[0]
    variables = problem.variables
    labels = variables.labels
    sizes = np.array([one.size(value) for one, value in zip(variables.free, best.x.tolist(), strict=True)])
    blocks = [np.where(steps.errors < SCATTER, block, 0.0) for block in problem.jacobians(best.x)]
    counted = (problem.noise.counted(block, k) for k, block in enumerate(blocks))
    jacobian = np.concatenate((*counted, problem.prior))
    known = identifiability(jacobian, sizes, labels, steps.errors)
    sigma_known = bool(settings.noise.sigma)
    errors = standard_errors(
        jacobian, known, problem.terms, settings.uncertainty.level, sigma_known=sigma_known
    )
    records = tuple(
        replace(one, errors=_errors_of(block, errors.covariance))
        for one, block in zip(record_fits(problem, best.x), blocks, strict=True)
    )
    least = steps.least(settings.tolerance)
    stopped = False
    try:
        checks = all_checks(problem, settings, best, known, errors, records, least, make)
    except FitInterruptedError:
        checks, stopped = [Check("complete", False, "stopped before the residuals were judged")], True
    failed = ", ".join(one.name for one in checks if not one.passed)
    _LOG.info("judged: %d checks, failed: %s", len(checks), failed or "none")
    derived = tuple(derived_parameters(variables, best.x, errors, [one.name for one in records]))
    profiles: dict[int, Profile] = {}
    drawn, interrupted = None, stopped
    if not stopped:
        profiles, drawn, interrupted = _optional(problem, settings, best, errors, tell)
    if profiles:
        checks.append(check_profiles(labels, profiles))
    sign = check_sign(variables, found.minima)
    if sign is not None:
        checks.append(sign)
    if not found.settled:
        checks.append(_UNSETTLED)
    return Fit(
        settings=settings,
        variables=variables.free,
        x=best.x,
        cost=best.cost,
        standard_errors=errors,
        intervals=errors.intervals(best.x),
        derived=derived,
        minima=found.minima,
        identifiability=known,
        criteria=criteria_of(settings, records, known.rank, best.cost, problem.noise),
        records=records,
        checks=tuple(checks),
        steps=steps,
        correlation=problem.noise.correlation,
        runs=problem.model.runs,
        seconds=0.0,
        profiles=profiles,
        bootstrap=drawn,
        interrupted=interrupted,
    )


def _errors_of(block: FloatArray, covariance: FloatArray) -> FloatArray | None:
    """Standard errors of the predictions of one record; None if a variable is undetermined.

    Args:
        block: derivatives of the predictions, in the unit of the data, shape (n, variables)
        covariance: covariance of the variables, shape (variables, variables)
    """
    if not np.all(np.isfinite(covariance)):
        return None
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", block, covariance, block)))


def _optional(
    problem: Problem, settings: FitSettings, best: Minimum, errors: StandardErrors, tell: OnProgress
) -> tuple[dict[int, Profile], Bootstrap | None, bool]:
    """Profiles and bootstrap; after Ctrl-C, those that are finished."""
    profiles: dict[int, Profile] = {}
    drawn: Bootstrap | None = None
    wanted = settings.uncertainty
    shared = [j for j, one in enumerate(problem.variables.free) if one.record is None]
    chosen = [
        j for j in shared if wanted.profiles is None or problem.variables.free[j].name in wanted.profiles
    ]
    try:
        for done, j in enumerate(chosen):
            tell("profiles", done, len(chosen))
            profiles[j] = profile(problem, best.x, best.cost, j, errors)
        if chosen:
            tell("profiles", len(chosen), len(chosen))
        if wanted.bootstrap:
            drawn = bootstrap(
                problem,
                best.x,
                wanted.bootstrap,
                wanted.resampling,
                settings.search.seed,
                lambda done, total: tell("bootstrap", done, total),
            )
    except FitInterruptedError:
        return profiles, drawn, True
    return profiles, drawn, False
