"""The least-squares problem: weighted residuals, their derivatives, and the steps of the differences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.prediction import Prediction, Predictor
from pyjoystick.identification.fitting.variables import Variables
from pyjoystick.support import FloatArray

#: A point at which the FMU fails counts as differing by this many times the data, and no search ends there.
_FAILED = 1e3


class Problem:
    """Residuals r(x) = weight*(prediction - data), one block after the other for the records.

    Attributes:
        variables: what x means
        predictors: one for each record
        weights: of each residual by record; the reciprocal of the noise's standard deviation where known
        steps: relative step of the central differences by variable, shape (variables,)
    """

    def __init__(
        self, variables: Variables, predictors: Sequence[Predictor], weights: Sequence[FloatArray]
    ) -> None:
        self.variables = variables
        self.predictors = tuple(predictors)
        self.weights = list(weights)
        self.data = [predictor.data for predictor in self.predictors]
        self.steps: FloatArray = np.full(len(variables.free), 1e-4)
        self.evaluations = 0
        self._last: list[tuple[FloatArray | None, Prediction | None]] = [(None, None)] * len(self.predictors)

    @property
    def runs(self) -> int:
        """FMU runs so far."""
        return sum(predictor.runs for predictor in self.predictors)

    @property
    def size(self) -> int:
        """Number of residuals that count."""
        return sum(int(np.count_nonzero(weight)) for weight in self.weights)

    def residuals_by_record(self, x: FloatArray) -> list[FloatArray]:
        """Weighted residuals, one array a record.

        A failing run gives residuals of a thousand times the data, so that a search turns back.
        """
        self.evaluations += 1
        found = []
        for k, data in enumerate(self.data):
            residuals = self.weights[k] * (self._base(x, k).values[0] - data)
            failed = self.weights[k] * _FAILED * float(np.max(np.abs(data)))
            found.append(np.where(np.isfinite(residuals), residuals, failed))
        return found

    def residuals(self, x: FloatArray) -> FloatArray:
        """All weighted residuals, shape (samples of all records,)."""
        return np.concatenate(self.residuals_by_record(x))

    def predictions(self, x: FloatArray) -> list[FloatArray]:
        """What is predicted, in the units of the data, by record; raises FitError where a run fails."""
        found = []
        for k, predictor in enumerate(self.predictors):
            prediction = self._base(x, k)
            if prediction.message:
                raise FitError(predictor.record.name, f"the run fails: {prediction.message}")
            found.append(prediction.values[0])
        return found

    def jacobian(self, x: FloatArray, *, central: bool = True) -> FloatArray:
        """Derivatives of all residuals, shape (samples of all records, variables).

        Differences are one-sided at a bound, beside a run that fails, and where they need not be central; the
        release time is exact.

        Args:
            x: the point
            central: central differences; without, half the runs for an error of the first order in the steps
        """
        blocks = [
            self._jacobian_of(x, k, central=central) * self.weights[k][:, np.newaxis]
            for k in range(len(self.predictors))
        ]
        return np.concatenate(blocks)

    def differences(self, x: FloatArray, variable: int, steps: FloatArray, record: int) -> FloatArray:
        """Predictions of one record at x -+ steps and at x.

        Args:
            x: the point
            variable: which variable is changed
            steps: absolute changes, shape (k,)
            record: which record

        Returns:
            shape (2k + 1, n): for each step minus then plus, and x itself at the end
        """
        points = [self._moved(x, variable, sign * step) for step in steps for sign in (-1.0, 1.0)]
        return self._predict([*points, x], record).values

    def count_records(self, counts: Sequence[float], weights: Sequence[FloatArray]) -> None:
        """Have each record count as often as `counts` says, 0 included."""
        self.weights = [np.sqrt(count) * weight for count, weight in zip(counts, weights, strict=True)]

    def _predict(self, points: Sequence[FloatArray], record: int) -> Prediction:
        """The prediction at points that share their release time."""
        rows = np.array([self.variables.row(point, record) for point in points])
        return self.predictors[record].predict(rows, self.variables.release_time(points[0], record))

    def _base(self, x: FloatArray, record: int) -> Prediction:
        """The prediction at x, kept: a Jacobian is asked for where the residuals have just been."""
        last, prediction = self._last[record]
        if last is None or not np.array_equal(last, x):
            prediction = self._predict([x], record)
            self._last[record] = (x.copy(), prediction)
        assert prediction is not None
        return prediction

    def _jacobian_of(self, x: FloatArray, record: int, *, central: bool) -> FloatArray:
        """The block of one record, without its weights, all its runs in one batch."""
        base = self._base(x, record)
        time_place = self.variables.release_variable(record)
        block = np.zeros((len(base.time_slope), len(x)))
        if time_place is not None:
            block[:, time_place] = base.time_slope
        concerned = [j for j in range(len(x)) if self.variables.concerns(j, record) and j != time_place]
        moves = [(j, move) for j in concerned for move in self._moves(x, j, central=central)]
        if moves:
            points = [self._moved(x, j, move) for j, move in moves]
            values = self._predict(points, record).values
            for j in concerned:
                ends = [(points[i][j], values[i]) for i, (k, _) in enumerate(moves) if k == j]
                ends = [end for end in ends if np.all(np.isfinite(end[1])) and end[0] != x[j]]
                if len(ends) == 1:
                    ends.append((x[j], base.values[0]))
                if len(ends) == 2:
                    block[:, j] = (ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0])
        return np.where(np.isfinite(block), block, 0.0)

    def _moves(self, x: FloatArray, variable: int, *, central: bool) -> tuple[float, ...]:
        """By how much a variable is changed for its derivative."""
        one = self.variables.free[variable]
        step = float(self.steps[variable]) * one.scale
        if central:
            return -step, step
        return (step,) if x[variable] + step <= one.maximum else (-step,)

    def _moved(self, x: FloatArray, variable: int, step: float) -> FloatArray:
        """X with one variable changed, but not beyond its bounds."""
        moved = x.copy()
        one = self.variables.free[variable]
        moved[variable] = min(max(x[variable] + step, one.minimum), one.maximum)
        return moved


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
    """Measure the best steps at x, on one record for each kind of variable; the problem keeps its own.

    The results of an adaptive integrator with events scatter at the level of its tolerance: too small a step
    differentiates that scatter, too large a one the curvature. So the derivative is taken at a ladder of
    steps; where it changes least from one step to the next, both errors together are smallest, and the change
    estimates them.
    """
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
