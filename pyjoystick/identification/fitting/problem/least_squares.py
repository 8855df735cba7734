"""The least-squares problem: weighted residuals, their derivatives, and the steps of the differences."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.noise_color import Memory
from pyjoystick.identification.fitting.problem.prediction import Prediction, Predictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.support import FloatArray

#: A point at which the FMU fails counts as differing by this many times the data, and no search ends there.
_FAILED = 1e3


class Problem:
    """Residuals r(x) = weight*share*(prediction - data), one block after the other for the records.

    Where the noise has a memory, a residual is what is new in it. What is known of variables beforehand
    follows at the end: (x - measured)/uncertainty.

    Attributes:
        variables: what x means
        predictors: one for each record
        weights: of each residual by record; the reciprocal of the noise's standard deviation where known
        shares: how much each residual counts, by record: 1, and less for outliers
        memories: of the noise, by record
        correlation: of the noise from sample to sample
        steps: relative step of the differences by variable, shape (variables,)
        exact: whether the derivatives by a variable are exact, by variable; the others are differences
        tolerance: of the FMU's integrator
    """

    def __init__(
        self,
        variables: Variables,
        predictors: Sequence[Predictor],
        weights: Sequence[FloatArray],
        tolerance: float = math.nan,
    ) -> None:
        self.variables = variables
        self.predictors = tuple(predictors)
        self.weights = list(weights)
        self.shares: list[FloatArray] = [np.ones(len(weight)) for weight in weights]
        self.correlation = 0.0
        self.memories = [Memory(np.zeros(len(weight))) for weight in weights]
        self.data = [predictor.data for predictor in self.predictors]
        #: What was measured beforehand, by variable; only those with an uncertainty count.
        self.measured: FloatArray = np.array(variables.start)
        self.steps: FloatArray = np.full(len(variables.free), 1e-4)
        self.exact = [one.of_instrument or self._is_differentiable(one.name) for one in variables.free]
        self.tolerance = tolerance
        self.evaluations = 0
        self._known = [j for j, one in enumerate(variables.free) if one.uncertainty is not None]
        self._last: list[tuple[FloatArray | None, Prediction | None]] = [(None, None)] * len(self.predictors)

    @property
    def runs(self) -> int:
        """FMU runs so far."""
        return sum(predictor.runs for predictor in self.predictors)

    @property
    def size(self) -> int:
        """Number of residuals that count."""
        return sum(
            int(np.count_nonzero(weight * share))
            for weight, share in zip(self.weights, self.shares, strict=True)
        )

    @property
    def terms(self) -> int:
        """Number of residuals that count, with those of what is known beforehand."""
        return self.size + len(self._known)

    def residuals_by_record(self, x: FloatArray) -> list[FloatArray]:
        """Weighted residuals, one array a record.

        A failing run gives residuals of a thousand times the data, so that a search turns back.
        """
        self.evaluations += 1
        found = []
        for k, data in enumerate(self.data):
            residuals = self._base(x, k).values[0] - data
            failed = _FAILED * float(np.max(np.abs(data)))
            found.append(self.counted(np.where(np.isfinite(residuals), residuals, failed), k))
        return found

    def counted(self, values: FloatArray, record: int) -> FloatArray:
        """Values in the unit of the data as they count in the sum of squares.

        Args:
            values: of one record, shape (n,) or (n, columns)
            record: which one
        """
        weights = self.weights[record] * self.shares[record]
        return self.memories[record].innovations(values * weights.reshape(-1, *(1,) * (values.ndim - 1)))

    def residuals(self, x: FloatArray) -> FloatArray:
        """All weighted residuals, shape (samples of all records + variables known beforehand,)."""
        known = self.prior @ (x - self.measured)
        return np.concatenate((*self.residuals_by_record(x), known))

    @property
    def prior(self) -> FloatArray:
        """Derivatives of the residuals of what is known beforehand, shape (known, variables)."""
        free = self.variables.free
        rows = np.zeros((len(self._known), len(free)))
        for row, j in zip(rows, self._known, strict=True):
            row[j] = 1.0 / (free[j].uncertainty or math.inf)
        return rows

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
        """Derivatives of all residuals, shape (samples of all records + what is known beforehand, variables).

        Those of the instrument are exact, and where the FMU has sensitivities those of its parameters. Each
        other one is the slope, at x, of the polynomial through the predictions at x and at the points of
        `_moves` that are within the bounds and whose run does not fail.

        Args:
            x: the point
            central: two points, for an error of the second order in the steps; without, one point, for an
                error of the first order at half the runs, and sensitivities at a larger tolerance
        """
        blocks = self.jacobians(x, central=central)
        return np.concatenate((*(self.counted(block, k) for k, block in enumerate(blocks)), self.prior))

    def jacobians(self, x: FloatArray, *, central: bool = True) -> list[FloatArray]:
        """Derivatives of the predictions in the unit of the data, one array a record."""
        return [self._jacobian_of(x, k, central=central) for k in range(len(self.predictors))]

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

    def instrument_slopes(self, x: FloatArray) -> list[Mapping[str, FloatArray]]:
        """Derivatives of the predictions with respect to the numbers of the instrument, by record."""
        return [self._base(x, k).slopes for k in range(len(self.predictors))]

    def count_records(self, counts: Sequence[float], weights: Sequence[FloatArray]) -> None:
        """Have each record count as often as `counts` says, 0 included."""
        self.weights = [np.sqrt(count) * weight for count, weight in zip(counts, weights, strict=True)]

    def _predict(self, points: Sequence[FloatArray], record: int) -> Prediction:
        """The prediction at points that share their instrument."""
        rows = np.array([self.variables.row(point, record) for point in points])
        return self.predictors[record].predict(rows, self.variables.instrument(points[0], record))

    def _base(self, x: FloatArray, record: int) -> Prediction:
        """The prediction at x, kept: a Jacobian is asked for where the residuals have just been."""
        last, prediction = self._last[record]
        if last is None or not np.array_equal(last, x):
            prediction = self._predict([x], record)
            self._last[record] = (x.copy(), prediction)
        assert prediction is not None
        return prediction

    def _jacobian_of(self, x: FloatArray, record: int, *, central: bool) -> FloatArray:
        """The block of one record, all its runs in one batch."""
        base = self._base(x, record)
        block = np.zeros((base.values.shape[1], len(x)))
        known = self._exact_columns(x, record, rough=not central)
        for place, slope in known.items():
            block[:, place] = slope
        concerned = [j for j in range(len(x)) if self.variables.concerns(j, record) and j not in known]
        moves = [(j, move) for j in concerned for move in self._moves(x, j, central=central)]
        if moves:
            values = self._predict([_moved(x, j, move) for j, move in moves], record).values
            for j in concerned:
                own = [
                    (move, value)
                    for (k, move), value in zip(moves, values, strict=True)
                    if k == j and np.all(np.isfinite(value))
                ]
                block[:, j] = _slope([(0.0, base.values[0]), *own])
        return np.where(np.isfinite(block), block, 0.0)

    def _exact_columns(self, x: FloatArray, record: int, *, rough: bool) -> dict[int, FloatArray]:
        """The derivatives of one record's prediction that need no differences, by place of the variable."""
        slopes = self._base(x, record).slopes
        found = {j: slopes[name] for name, j in self.variables.instrument_places(record).items()}
        if any(self.exact[j] and j not in found for j in range(len(x)) if self.variables.concerns(j, record)):
            row, instrument = self.variables.row(x, record), self.variables.instrument(x, record)
            for name, slope in self.predictors[record].derivatives(row, instrument, rough=rough).items():
                j = self.variables.place(name, record)
                if j is not None and self.exact[j]:
                    found[j] = slope
        return found

    def _is_differentiable(self, name: str) -> bool:
        """Whether every FMU has the derivatives; of what ties use, they would have to follow the ties."""
        return name not in self.variables.in_ties and all(
            name in one.differentiable for one in self.predictors
        )

    def _moves(self, x: FloatArray, variable: int, *, central: bool) -> tuple[float, ...]:
        """By how much a variable is changed for its derivative: within its bounds."""
        one = self.variables.free[variable]
        below, above = x[variable] - one.minimum, one.maximum - x[variable]
        step = min(float(self.steps[variable]) * one.scale, max(below, above) / RATIO)
        inward = step if step <= above else -step
        if not central:
            return (inward,)
        return (-step, step) if step <= min(below, above) else (inward, RATIO * inward)


