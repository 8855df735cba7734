"""The fit, from records and settings to a result: set up, search, uncertainty."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import nullcontext
from dataclasses import replace

import numpy as np

from pyjoystick.fmu import Fmu
from pyjoystick.identification.errors import FitError, FitInterruptedError
from pyjoystick.identification.fitting.assessment import (
    all_checks,
    criteria_of,
    derived_parameters,
    record_fits,
)
from pyjoystick.identification.fitting.bootstrap import Bootstrap, bootstrap
from pyjoystick.identification.fitting.measurement import Measurement, measurements
from pyjoystick.identification.fitting.noise_model import estimated_sigmas, first_weights, weights_of
from pyjoystick.identification.fitting.order import as_given, ordered_records, ordered_settings
from pyjoystick.identification.fitting.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.prediction import FmuSettings, Predictor, TrajectoryPredictor
from pyjoystick.identification.fitting.problem import Problem, StepChoice, choose_steps
from pyjoystick.identification.fitting.profile import Profile, profile
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.identification.fitting.search import REFINED, Minimum, multi_start, search
from pyjoystick.identification.fitting.settings import RELEASE_TIME, FitSettings
from pyjoystick.identification.fitting.trust import check_profiles
from pyjoystick.identification.fitting.uncertainty import (
    SCATTER,
    StandardErrors,
    identifiability,
    standard_errors,
)
from pyjoystick.identification.fitting.variables import Variables
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray, ParameterError, UnknownVariableError


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
    problem = Problem(variables, predictors, first_weights(predictors, settings.noise), settings.tolerance)
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


#: Called with the stage, what is done of it and of how much.
OnProgress = Callable[[str, int, int], None]

#: The estimates of several noise levels are repeated until they change by less than this part.
_NOISE_CHANGE = 1e-4
_MOST_ROUNDS = 10
#: Tolerance of the FMU at the solution: its results then scatter by rounding errors alone, and differences
#: tell a weak influence from none.
_SOLUTION_TOLERANCE = 1e-10


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
        on_progress: called while the fit goes on

    Raises:
        FitError: a record or the FMU does not go with the settings, or the first run fails
        FitInterruptedError: Ctrl-C before the search was done
        ParameterError, UnknownParameterError, UnknownVariableError: a name or value is not allowed
    """
    begun = time.perf_counter()
    tell = on_progress or (lambda stage, done, total: None)
    given = measurements(records)
    ordered, measured = ordered_settings(settings), ordered_records(given)
    with nullcontext(fmu) if fmu is not None else Fmu(settings.fmu) as opened:
        problem = make_problem(measured, ordered, opened)
        solution = _at_solution(problem, measured, ordered, opened)
        found = _judged(solution, ordered, *_search(problem, solution, ordered, tell), tell)
    found = as_given(found, settings, [one.name for one in given])
    runs = found.runs + (problem.runs if problem is not solution else 0)
    return replace(found, runs=runs, seconds=time.perf_counter() - begun)


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
) -> tuple[list[Minimum], StepChoice]:
    """The minima, the best one refined on `solution`, whose weights become those of the noise found there."""
    problem.steps = choose_steps(problem, problem.variables.start, central=False).steps
    starts = settings.search.starts
    tell("searching", 0, starts)
    best, *others = multi_start(
        problem,
        problem.variables.start,
        settings.search,
        lambda done, total: tell("searching", done, total),
    )
    steps = choose_steps(solution, best.x)
    solution.steps = steps.steps
    best = _refined(solution, best, settings)
    if settings.noise.sigma:
        return [best, *others], steps
    peaks = settings.comparison == "peaks"
    several = settings.noise.per_record or (len(settings.outputs) > 1 and not peaks)
    before: FloatArray | None = None
    for _ in range(_MOST_ROUNDS):
        sigmas = estimated_sigmas(solution, best.x, per_record=settings.noise.per_record, combined=peaks)
        old = solution.weights
        solution.weights = weights_of(solution, sigmas)
        if not several:
            # The same weights but for a factor: the minima stay where they are.
            factor = float(solution.weights[0][0] / old[0][0])
            return [replace(one, cost=one.cost * factor**2) for one in (best, *others)], steps
        best = _refined(solution, best, settings)
        levels = np.array([value for one in sigmas for value in one.values()])
        if before is not None and np.allclose(levels, before, rtol=_NOISE_CHANGE, atol=0.0):
            break
        before = levels
    return [best, *others], steps


def _refined(solution: Problem, minimum: Minimum, settings: FitSettings) -> Minimum:
    """The minimum with the derivatives of the solution."""
    evaluations = settings.search.evaluations
    found = search(solution, minimum.x, evaluations=evaluations, tolerance=REFINED, central=True)
    return replace(found, evaluations=minimum.evaluations + found.evaluations, found=minimum.found)


def _judged(
    problem: Problem, settings: FitSettings, minima: Sequence[Minimum], steps: StepChoice, tell: OnProgress
) -> Fit:
    """The result of a search: uncertainties, checks, profiles, bootstrap."""
    variables, best = problem.variables, minima[0]
    labels = variables.labels
    scales = np.array([one.scale for one in variables.free])
    jacobian = np.where(steps.errors < SCATTER, problem.jacobian(best.x), 0.0)
    known = identifiability(jacobian, best.x, scales, labels, steps.errors)
    sigma_known = bool(settings.noise.sigma)
    errors = standard_errors(
        jacobian, known, problem.size, settings.uncertainty.level, sigma_known=sigma_known
    )
    records = record_fits(problem, best.x)
    checks = all_checks(problem, settings, best, known, errors, records, steps.noise)
    derived = tuple(derived_parameters(variables, best.x, errors, [one.name for one in records]))
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
        criteria=criteria_of(settings, records, known.rank, best.cost),
        records=records,
        checks=tuple(checks),
        steps=steps,
        runs=problem.runs,
        seconds=0.0,
        profiles=profiles,
        bootstrap=drawn,
        interrupted=interrupted,
    )


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
