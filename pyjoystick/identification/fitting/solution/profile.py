"""Profile likelihood: increase of the best cost as one parameter is held away from its best value."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.solution.search import search
from pyjoystick.identification.fitting.solution.uncertainty import StandardErrors
from pyjoystick.support import FloatArray

#: The first step on either side, in half-widths of the linear interval.
_FIRST_STEP: Final = 0.55
#: Target and largest growth of the distance in one step, as parts of the quantile.
_GROWTH: Final = 0.55
_LARGEST_GROWTH: Final = 0.9
_SHORTER: Final = 0.35
_MOST_POINTS: Final = 14
_EVALUATIONS: Final = 40
#: Relative change of the sum of squares at which a search ends.
_TOLERANCE: Final = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """Profile of one variable.

    Attributes:
        variable: index of the variable
        values: values at which it was held, increasing, shape (n,)
        distances: square root of the increase of the sum of squares over the minimum, in standard deviations
            of the noise, negative below the best value, shape (n,); a straight line if the model is linear
        interval: values at which the distance reaches the confidence level; infinite if it does not
        bounded: whether the search reached the lower and the upper bound of the variable
        lower: by how much the sum of squares fell below that of the minimum, else 0; if it fell, the
            minimum was none
        converged: whether every search over the others converged; otherwise the interval is too narrow
    """

    variable: int
    values: FloatArray
    distances: FloatArray
    interval: tuple[float, float]
    bounded: tuple[bool, bool]
    lower: float
    converged: bool


def profile(problem: Problem, x: FloatArray, cost: float, variable: int, errors: StandardErrors) -> Profile:
    """Hold a variable at values on either side of its best one and minimize over the others.

    Args:
        problem: residuals in units of the noise's standard deviation
        x: the minimum
        cost: its sum of squares
        variable: index of the variable
        errors: standard errors at the minimum; if that of the variable is infinite, the first step is
            a tenth of its scale
    """
    one = problem.variables.free[variable]
    error, quantile = float(errors.errors[variable]), errors.quantile
    # Slopes of the other variables along the profile, in the linear approximation.
    slope = np.nan_to_num(errors.covariance[:, variable] / error**2)
    first = quantile * error if np.isfinite(error) and error > 0.0 else 0.1 * one.scale
    values, distances = [float(x[variable])], [0.0]
    ends, bounded = [], []
    lower, converged = 0.0, True
    for sign, bound in ((-1.0, one.lowest), (1.0, one.highest)):
        points, least, settled = _side(problem, x, cost, variable, sign, first, bound, quantile, slope)
        values += [value for value, _ in points]
        distances += [distance for _, distance in points]
        ends.append(_end([(float(x[variable]), 0.0), *points], sign * quantile))
        bounded.append(bool(points) and points[-1][0] == bound and abs(points[-1][1]) < quantile)
        lower = max(lower, cost - least)
        converged = converged and settled
    order = np.argsort(values)
    return Profile(
        variable,
        np.array(values)[order],
        np.array(distances)[order],
        (ends[0], ends[1]),
        (bounded[0], bounded[1]),
        lower,
        converged,
    )


def _side(
    problem: Problem,
    x: FloatArray,
    cost: float,
    variable: int,
    sign: float,
    first: float,
    bound: float,
    quantile: float,
    slope: FloatArray,
) -> tuple[list[tuple[float, float]], float, bool]:
    """Walk from the best value outward until the quantile is passed or a bound is reached.

    A step that makes the distance grow too much is retried with a shorter one; otherwise the search over the
    others would start too far away, or the interval would be interpolated across too wide a gap.

    Returns:
        values and distances; the smallest sum of squares; whether every search converged
    """
    found: list[tuple[float, float]] = []
    least, converged = cost, True
    near, nearest, distance = x, float(x[variable]), 0.0
    step = _FIRST_STEP * first
    for _ in range(_MOST_POINTS):
        value = nearest + sign * step
        at_bound = sign * (value - bound) >= 0.0
        value = bound if at_bound else value
        if value == nearest:
            return found, least, converged
        begin = np.clip(near + slope * (value - nearest), problem.variables.lower, problem.variables.upper)
        minimum = search(
            problem, begin, evaluations=_EVALUATIONS, held={variable: value}, tolerance=_TOLERANCE
        )
        reached = float(np.sqrt(max(minimum.cost - cost, 0.0)))
        growth = (reached - distance) / quantile
        if growth > _LARGEST_GROWTH:
            step = _SHORTER * abs(value - nearest)
            continue
        slope = (minimum.x - near) / (value - nearest)
        near, nearest, distance = minimum.x, value, reached
        least, converged = min(least, minimum.cost), converged and minimum.converged
        found.append((value, sign * reached))
        if at_bound or reached > quantile:
            return found, least, converged
        step *= float(np.clip(_GROWTH / max(growth, 1e-3), 0.5, 2.0))
    return found, least, False


def _end(points: list[tuple[float, float]], wanted: float) -> float:
    """Value at which the distance passes the target, by linear interpolation."""
    sign = float(np.sign(wanted))
    for (value, distance), (next_value, next_distance) in pairwise(points):
        if abs(next_distance) >= abs(wanted):
            part = (abs(wanted) - abs(distance)) / (abs(next_distance) - abs(distance))
            return value + part * (next_value - value)
    return sign * float("inf")
