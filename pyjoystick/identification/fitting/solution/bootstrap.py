"""Bootstrap: the fit repeated on resampled data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.settings import Resampling
from pyjoystick.identification.fitting.solution.search import search
from pyjoystick.support import FloatArray

_EVALUATIONS = 60


@dataclass(frozen=True, slots=True, eq=False)
class Bootstrap:
    """Fits of resampled data.

    Attributes:
        resampling: what was resampled
        fits: variables of each fit that converged, shape (fits, variables); NaN for those of a record
            that was not drawn
        failed: number of fits that did not converge
    """

    resampling: Resampling
    fits: FloatArray
    failed: int

    def errors(self) -> FloatArray:
        """Standard deviation of each variable over the fits, shape (variables,); NaN with fewer than two."""
        return np.array(
            [np.std(found, ddof=1) if len(found) > 1 else np.nan for found in self._by_variable()]
        )

    def intervals(self, level: float) -> FloatArray:
        """Percentile intervals, shape (variables, 2); NaN with fewer than two fits."""
        tail = 0.5 * (1.0 - level)
        nothing = np.full(2, np.nan)
        return np.array(
            [
                np.quantile(found, [tail, 1.0 - tail]) if len(found) > 1 else nothing
                for found in self._by_variable()
            ]
        )

    def _by_variable(self) -> list[FloatArray]:
        return [column[np.isfinite(column)] for column in self.fits.T]


def bootstrap(
    problem: Problem,
    x: FloatArray,
    count: int,
    resampling: Resampling,
    seed: int,
    on_fit: Callable[[int, int], None] | None = None,
) -> Bootstrap:
    """Repeat the fit `count` times from x.

    Records are resampled whole, with replacement: this shows how the answer depends on which repeats were
    measured and relies on no noise model, but few records allow few draws (four: 35). Residuals are resampled
    within each series of a record, in standard deviations of its noise, and added to the prediction: this
    relies on the noise model. Prior measurements are resampled in both cases.
    """
    random = np.random.default_rng(seed)
    errors = np.array([one.uncertainty or 0.0 for one in problem.variables.free])
    predicted = problem.predictions(x)
    records = len(problem.data)
    owners = [one.record for one in problem.variables.free]
    fits, failed = [], 0
    for number in range(count):
        drawn = replace(problem, measured=x + errors * random.standard_normal(len(x)))
        # Nothing determines the release of a record that was not drawn.
        idle: list[int] = []
        if resampling == "records":
            counts = np.bincount(random.integers(records, size=records), minlength=records)
            weights = zip(counts.tolist(), problem.noise.weights, strict=True)
            drawn = drawn.with_weights(tuple(np.sqrt(count) * weight for count, weight in weights))
            idle = [j for j, owner in enumerate(owners) if owner is not None and not counts[owner]]
        else:
            drawn = replace(
                drawn, data=tuple(_drawn_anew(random, problem, k, one) for k, one in enumerate(predicted))
            )
        minimum = search(drawn, x, evaluations=_EVALUATIONS, held={j: float(x[j]) for j in idle})
        if minimum.converged:
            minimum.x[idle] = np.nan
            fits.append(minimum.x)
        else:
            failed += 1
        if on_fit is not None:
            on_fit(number + 1, count)
    return Bootstrap(resampling, np.array(fits).reshape(len(fits), len(x)), failed)


def _drawn_anew(
    random: np.random.Generator, problem: Problem, record: int, predicted: FloatArray
) -> FloatArray:
    """Data of a record with noise resampled from the innovations of its residuals, without outliers."""
    noise = replace(problem.noise, shares=tuple(np.ones_like(one) for one in problem.noise.shares))
    innovations = noise.counted(problem.data[record] - predicted, record)
    full = problem.noise.shares[record] == 1.0
    labels = np.array(problem.predictors[record].labels)
    drawn = np.empty_like(innovations)
    for label in dict.fromkeys(problem.predictors[record].labels):
        own = innovations[full & (labels == label)]
        drawn[labels == label] = random.choice(own - np.mean(own), size=np.count_nonzero(labels == label))
    return np.asarray(predicted + noise.drawn(drawn, record))
