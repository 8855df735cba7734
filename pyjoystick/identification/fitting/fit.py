"""The fit, from records and settings to a result: set up, search, uncertainty."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from typing import Final

import numpy as np

from pyjoystick.fmu import Fmu
from pyjoystick.identification.errors import FitError, FitInterruptedError
from pyjoystick.identification.fitting.assessment import (
    all_checks,
    criteria_of,
    derived_parameters,
    record_fits,
)
from pyjoystick.identification.fitting.checks.noise_shape import first_shape, shaped
from pyjoystick.identification.fitting.checks.rivals import Make
from pyjoystick.identification.fitting.checks.trust import Check, check_profiles
from pyjoystick.identification.fitting.order import as_given, ordered_records, ordered_settings
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings
from pyjoystick.identification.fitting.problem.instrument import CLOCK, INSTRUMENT
from pyjoystick.identification.fitting.problem.least_squares import Problem, StepChoice, choose_steps
from pyjoystick.identification.fitting.problem.measurement import Measurement, measurements
from pyjoystick.identification.fitting.problem.noise_model import first_weights
from pyjoystick.identification.fitting.problem.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.problem.prediction import Predictor, TrajectoryPredictor
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.problem.variables import Variables
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
from pyjoystick.support import FloatArray, ParameterError, UnknownVariableError, notebook_progress, type_text


def make_problem(records: Iterable[Record | Measurement], settings: FitSettings, fmu: Fmu) -> Problem:
    """The least-squares problem that `fit` solves; raises as it does."""
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
    problem = Problem(variables, predictors, first_weights(predictors, settings.noise), settings.tolerance)
    problem.predictions(variables.start)
    return problem


def _predictor(
    shared: FmuSettings, settings: FitSettings, record: Measurement, free_clock: bool
) -> Predictor:
    known = shared.fmu.description.variables
    is_needed = free_clock or settings.comparison == "peaks"
    # Driven, a motion before its origin came along as it goes on, where its slope is known.
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


#: Called with the stage, what is done of it and of how much.
OnProgress = Callable[[str, int, int], None]

#: Noise and minimum are estimated in turn until they agree, but no more often than this.
_MOST_ROUNDS: Final = 10
_UNSETTLED: Final = Check(
    "noise", False, "the estimate of the noise and the minimum do not agree: give the noise's sigma"
)
#: Tolerance of the FMU at the solution: its results then scatter by rounding errors alone, and differences
#: tell a weak influence from none.
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
        records: what was measured
        settings: what to fit and how
        fmu: the FMU of the settings, if already open
        on_progress: called while the fit goes on; where not given, a notebook shows a bar

    Raises:
        FitError: a record or the FMU does not go with the settings, or the first run fails
        FitInterruptedError: Ctrl-C before the search was done
        ParameterError, UnknownParameterError, UnknownVariableError: a name, value or type is not allowed
        UnsupportedFmuError: what lies in ``sensitivities`` beside the FMU is of another model
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
        problem = make_problem(measured, ordered, opened)
        solution = _at_solution(problem, measured, ordered, opened)
        minima, steps, settled = _search(problem, solution, ordered, tell)

        def make(other: FitSettings, fmu: Fmu | None, *, mirrored: bool = False) -> Problem:
            shown = [one.mirrored() for one in measured] if mirrored else measured
            return make_problem(shown, other, fmu or opened)

        found = _judged(solution, ordered, minima, steps, make, tell)
        if not settled:
            found = replace(found, checks=(*found.checks, _UNSETTLED))
    found = as_given(found, settings, [one.name for one in given])
    runs = found.runs + (problem.runs if problem is not solution else 0)
    return replace(found, runs=runs, seconds=time.perf_counter() - begun)


def fitted_values(
    records: Iterable[Record | Measurement], settings: FitSettings, fmu: Fmu
) -> dict[str, float]:
    """The parameters that all records share, as `fit` finds them, without errors and checks.

    Raises:
        as `fit`
    """
    ordered, measured = ordered_settings(settings), ordered_records(measurements(records))
    problem = make_problem(measured, ordered, fmu)
    solution = _at_solution(problem, measured, ordered, fmu)
    minima, *_ = _search(problem, solution, ordered, lambda stage, done, total: None)
    found = zip(solution.variables.free, minima[0].x, strict=True)
    return {one.name: float(value) for one, value in found if one.record is None}


def _at_solution(
    problem: Problem, measured: Sequence[Measurement], settings: FitSettings, fmu: Fmu
) -> Problem:
    """The same problem at a tighter tolerance of the FMU, or the problem itself where the FMU fails there."""
    if settings.tolerance <= _SOLUTION_TOLERANCE:
        return problem
    try:
        return make_problem(measured, replace(settings, tolerance=_SOLUTION_TOLERANCE), fmu)
    except FitError:
        return problem


def _search(
    problem: Problem, solution: Problem, settings: FitSettings, tell: OnProgress
) -> tuple[list[Minimum], StepChoice, bool]:
    """The minima, the best one refined on `solution`, whose weights become those of the noise found there.

    Last, whether minimum and noise agree.
    """
    problem.steps = choose_steps(problem, problem.variables.start, central=False).steps
    starts = settings.search.starts
    tell("searching", 0, starts)
    minima = multi_start(
        problem,
        problem.variables.start,
        settings.search,
        lambda done, total: tell("searching", done, total),
    )
    for one in scan(problem, minima[0], settings.scanned, settings.search.evaluations):
        merge(minima, one, problem)
    best, *others = sorted(minima, key=lambda one: one.cost)
    steps = choose_steps(solution, best.x)
    solution.steps = steps.steps
    best = _refined(solution, best, settings)
    shape = first_shape(solution, settings)
    settled = False
    for _ in range(_MOST_ROUNDS):
        before, shape = shape, shaped(solution, best.x, settings, steps.least(settings.tolerance))
        settled = shape.settled(before)
        if settled:
            break
        best = _refined(solution, best, settings)
    best, *others = (_recosted(solution, one) for one in (best, *others))
    others.sort(key=lambda one: one.cost)
    return [best, *others], steps, settled


def _recosted(solution: Problem, minimum: Minimum) -> Minimum:
    """The minimum with its sum of squares under the noise that was found."""
    return replace(minimum, cost=float(np.sum(solution.residuals(minimum.x) ** 2)))


def _refined(solution: Problem, minimum: Minimum, settings: FitSettings) -> Minimum:
    """The minimum with the derivatives of the solution."""
    evaluations = settings.search.evaluations
    is_exact = all(solution.exact)
    tolerance = EXACT if is_exact else REFINED
    found = search(solution, minimum.x, evaluations=evaluations, tolerance=tolerance, central=True)
    if is_exact:
        found = stationary_point(solution, found)
    return replace(found, evaluations=minimum.evaluations + found.evaluations, found=minimum.found)


def _judged(
    problem: Problem,
    settings: FitSettings,
    minima: Sequence[Minimum],
    steps: StepChoice,
    make: Make,
    tell: OnProgress,
) -> Fit:
    """The result of a search: uncertainties, checks, profiles, bootstrap."""
    variables, best = problem.variables, minima[0]
    labels = variables.labels
    scales = np.array([one.scale for one in variables.free])
    blocks = [np.where(steps.errors < SCATTER, block, 0.0) for block in problem.jacobians(best.x)]
    counted = (problem.counted(block, k) for k, block in enumerate(blocks))
    jacobian = np.concatenate((*counted, problem.prior))
    known = identifiability(jacobian, best.x, scales, labels, steps.errors)
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
    derived = tuple(derived_parameters(variables, best.x, errors, [one.name for one in records]))
    profiles: dict[int, Profile] = {}
    drawn, interrupted = None, stopped
    if not stopped:
        profiles, drawn, interrupted = _optional(problem, settings, best, errors, tell)
    if profiles:
        checks.append(check_profiles(labels, profiles))
    return Fit(
        settings=settings,
        variables=variables.free,
        x=best.x,
        cost=best.cost,
        standard_errors=errors,
        intervals=errors.intervals(best.x),
        derived=derived,
        minima=tuple(minima),
        identifiability=known,
        criteria=criteria_of(settings, records, known.rank, best.cost, problem.memories),
        records=records,
        checks=tuple(checks),
        steps=steps,
        correlation=problem.correlation,
        runs=problem.runs,
        seconds=0.0,
        profiles=profiles,
        bootstrap=drawn,
        interrupted=interrupted,
    )


def _errors_of(block: FloatArray, covariance: FloatArray) -> FloatArray | None:
    """Standard errors of the predictions of one record; None where a variable is undetermined.

    Args:
        block: derivatives of the predictions, in the unit of the data, shape (n, variables)
        covariance: of the variables, shape (variables, variables)
    """
    if not np.all(np.isfinite(covariance)):
        return None
    return np.asarray(np.sqrt(np.einsum("ij,jk,ik->i", block, covariance, block)))


def _optional(
    problem: Problem, settings: FitSettings, best: Minimum, errors: StandardErrors, tell: OnProgress
) -> tuple[dict[int, Profile], Bootstrap | None, bool]:
    """Profiles and bootstrap, as far as they came before Ctrl-C."""
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