def _moved(x: FloatArray, variable: int, move: float) -> FloatArray:
    moved = x.copy()
    moved[variable] += move
    return moved


def _slope(points: Sequence[tuple[float, FloatArray]]) -> FloatArray:
    """The slope at the first place, 0, of the polynomial through values at places, (place, values) each."""
    (_, base), *others = points
    if not others:
        return np.zeros_like(base)
    places = np.array([place for place, _ in others])
    size = float(np.max(np.abs(places)))
    # Of differences from the base, so that what changes nothing has a slope of exactly 0.
    weights = np.linalg.inv(np.vander(places / size, len(places) + 1, increasing=True)[:, 1:])[0] / size
    return np.asarray(weights @ np.array([values - base for _, values in others]))


#: The outer by the inner step where both are on one side, at a bound; on the ladder, a step by the last one.
RATIO: Final = 10.0**0.5
#: Steps that are tried, relative to the scale of a variable.
LADDER: FloatArray = 10.0**-6.5 * RATIO ** np.arange(10)


@dataclass(frozen=True, slots=True)
class StepChoice:
    """Steps of differences.

    Attributes:
        steps: relative to the scale of each variable, shape (variables,)
        errors: estimated relative error of each column of the Jacobian, shape (variables,)
        noise: scatter of the predicted values at the smallest step, in the unit of the data
        tolerance: of the FMU's integrator, at which they hold
    """

    steps: FloatArray
    errors: FloatArray
    noise: float
    tolerance: float

    def least(self, tolerance: float) -> float:
        """Residuals up to this size are the error of the integration and no noise."""
        return max(100.0 * self.noise, tolerance)


