"""Choice of finite-difference steps by trial at the point of interest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.forward_model import RATIO, ForwardModel, slope
from pyjoystick.support import FloatArray

#: Initial steps, relative to the scale of a variable.
FIRST_STEP: Final = 1e-4
#: Steps to try, relative to the scale of a variable; each is `RATIO` times the one before.
LADDER: FloatArray = 10.0**-6.5 * RATIO ** np.arange(10)


@dataclass(frozen=True, slots=True, eq=False)
class StepChoice:
    """Chosen difference steps and their errors.

    Attributes:
        steps: relative to the scale of each variable, shape (variables,)
        errors: estimated relative error of each column of the Jacobian, shape (variables,)
        noise: scatter of the predicted values at the smallest step, in the unit of the data
        tolerance: tolerance of the FMU's integrator for which the steps are valid
    """

    steps: FloatArray
    errors: FloatArray
    noise: float
    tolerance: float

    def least(self, tolerance: float) -> float:
        """Residuals up to this size are integration errors, not noise."""
        return max(100.0 * self.noise, tolerance)


def choose_steps(model: ForwardModel, x: FloatArray, *, central: bool = True) -> StepChoice:
    """Find the best steps at x, on one record for each kind of variable.

    Results of an adaptive integrator with events scatter at the level of its tolerance: too small a step
    differentiates this scatter, too large a one suffers from curvature. The derivative is therefore computed
    for a ladder of steps. Where it changes least from one step to the next, the total error is smallest, and
    the change is an estimate of it.

    Args:
        model: model whose predictions are differentiated
        x: the point
        central: choose steps for central differences; otherwise for one-sided ones, whose best step is
            smaller
    """
    variables = model.variables
    count = len(variables.free)
    steps, errors = np.full(count, FIRST_STEP), np.zeros(count)
    noise = 0.0
    measured: dict[str, tuple[float, float]] = {}
    for j, variable in enumerate(variables.free):
        record = variable.record or 0
        if model.exact[j]:
            continue
        if variable.name not in measured:
            step, error, scatter = _of_variable(model, x, j, record, central=central)
            measured[variable.name] = (step, error)
            noise = max(noise, scatter)
        steps[j], errors[j] = measured[variable.name]
    return StepChoice(steps, errors, noise, model.tolerance)


def _of_variable(
    model: ForwardModel, x: FloatArray, variable: int, record: int, *, central: bool
) -> tuple[float, float, float]:
    """Best step, relative error of the derivative at that step, and scatter of the values."""
    one = model.variables.free[variable]
    below, above = x[variable] - one.lowest, one.highest - x[variable]
    ladder = [float(step) * one.scale for step in LADDER]
    moves = [move for step in ladder for move in (-step, step) if -below <= move <= above]
    values = model.moved(x, variable, moves, record)
    found = dict(zip((*moves, 0.0), values, strict=True))
    slopes = []
    for step, further in zip(ladder, (*ladder[1:], np.inf), strict=True):
        sign = 1.0 if step in found else -1.0
        inward = sign * step
        both = (-step, step) if {-step, step} <= found.keys() else (inward, sign * further)
        own = [
            (move, found[move])
            for move in (both if central else (inward,))
            if move in found and np.all(np.isfinite(found[move]))
        ]
        slopes.append(slope([(0.0, found[0.0]), *own]) if own else np.full_like(values[0], np.nan))
    changes = np.linalg.norm(np.diff(slopes, axis=0), axis=1)
    changes = np.where(np.isfinite(changes), changes, np.inf)
    best = int(np.argmin(changes))
    if not np.isfinite(changes[best]):
        return float(LADDER[len(LADDER) // 2]), 1e-3, 0.0
    size = float(np.linalg.norm(slopes[best]))
    least = ladder[0]
    scatter = 0.0
    if least in found and -least in found:
        scatter = float(np.sqrt(np.mean((found[least] - 2.0 * found[0.0] + found[-least]) ** 2) / 6.0))
    return float(LADDER[best]), float(changes[best]) / size if size > 0.0 else 0.0, scatter
