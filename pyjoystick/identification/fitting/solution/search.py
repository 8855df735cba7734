"""The search for the minimum: bounded least squares from one start or from many."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import qmc

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.settings import Search
from pyjoystick.support import FloatArray

#: Minima are the same if their sums of squares differ by less than this part and their variables by less than
#: this part of their scale.
_SAME_COST: Final = 1e-6
_SAME_PLACE: Final = 1e-3
#: Relative change of the sum of squares or the variables at which a search ends. For exact data, whose sum
#: goes to zero, the search continues as far as it can.
TOLERANCE: Final = 1e-6
#: The same for refinement: about a thousandth of a standard error for a few hundred samples.
REFINED: Final = 1e-8
#: The same with exact derivatives, after which `stationary_point` continues.
EXACT: Final = 1e-10
_STEP_TOLERANCE: Final = 1e-10

#: To first order, a velocity of either sign is another time and angle of the release: there are two minima.
OF_EITHER_SIGN: Final = "omega_start"

#: Called with the number of finished searches and of all searches.
OnStart = Callable[[int, int], None]


@dataclass(frozen=True, slots=True, eq=False)
class Minimum:
    """Result of a search.

    Attributes:
        x: the variables, shape (variables,)
        cost: sum of the squared weighted residuals
        converged: the search met its criteria; False if it ran out of evaluations
        message: how it ended
        evaluations: number of evaluations of the residuals
        found: number of searches that ended here
    """

    x: FloatArray
    cost: float
    converged: bool
    message: str
    evaluations: int
    found: int = 1


def search(
    problem: Problem,
    x: FloatArray,
    *,
    evaluations: int,
    held: Mapping[int, float] | None = None,
    tolerance: float = TOLERANCE,
    central: bool = False,
) -> Minimum:
    """Run one search with SciPy's ``least_squares`` (trust region reflective, which respects bounds).

    Args:
        problem: the problem
        x: start of the search
        evaluations: maximum number of evaluations of the residuals
        held: values of variables that are held, by index
        tolerance: relative change of the sum of squares at which the search ends
        central: use central differences for derivatives; see `ForwardModel.jacobian`
    """
    held = dict(held or {})
    places = [j for j in range(len(x)) if j not in held]
    full = x.copy()
    for j, value in held.items():
        full[j] = value
    if not places:
        return Minimum(full, float(np.sum(problem.residuals(full) ** 2)), True, "nothing is free", 1)

    best = _Best(full, math.inf)

    # SciPy ends a search when steps are small relative to x; the arbitrary zero of a clock must not matter.
    origins = problem.variables.origins[places]

    def point(own: FloatArray) -> FloatArray:
        moved = full.copy()
        moved[places] = origins + own
        return moved

    def residuals(own: FloatArray) -> FloatArray:
        x = point(own)
        found = problem.residuals(x)
        best.offer(x, float(found @ found))
        return found

    def jacobian(own: FloatArray) -> FloatArray:
        return problem.jacobian(point(own), central=central)[:, places]

    lower, upper = problem.variables.lower[places], problem.variables.upper[places]
    # Records that no joystick explains can make SciPy divide by zero; the checks of the fit judge the result.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"), _comparable():
        result = least_squares(
            residuals,
            np.clip(full[places], lower, upper) - origins,
            jac=jacobian,
            bounds=(lower - origins, upper - origins),
            x_scale="jac",
            ftol=tolerance,
            xtol=_STEP_TOLERANCE,
            gtol=None,
            max_nfev=evaluations,
        )
    message = str(result.message).rstrip(".")
    return Minimum(best.x, best.cost, bool(result.success), message, result.nfev)


@contextmanager
def _comparable() -> Iterator[None]:
    """Convert SciPy's error for residuals that are not finite at the start."""
    try:
        yield
    except ValueError as error:
        if "not finite" not in str(error):
            raise
        reason = "the FMU shows nothing there to compare the records with, such as no peaks: correct them"
        raise FitError("start values", reason) from error


