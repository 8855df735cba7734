"""The least-squares problem: weighted differences between prediction and record, and their derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyjoystick._types import FloatArray
from pyjoystick.fitting.errors import FitError
from pyjoystick.fitting.prediction import Prediction, Predictor
from pyjoystick.fitting.variables import Variables

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
            values = self._predict(x, k, self.variables.row(x, k)[np.newaxis]).values[0]
            residuals = self.weights[k] * (values - data)
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
            prediction = self._predict(x, k, self.variables.row(x, k)[np.newaxis])
            if prediction.message:
                raise FitError(predictor.record.name, f"the run fails: {prediction.message}")
            found.append(prediction.values[0])
        return found

    def jacobian(self, x: FloatArray) -> FloatArray:
        """Derivatives of all residuals, shape (samples of all records, variables).

        Central differences, one-sided at a bound or beside a run that fails; the release time is exact.
        """
        blocks = [
            self._jacobian_of(x, k) * self.weights[k][:, np.newaxis] for k in range(len(self.predictors))
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
        rows = np.array([self.variables.row(point, record) for point in [*points, x]])
        return self._predict(x, record, rows).values

    def count_records(self, counts: Sequence[float], weights: Sequence[FloatArray]) -> None:
        """Have each record count as often as `counts` says, 0 included."""
        self.weights = [np.sqrt(count) * weight for count, weight in zip(counts, weights, strict=True)]

    def _predict(self, x: FloatArray, record: int, rows: FloatArray) -> Prediction:
        return self.predictors[record].predict(rows, self.variables.release_time(x, record))

    def _jacobian_of(self, x: FloatArray, record: int) -> FloatArray:
        """The block of one record, without its weights, all its runs in one batch."""
        time_place = self.variables.release_variable(record)
        concerned = [j for j in range(len(x)) if self.variables.concerns(j, record) and j != time_place]
        points = [x]
        for j in concerned:
            step = self.steps[j] * self.variables.free[j].scale
            points += [self._moved(x, j, -step), self._moved(x, j, step)]
        rows = np.array([self.variables.row(point, record) for point in points])
        values, slope, _ = self._predict(x, record, rows)
        block = np.zeros((values.shape[1], len(x)))
        for i, j in enumerate(concerned):
            pair = [(points[2 * i + 1][j], values[2 * i + 1]), (points[2 * i + 2][j], values[2 * i + 2])]
            usable = [one for one in pair if np.all(np.isfinite(one[1]))]
            if len(usable) == 1:
                usable.append((float(x[j]), values[0]))
            if len(usable) == 2 and usable[0][0] != usable[1][0]:
                block[:, j] = (usable[1][1] - usable[0][1]) / (usable[1][0] - usable[0][0])
        if time_place is not None:
            block[:, time_place] = slope
        return np.where(np.isfinite(block), block, 0.0)

    def _moved(self, x: FloatArray, variable: int, step: float) -> FloatArray:
        """X with one variable changed, but not beyond its bounds."""
        moved = x.copy()
        one = self.variables.free[variable]
        moved[variable] = min(max(x[variable] + step, one.minimum), one.maximum)
        return moved
