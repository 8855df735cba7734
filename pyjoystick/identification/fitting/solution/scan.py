"""Other minima along a valley: slightly stronger friction stops a motion one swing earlier.

If a joystick comes to rest within a record, the swing after which it sticks depends on the friction, and the
sum of squares has a minimum for each number of swings. Friction and damping compensate for each other, so
these minima lie along a valley, a few percent of the friction apart.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.solution.search import Minimum, search
from pyjoystick.support import FloatArray

#: Scanned distances from the minimum in standard errors, and factors farther away, on either side.
_NEAR: Final = (1.5, 3.0, 4.5, 6.0)
_FACTOR: Final = 1.05
_FACTORS: Final = 10
#: A motion may come to rest if it does so with friction larger by this factor.
_MORE: Final = 1.5
#: Evaluations with the friction held, and the relative change of the sum of squares that ends them.
_EVALUATIONS: Final = 3
_TOLERANCE: Final = 1e-3
#: A dip is followed to its minimum if its sum of squares is at most this multiple of the smallest.
_DEEP: Final = 3.0
#: A value below this part of its scale is scanned starting from that part.
_LEAST: Final = 0.1


def scan(problem: Problem, best: Minimum, names: Sequence[str], evaluations: int) -> list[Minimum]:
    """Find minima along the valley in which other parameters compensate for a common factor on some.

    Does nothing if no motion comes to rest within its record.

    Args:
        problem: the problem
        best: the minimum found by a search
        names: the parameters; only those that all records share are used
        evaluations: maximum number of evaluations of the residuals for each minimum
    """
    free = problem.variables.free
    shared = [j for j, one in enumerate(free) if one.name in names and one.record is None]
    # Prior knowledge would hide the dips of the other minima.
    places = [j for j in shared if free[j].uncertainty is None] or shared
    if not places:
        return []
    base = np.maximum(best.x[places], [_LEAST * problem.variables.free[j].scale for j in places])
    if not _may_stick(problem, _with(problem, best.x, places, _MORE * base)):
        return []
    factors = _factors(problem, best, places, base)
    lower = _walked(problem, best, places, base, factors[factors < 1.0][::-1])
    upper = _walked(problem, best, places, base, factors[factors > 1.0])
    line = [*lower[::-1], best, *upper]
    least = min(one.cost for one in line)
    dips = [one for one in _dips(line) if one is not best and one.cost < _DEEP * least]
    return [search(problem, one.x, evaluations=evaluations) for one in dips]


def _with(problem: Problem, x: FloatArray, places: Sequence[int], values: FloatArray) -> FloatArray:
    """X with some values replaced, within the bounds."""
    point = x.copy()
    point[places] = values
    return np.clip(point, problem.variables.lower, problem.variables.upper)


def _may_stick(problem: Problem, x: FloatArray) -> bool:
    """Whether any two consecutive predicted samples of a moving record are bitwise equal."""
    try:
        predictions = problem.predictions(x)
    except FitError:
        return False
    for k, (predictor, predicted) in enumerate(zip(problem.predictors, predictions, strict=True)):
        moving = predictor.times > problem.variables.instrument(x, k).origin
        next_one = np.diff(predictor.times) > 0.0
        if np.any((np.diff(predicted) == 0.0) & moving[:-1] & next_one):
            return True
    return False


def _factors(problem: Problem, best: Minimum, places: Sequence[int], base: FloatArray) -> FloatArray:
    """Factors for the parameters: close by, in standard errors; farther away, in equal ratios."""
    far: FloatArray = np.power(_FACTOR, np.arange(1.0, _FACTORS + 1.0))
    far = np.concatenate((1.0 / far[::-1], far))
    jacobian = problem.jacobian(best.x, central=False)
    along = jacobian[:, places] @ base
    others = np.delete(jacobian, places, axis=1)
    lengths = np.linalg.norm(others, axis=0)
    others = others / np.where(lengths > 0.0, lengths, 1.0)
    own = float(np.linalg.norm(along - others @ np.linalg.lstsq(others, along, rcond=1e-10)[0]))
    scatter = math.sqrt(best.cost / max(problem.terms - len(best.x), 1))
    near = np.array(_NEAR) * (scatter / own if own > 0.0 else 0.0)
    near = near[near < math.log(_FACTOR) * _FACTORS]
    if not near.size:
        return far
    close = np.exp(np.concatenate((-near[::-1], near)))
    beyond = far[(far < close[0]) | (far > close[-1])]
    return np.sort(np.concatenate((close, beyond)))


def _walked(
    problem: Problem, best: Minimum, places: Sequence[int], base: FloatArray, factors: FloatArray
) -> list[Minimum]:
    """Minimize over the other variables with the parameters held, step by step away from the minimum."""
    found: list[Minimum] = []
    x = best.x
    for factor in factors:
        point = _with(problem, x, places, factor * base)
        held = {j: float(point[j]) for j in places}
        one = search(problem, point, evaluations=_EVALUATIONS, held=held, tolerance=_TOLERANCE)
        found.append(one)
        x = one.x
    return found


def _dips(line: Sequence[Minimum]) -> list[Minimum]:
    """Points whose sum of squares is smaller than at both neighbors, or at the only one at an end."""
    costs = np.array([math.inf, *(one.cost for one in line), math.inf])
    return [one for i, one in enumerate(line) if costs[i + 1] < min(costs[i], costs[i + 2])]