def staged_search(problem: Problem, x: FloatArray, *, evaluations: int, stages: Sequence[float]) -> Minimum:
    """Search on growing parts of the records, each search starting at the result of the one before.

    Late samples of an oscillation are many periods away from the start. Far from the solution, they attract
    the search to motions with a wrong number of swings. The first part of a record has no such minima.

    Args:
        problem: the problem
        x: start of the search
        evaluations: maximum number of evaluations on the whole records; a fifth of it on a part
        stages: parts of the duration after the release, increasing, below 1
    """
    for stage in stages:
        weights = tuple(
            weight * _begins(predictor.times, problem.variables.instrument(x, k).origin, stage)
            for k, (weight, predictor) in enumerate(
                zip(problem.noise.weights, problem.predictors, strict=True)
            )
        )
        x = search(problem.with_weights(weights), x, evaluations=max(evaluations // 5, 2)).x
    return search(problem, x, evaluations=evaluations)


def _begins(times: FloatArray, release: float, stage: float) -> NDArray[np.bool_]:
    """Mask of the samples in the first part of a record."""
    return times <= release + stage * (np.max(times) - release)


@dataclass(slots=True, eq=False)
class _Best:
    """The best point so far; without it, a search that is cut short would end at its last trial."""

    x: FloatArray
    cost: float

    def offer(self, x: FloatArray, cost: float) -> None:
        if cost < self.cost:
            self.x, self.cost = x, cost


def multi_start(
    problem: Problem, x: FloatArray, wanted: Search, on_start: OnStart | None = None
) -> list[Minimum]:
    """Search from x and from a Latin hypercube over the bounds of the shared variables.

    Only shared variables with two finite bounds are spread; the others start at their values in x. If there
    are exchanges, a search starts at the best minimum with the variables of each pair exchanged. If the
    initial velocity is fitted, the last search starts where it has the other sign.

    Returns:
        the distinct minima, best first, each with the number of searches that ended in it
    """
    minima: list[Minimum] = []
    for number, start in enumerate(start_points(problem, x, wanted.starts, wanted.seed)):
        found = staged_search(problem, start, evaluations=wanted.evaluations, stages=wanted.stages)
        merge(minima, found, problem)
        if on_start is not None:
            on_start(number + 1, wanted.starts)
    if wanted.exchanges:
        best = min(minima, key=lambda one: one.cost)
        begun = _exchanged(problem, best.x, wanted.exchanges)
        merge(minima, search(problem, begun, evaluations=wanted.evaluations), problem)
    velocities = [j for j, one in enumerate(problem.variables.free) if one.name == OF_EITHER_SIGN]
    if velocities:
        best = min(minima, key=lambda one: one.cost)
        found = _of_other_sign(problem, best.x, velocities, wanted.evaluations)
        if np.any(found.x[velocities] * best.x[velocities] < 0.0):
            minima.append(found)  # another minimum, even if its cost is the same
        else:
            merge(minima, found, problem)
    return sorted(minima, key=lambda one: one.cost)


def _of_other_sign(problem: Problem, x: FloatArray, places: Sequence[int], evaluations: int) -> Minimum:
    """Search from where these variables have the other sign and the others are adapted to that."""
    turned = np.clip(-x, problem.variables.lower, problem.variables.upper)
    held = {j: float(turned[j]) for j in places}
    begun = search(problem, x, evaluations=evaluations, held=held).x
    return search(problem, begun, evaluations=evaluations)


def _exchanged(problem: Problem, x: FloatArray, exchanges: Sequence[tuple[str, str]]) -> FloatArray:
    """X with the values of pairs of variables exchanged, within their bounds."""
    point = x.copy()
    names = [(variable.name, variable.record) for variable in problem.variables.free]
    for first, second in exchanges:
        for i, (name, record) in enumerate(names):
            if name == first and (second, record) in names:
                j = names.index((second, record))
                point[i], point[j] = x[j], x[i]
    return np.clip(point, problem.variables.lower, problem.variables.upper)


def start_points(problem: Problem, x: FloatArray, starts: int, seed: int) -> list[FloatArray]:
    """X itself and `starts` - 1 points of a Latin hypercube."""
    spread = [
        j
        for j, one in enumerate(problem.variables.free)
        if one.record is None and math.isfinite(one.minimum) and math.isfinite(one.maximum)
    ]
    points = [x.copy()]
    if starts > 1 and spread:
        low, high = problem.variables.lower[spread], problem.variables.upper[spread]
        for part in qmc.LatinHypercube(len(spread), rng=np.random.default_rng(seed)).random(starts - 1):
            point = x.copy()
            point[spread] = low + part * (high - low)
            points.append(point)
    return points


def merge(minima: list[Minimum], found: Minimum, problem: Problem) -> None:
    """Count a search for the minimum at which it ended, or add a new minimum."""
    scales = np.array([variable.scale for variable in problem.variables.free])
    for i, known in enumerate(minima):
        close = abs(known.cost - found.cost) <= _SAME_COST * max(known.cost, found.cost)
        if close or np.all(np.abs(known.x - found.x) <= _SAME_PLACE * scales):
            better = found if found.cost < known.cost else known
            minima[i] = replace(better, found=known.found + 1)
            return
    minima.append(found)
