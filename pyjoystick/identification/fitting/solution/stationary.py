"""Refinement of the minimum to rounding errors: the point where the gradient vanishes.

A search ends when the sum of squares no longer falls. Near the minimum its changes drown in rounding errors,
which leaves variables uncertain by a thousandth of a standard error along a flat, curved valley. The gradient
is more sensitive.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Final

import numpy as np
from scipy.optimize import root

from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.solution.search import Minimum
from pyjoystick.support import FloatArray

#: A gradient below this counts as zero, with variables in units of standard errors.
_ZERO: Final = 1e-8
_MOST_STEPS: Final = 20
#: A point farther away than this, in standard errors, or with a larger sum by this part, is another one.
_FAR: Final = 0.1
_WORSE: Final = 1e-9
#: A variable this close to a bound, relative to its scale, is held there.
_AT_BOUND: Final = 1e-9
#: Combinations that the data determine less than this, with columns of length 1, are left alone.
_UNDETERMINED: Final = 1e-6


def stationary_point(problem: Problem, minimum: Minimum) -> Minimum:
    """Find the point near a minimum where the gradient vanishes, by Broyden's method; else the minimum.

    Requires exact derivatives. Variables at their bounds stay there.

    Args:
        problem: the problem
        minimum: result of a search, within a tenth of a standard error
    """
    start, variables = minimum.x, problem.variables
    # A search that is drawn to a bound stays inside it by rounding errors.
    margin = _AT_BOUND * np.array([one.scale for one in variables.free])
    free = (start > variables.lower + margin) & (start < variables.upper - margin)
    jacobian, residuals = problem.jacobian(start)[:, free], problem.residuals(start)
    variance = float(residuals @ residuals) / len(residuals)
    lengths = np.linalg.norm(jacobian, axis=0)
    if variance == 0.0 or not lengths.size or not np.all(lengths > 0.0):
        return minimum
    _, values, rows = np.linalg.svd(jacobian / lengths, full_matrices=False)
    if values[-1] < _UNDETERMINED:
        return minimum
    # With columns one standard error long, the Hessian is the identity except for curvature.
    directions = math.sqrt(variance) * (rows / values[:, None]).T / lengths[:, None]

    def at(move: FloatArray) -> FloatArray:
        point = start.copy()
        point[free] += directions @ move
        return np.clip(point, variables.lower, variables.upper)

    def gradient(move: FloatArray) -> FloatArray:
        if not float(np.max(np.abs(move))) < _FAR:
            raise _LostError
        point = at(move)
        slopes = problem.jacobian(point)[:, free] @ directions
        return np.asarray(slopes.T @ problem.residuals(point) / variance)

    # `alpha` starts as minus the reciprocal of the Hessian.
    options: Any = {
        "fatol": _ZERO,
        "maxiter": _MOST_STEPS,
        "line_search": None,
        "jac_options": {"alpha": -1.0},
    }
    try:
        # Steps of the size of rounding errors lead nowhere and give NaN.
        with np.errstate(divide="ignore", invalid="ignore"):
            found = root(gradient, np.zeros(len(values)), method="broyden2", options=options)
    except _LostError:
        return minimum
    point = at(found.x)
    cost = float(np.sum(problem.residuals(point) ** 2))
    is_it = bool(found.success) and cost <= (1.0 + _WORSE) * minimum.cost
    return replace(minimum, x=point, cost=cost) if is_it else minimum


class _LostError(Exception):
    """The iteration has left the neighborhood of the minimum."""
