"""Steps for differences of an integrator's results, from what its noise is measured to be.

An adaptive integrator with events answers a smooth question with numbers that scatter at the level of its
tolerance: too small a step differentiates that scatter, too large a one the curvature. The derivative is
taken at a ladder of steps; where it changes least from one step to the next, both errors together are
smallest, and the change is what they amount to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyjoystick.identification.fitting.problem import Problem
from pyjoystick.support import FloatArray

#: Steps that are tried, relative to the scale of a variable.
LADDER: FloatArray = np.logspace(-6.5, -2.0, 10)


@dataclass(frozen=True, slots=True)
class StepChoice:
    """Steps of central differences.

    Attributes:
        steps: relative to the scale of each variable, shape (variables,)
        errors: estimated relative error of each column of the Jacobian, shape (variables,)
        noise: scatter of the predicted values at the smallest step, in the unit of the data
    """

    steps: FloatArray
    errors: FloatArray
    noise: float


def choose_steps(problem: Problem, x: FloatArray) -> StepChoice:
    """Measure the steps at x, on one record for each kind of variable; sets nothing."""
    variables = problem.variables
    count = len(variables.free)
    steps, errors = problem.steps.copy(), np.zeros(count)
    noise = 0.0
    measured: dict[str, tuple[float, float]] = {}
    for j, variable in enumerate(variables.free):
        record = variable.record or 0
        if variables.release_variable(record) == j:
            continue
        if variable.name not in measured:
            step, error, scatter = _of_variable(problem, x, j, record)
            measured[variable.name] = (step, error)
            noise = max(noise, scatter)
        steps[j], errors[j] = measured[variable.name]
    return StepChoice(steps, errors, noise)


def _of_variable(problem: Problem, x: FloatArray, variable: int, record: int) -> tuple[float, float, float]:
    """Best step, the relative error of the derivative there, and the scatter of the values."""
    one = problem.variables.free[variable]
    room = min(x[variable] - one.minimum, one.maximum - x[variable]) / one.scale
    ladder = LADDER[room > LADDER]
    if len(ladder) < 2:
        return float(LADDER[len(LADDER) // 2]), 1e-3, 0.0
    absolute = ladder * one.scale
    values = problem.differences(x, variable, absolute, record)
    minus, plus, base = values[0:-1:2], values[1:-1:2], values[-1]
    scatter = float(np.sqrt(np.mean((plus[0] - 2.0 * base + minus[0]) ** 2) / 6.0))
    slopes = (plus - minus) / (2.0 * absolute[:, np.newaxis])
    changes = np.linalg.norm(np.diff(slopes, axis=0), axis=1)
    changes = np.where(np.isfinite(changes), changes, np.inf)
    best = int(np.argmin(changes))
    size = float(np.linalg.norm(slopes[best]))
    if not np.isfinite(changes[best]):
        return float(ladder[0]), 1e-3, 0.0
    return float(ladder[best]), float(changes[best]) / size if size > 0.0 else 0.0, scatter
