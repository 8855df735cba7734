"""The forward model: predictions for all records at a point x, and their derivatives."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.predictor import Prediction, Predictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.support import FloatArray

#: Ratio of the outer to the inner step of a one-sided difference at a bound.
RATIO: Final = 10.0**0.5


class ForwardModel:
    """Predictions of all records as functions of x, in the units of the data.

    Immutable except for a cache of the last prediction of each record.

    Attributes:
        variables: meaning of x
        predictors: one for each record
        exact: for each variable, whether derivatives are exact; the others are differences
        tolerance: tolerance of the FMU's integrator
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
        """Number of FMU runs so far."""
        return sum(predictor.runs for predictor in self.predictors)

    def at(self, x: FloatArray, record: int) -> Prediction:
        """Prediction of one record at x; the last one is cached for the Jacobian at the same point."""
        last, prediction = self._last[record]
        if last is None or not np.array_equal(last, x):
            prediction = self._predict([x], record)
            self._last[record] = (x.copy(), prediction)
        assert prediction is not None
        return prediction

    def predictions(self, x: FloatArray) -> list[FloatArray]:
        """Predictions at x by record; raises FitError if a run fails."""
        found = []
        for k, predictor in enumerate(self.predictors):
            prediction = self.at(x, k)
            if prediction.message:
                raise FitError(predictor.record.name, f"the run fails: {prediction.message}")
            found.append(prediction.values[0])
        return found

    def moved(self, x: FloatArray, variable: int, moves: Sequence[float], record: int) -> FloatArray:
        """Predictions of one record with one variable changed by each of some amounts, and at x itself.

        Args:
            x: the point
            variable: index of the variable to change
            moves: absolute changes, length k
            record: index of the record

        Returns:
            shape (k + 1, n), with x itself last
        """
        return self._predict([_moved(x, variable, move) for move in (*moves, 0.0)], record).values

    def jacobian(self, x: FloatArray, record: int, steps: FloatArray, *, central: bool = True) -> FloatArray:
        """Derivatives of the prediction of one record, shape (n, variables).

        Derivatives with respect to the instrument are exact, and, if the FMU has sensitivities, so are those
        with respect to its parameters. The others are slopes at x of the polynomial through the predictions
        at x and at those points of `_moves` that are within the bounds and whose run succeeds.

        Args:
            x: the point
            record: index of the record
            steps: difference steps, relative to the scale of each variable, shape (variables,)
            central: use two points, for an error of second order in the steps; otherwise one point, for an
                error of first order with half the runs, and sensitivities at a larger tolerance
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
        """Derivatives of the predictions with respect to the instrument's numbers, by record."""
        return [self.at(x, k).slopes for k in range(len(self.predictors))]

    def _predict(self, points: Sequence[FloatArray], record: int) -> Prediction:
        """Predictions at points that share their instrument."""
        rows = np.array([self.variables.row(point, record) for point in points])
        return self.predictors[record].predict(rows, self.variables.instrument(points[0], record))

    def _exact_columns(self, x: FloatArray, record: int, *, rough: bool) -> dict[int, FloatArray]:
        """Derivatives of one record's prediction that need no differences, by index of the variable."""
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
        """Whether every FMU has the derivative and no tie uses the variable (ties have none)."""
        return name not in self.variables.in_ties and all(
            name in one.differentiable for one in self.predictors
        )

    def _moves(self, x: FloatArray, variable: int, steps: FloatArray, *, central: bool) -> tuple[float, ...]:
        """Changes of a variable for its derivative, within its bounds."""
        one = self.variables.free[variable]
        below, above = x[variable] - one.lowest, one.highest - x[variable]
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
    """Slope at 0 of the polynomial through (place, values) pairs; the first place is 0."""
    (_, base), *others = points
    if not others:
        return np.zeros_like(base)
    places = np.array([place for place, _ in others])
    size = float(np.max(np.abs(places)))
    # Subtract the base, so that a variable without influence has a slope of exactly 0.
    weights = np.linalg.inv(np.vander(places / size, len(places) + 1, increasing=True)[:, 1:])[0] / size
    return np.asarray(weights @ np.array([values - base for _, values in others]))