def choose_steps(problem: Problem, x: FloatArray, *, central: bool = True) -> StepChoice:
    """Measure the best steps at x, on one record for each kind of variable; the problem keeps its own.

    The results of an adaptive integrator with events scatter at the level of its tolerance: too small a step
    differentiates that scatter, too large a one the curvature. So the derivative is taken at a ladder of
    steps; where it changes least from one step to the next, both errors together are smallest, and the change
    estimates them.

    Args:
        problem: the problem
        x: the point
        central: for central differences; without, for one-sided ones, whose best step is smaller
    """
    variables = problem.variables
    count = len(variables.free)
    steps, errors = problem.steps.copy(), np.zeros(count)
    noise = 0.0
    measured: dict[str, tuple[float, float]] = {}
    for j, variable in enumerate(variables.free):
        record = variable.record or 0
        if problem.exact[j]:
            continue
        if variable.name not in measured:
            step, error, scatter = _of_variable(problem, x, j, record, central=central)
            measured[variable.name] = (step, error)
            noise = max(noise, scatter)
        steps[j], errors[j] = measured[variable.name]
    return StepChoice(steps, errors, noise, problem.tolerance)


def _of_variable(
    problem: Problem, x: FloatArray, variable: int, record: int, *, central: bool
) -> tuple[float, float, float]:
    """Best step, the relative error of the derivative there, and the scatter of the values."""
    one = problem.variables.free[variable]
    below, above = x[variable] - one.minimum, one.maximum - x[variable]
    ladder = [float(step) * one.scale for step in LADDER]
    moves = [move for step in ladder for move in (-step, step) if -below <= move <= above]
    values = problem.moved(x, variable, moves, record)
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
        slopes.append(_slope([(0.0, found[0.0]), *own]) if own else np.full_like(values[0], np.nan))
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
