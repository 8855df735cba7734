"""The forward model: what is predicted for all records at a point x, and its derivatives."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.predictor import Prediction, Predictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.support import FloatArray

#: The outer by the inner step of a difference where both are on one side, at a bound.
RATIO: Final = 10.0**0.5


class ForwardModel:
    """Predictions of all records as functions of x, in the units of the data.

    It never changes, but for the last prediction of each record, which it keeps.

    Attributes:
        variables: what x means
        predictors: one for each record
        exact: whether the derivatives by a variable are exact, by variable; the others are differences
        tolerance: of the FMU's integrator
    """

    def __init__(
        self, variables: Variables, predictors: Sequence[Predictor], tolerance: float = math.nan
    ) -> None:
        self.variables = variables
        self.predictors = tuple(predictors)
        self.exact = tuple(one.of_instrument or self._is_differentiable(one.name) for one in variables.free)
        self.tolerance = tolerance
        self._last: list[tuple[FloatArray | None, Prediction | None]] = [(None, None)] * len(self.predictors)

    @property
    def runs(self) -> int:
        """FMU runs so far."""
        return sum(predictor.runs for predictor in self.predictors)

    def at(self, x: FloatArray, record: int) -> Prediction:
        """The prediction of one record at x; the last one is kept, for the Jacobian at the same point."""
        last, prediction = self._last[record]
        if last is None or not np.array_equal(last, x):
            prediction = self._predict([x], record)
            self._last[record] = (x.copy(), prediction)
        assert prediction is not None
        return prediction

    def predictions(self, x: FloatArray) -> list[FloatArray]:
        """The predictions at x by record; raises FitError where a run fails."""
        found = []
        for k, predictor in enumerate(self.predictors):
            prediction = self.at(x, k)
            if prediction.message:
                raise FitError(predictor.record.name, f"the run fails: {prediction.message}")
            found.append(prediction.values[0])
        return found

    def moved(self, x: FloatArray, variable: int, moves: Sequence[float], record: int) -> FloatArray:
        """Predictions of one record with one variable changed by each move, and at x itself.

        Args:
            x: the point
            variable: which variable is changed
            moves: absolute changes, length k
            record: which record

        Returns:
            shape (k + 1, n), x itself at the end
        """
        return self._predict([_moved(x, variable, move) for move in (*moves, 0.0)], record).values

    def jacobian(self, x: FloatArray, record: int, steps: FloatArray, *, central: bool = True) -> FloatArray:
        """Derivatives of the prediction of one record, shape (n, variables).

        Those of the instrument are exact, and where the FMU has sensitivities those of its parameters. Each
        other one is the slope, at x, of the polynomial through the predictions at x and at the points of
        `_moves` that are within the bounds and whose run does not fail.

        Args:
            x: the point
            record: which record
            steps: of the differences, relative to the scale of each variable, shape (variables,)
            central: two points, for an error of the second order in the steps; without, one point, for an
                error of the first order at half the runs, and sensitivities at a larger tolerance
        """
        base = self.at(x, record)
        block = np.zeros((base.values.shape[1], len(x)))
        known = self._exact_columns(x, record, rough=not central)
        for place, column in known.items():
            block[:, place] = column
        concerned = [j for j in range(len(x)) if self.variables.concerns(j, record) and j not in known]
        moves = [(j, move) for j in concerned for move in self._moves(x, j, steps, central=central)]
        if moves:
            values = self._predict([_moved(x, j, move) for j, move in moves], record).values
            for j in concerned:
                own = [
                    (move, value)
                    for (k, move), value in zip(moves, values, strict=True)
                    if k == j and np.all(np.isfinite(value))
                ]
                block[:, j] = slope([(0.0, base.values[0]), *own])
        return np.where(np.isfinite(block), block, 0.0)

    def instrument_slopes(self, x: FloatArray) -> list[Mapping[str, FloatArray]]:
        """Derivatives of the predictions with respect to the numbers of the instrument, by record."""
        return [self.at(x, k).slopes for k in range(len(self.predictors))]

    def _predict(self, points: Sequence[FloatArray], record: int) -> Prediction:
        """The prediction at points that share their instrument."""
        rows = np.array([self.variables.row(point, record) for point in points])
        return self.predictors[record].predict(rows, self.variables.instrument(points[0], record))

    def _exact_columns(self, x: FloatArray, record: int, *, rough: bool) -> dict[int, FloatArray]:
        """The derivatives of one record's prediction that need no differences, by place of the variable."""
        slopes = self.at(x, record).slopes
        found = {j: slopes[name] for name, j in self.variables.instrument_places(record).items()}
        if any(self.exact[j] and j not in found for j in range(len(x)) if self.variables.concerns(j, record)):
            row, instrument = self.variables.row(x, record), self.variables.instrument(x, record)
            for name, column in self.predictors[record].derivatives(row, instrument, rough=rough).items():
                j = self.variables.place(name, record)
                if j is not None and self.exact[j]:
                    found[j] = column
        return found

    def _is_differentiable(self, name: str) -> bool:
        """Whether every FMU has the derivatives; of what ties use, they would have to follow the ties."""
        return name not in self.variables.in_ties and all(
            name in one.differentiable for one in self.predictors
        )

    def _moves(self, x: FloatArray, variable: int, steps: FloatArray, *, central: bool) -> tuple[float, ...]:
        """By how much a variable is changed for its derivative: within its bounds."""
        one = self.variables.free[variable]
        below, above = x[variable] - one.minimum, one.maximum - x[variable]
        step = min(float(steps[variable]) * one.scale, max(below, above) / RATIO)
        inward = step if step <= above else -step
        if not central:
            return (inward,)
        return (-step, step) if step <= min(below, above) else (inward, RATIO * inward)


def _moved(x: FloatArray, variable: int, move: float) -> FloatArray:
    moved = x.copy()
    moved[variable] += move
    return moved


def slope(points: Sequence[tuple[float, FloatArray]]) -> FloatArray:
    """The slope at the first place, 0, of the polynomial through values at places, (place, values) each."""
    (_, base), *others = points
    if not others:
        return np.zeros_like(base)
    places = np.array([place for place, _ in others])
    size = float(np.max(np.abs(places)))
    # Of differences from the base, so that what changes nothing has a slope of exactly 0.
    weights = np.linalg.inv(np.vander(places / size, len(places) + 1, increasing=True)[:, 1:])[0] / size
    return np.asarray(weights @ np.array([values - base for _, values in others]))
