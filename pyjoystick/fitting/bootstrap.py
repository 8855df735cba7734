"""The bootstrap: the fit repeated on data drawn anew from what was measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyjoystick._types import FloatArray
from pyjoystick.fitting.problem import Problem
from pyjoystick.fitting.search import search
from pyjoystick.fitting.settings import Resampling

_EVALUATIONS = 60


@dataclass(frozen=True, slots=True, eq=False)
class Bootstrap:
    """Fits of data drawn anew.

    Attributes:
        resampling: what was drawn
        fits: the variables of each fit that converged, shape (fits, variables)
        failed: number of fits that did not
    """

    resampling: Resampling
    fits: FloatArray
    failed: int

    def errors(self) -> FloatArray:
        """Standard deviation of each variable over the fits, shape (variables,)."""
        return np.asarray(np.std(self.fits, axis=0, ddof=1))

    def intervals(self, level: float) -> FloatArray:
        """Percentiles, shape (variables, 2)."""
        tail = 0.5 * (1.0 - level)
        return np.asarray(np.quantile(self.fits, [tail, 1.0 - tail], axis=0).T)


def bootstrap(
    problem: Problem,
    x: FloatArray,
    count: int,
    resampling: Resampling,
    seed: int,
    on_fit: Callable[[int, int], None] | None = None,
) -> Bootstrap:
    """Repeat the fit `count` times from x.

    Whole records are drawn with replacement: this asks how far the answer depends on which repeats were
    measured, and trusts no noise model; few records allow few draws (four: 35). Residuals are drawn within
    each record and added to the prediction: this trusts that they are white.
    """
    random = np.random.default_rng(seed)
    weights, data = problem.weights, problem.data
    predicted = problem.predictions(x)
    fits, failed = [], 0
    try:
        for number in range(count):
            if resampling == "records":
                drawn = random.integers(len(data), size=len(data))
                problem.count_records(np.bincount(drawn, minlength=len(data)).tolist(), weights)
            else:
                problem.data = [
                    _drawn_anew(random, one, values) for one, values in zip(data, predicted, strict=True)
                ]
            minimum = search(problem, x, evaluations=_EVALUATIONS)
            if minimum.converged:
                fits.append(minimum.x)
            else:
                failed += 1
            if on_fit is not None:
                on_fit(number + 1, count)
    finally:
        problem.weights, problem.data = weights, data
    return Bootstrap(resampling, np.array(fits).reshape(len(fits), len(x)), failed)


def _drawn_anew(random: np.random.Generator, data: FloatArray, predicted: FloatArray) -> FloatArray:
    residuals = data - predicted
    return np.asarray(predicted + random.choice(residuals - np.mean(residuals), size=len(data)))
