"""Weights from the noise: given, or estimated from what the fit leaves over."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.problem.prediction import Predictor
from pyjoystick.identification.fitting.problem.settings import Noise
from pyjoystick.support import FloatArray

#: Relative to the largest value, what the noise is taken to be before there is an estimate.
_FIRST_GUESS = 1e-2


def relative_sizes(predictor: Predictor) -> FloatArray:
    """What one residual is measured in: the noise is `sigma` of these, shape (n,)."""
    if isinstance(predictor, PeakPredictor):
        return predictor.normalization
    return np.ones(len(predictor.data))


def first_weights(predictors: Sequence[Predictor], noise: Noise) -> list[FloatArray]:
    """Weights before the first search: exact where the noise is given."""
    found = []
    for predictor in predictors:
        labels = np.array(predictor.labels)
        sigma = np.full(len(labels), _FIRST_GUESS)
        # The errors of peaks are relative already, and heights and times count alike.
        for label in dict.fromkeys(predictor.labels if not isinstance(predictor, PeakPredictor) else ()):
            # One size for all records, so that none counts more before anything is known.
            largest = max(_largest(other, label) for other in predictors)
            sigma[labels == label] = noise.sigma.get(label, _FIRST_GUESS * largest)
        found.append(1.0 / (sigma * relative_sizes(predictor)))
    return found


def estimated_sigmas(
    problem: Problem, x: FloatArray, *, per_record: bool, combined: bool
) -> list[dict[str, float]]:
    """Standard deviations by record and series, from the residuals at x.

    The variables that were fitted are taken off the number of samples, in proportion to those of each group.

    Args:
        problem: the problem
        x: the minimum
        per_record: estimate for each record separately
        combined: one for all series, as for the relative errors of peaks
    """
    sums: dict[tuple[int, str], list[float]] = {}
    for k, predicted in enumerate(problem.predictions(x)):
        predictor = problem.predictors[k]
        shares = problem.shares[k]
        scaled = problem.memories[k].innovations(
            shares * (predicted - predictor.data) / relative_sizes(predictor)
        )
        labels = np.array(predictor.labels)
        for label in dict.fromkeys(predictor.labels):
            group = sums.setdefault((k if per_record else -1, "" if combined else label), [0.0, 0.0])
            group[0] += float(np.sum(scaled[labels == label] ** 2))
            group[1] += float(np.sum(shares[labels == label] ** 2))
    samples = sum(group[1] for group in sums.values())
    # What is known beforehand is no freedom that the samples give.
    freedom = max(samples - (len(x) - len(problem.prior)), 1.0) / samples
    sigma = {key: float(np.sqrt(total / (count * freedom))) for key, (total, count) in sums.items()}
    return [
        {
            label: max(sigma[(k if per_record else -1, "" if combined else label)], np.finfo(float).tiny)
            for label in dict.fromkeys(predictor.labels)
        }
        for k, predictor in enumerate(problem.predictors)
    ]


def weights_of(problem: Problem, sigmas: Sequence[dict[str, float]]) -> list[FloatArray]:
    """The weights that make residuals count in standard deviations."""
    return [
        1.0 / (np.array([sigma[label] for label in predictor.labels]) * relative_sizes(predictor))
        for predictor, sigma in zip(problem.predictors, sigmas, strict=True)
    ]


def _largest(predictor: Predictor, label: str) -> float:
    inside = np.array(predictor.labels) == label
    if not inside.any():
        return 0.0
    return float(np.max(np.abs(predictor.data[inside])))
