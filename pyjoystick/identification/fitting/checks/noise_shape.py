"""The noise estimated from the residuals: outliers, color and level."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyjoystick.identification.fitting.checks.residual_checks import CHANCE, whiteness
from pyjoystick.identification.fitting.checks.residual_view import ResidualView
from pyjoystick.identification.fitting.checks.torque_noise import with_torque_noise
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_model import NoiseModel, relative_sizes, weights_of
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.support import FloatArray

#: The noise has settled when levels change by less than this part, and weights and correlations by less than
#: this.
_LEVEL_CHANGE = 1e-4
_SHAPE_CHANGE = 1e-3
#: Noise is called colored if white noise would look like it in at most one of this many fits.
_COLORED = 2.0 * CHANCE


def with_noise_of(problem: Problem, x: FloatArray, settings: FitSettings, least: float) -> Problem:
    """Return the problem with the noise estimated from the residuals at x.

    Args:
        problem: the problem with the noise assumed so far
        x: the minimum
        settings: what is known and what may be assumed about the noise
        least: residuals up to this size (in the unit of the data) are not noise
    """
    noise, peaks = settings.noise, settings.comparison == "peaks"
    if not peaks and _largest(problem, x) > least:
        before = problem.noise
        if noise.robust:
            problem = _without_outliers(problem, x)
        if noise.colored:
            problem = with_torque_noise(problem, x, sigma_known=bool(noise.sigma))
        # Estimate the color only after the outliers have settled, because they distort it.
        if noise.colored and _change_of_shares(before, problem.noise) < _SHAPE_CHANGE:
            problem = _colored(problem, x)
    if not noise.sigma:
        sigmas = estimated_sigmas(problem, x, per_record=noise.per_record, combined=peaks)
        problem = problem.with_weights(weights_of(problem.predictors, sigmas))
    return problem


def has_settled(before: Problem, after: Problem, settings: FitSettings) -> bool:
    """Whether the noise of `after` would leave the minimum where it is."""
    ratios = _levels(after, settings) / _levels(before, settings)
    # A common factor of all levels moves the minimum only where prior knowledge counts beside the samples.
    factor = ratios[:1] if len(after.prior) == 0 else np.ones(1)
    return (
        bool(np.allclose(ratios, factor, rtol=_LEVEL_CHANGE, atol=0.0))
        and _change_of_shares(before.noise, after.noise) < _SHAPE_CHANGE
        and abs(after.noise.correlation - before.noise.correlation) < _SHAPE_CHANGE
        and abs(after.noise.torque_part - before.noise.torque_part) < _SHAPE_CHANGE
    )


def estimated_sigmas(
    problem: Problem, x: FloatArray, *, per_record: bool, combined: bool
) -> list[dict[str, float]]:
    """Estimate standard deviations by record and series from the residuals at x.

    The fitted variables are subtracted from the number of samples, in proportion to the samples of each
    group.

    Args:
        problem: the problem
        x: the minimum
        per_record: estimate for each record separately
        combined: one value for all series, as for the relative errors of peaks
    """
    sums: dict[tuple[int, str], list[float]] = {}
    for k, predicted in enumerate(problem.predictions(x)):
        predictor, shares = problem.predictors[k], problem.noise.shares[k]
        scaled = problem.noise.counted(predicted - predictor.data, k)
        scaled = scaled / (problem.noise.weights[k] * relative_sizes(predictor))
        labels = np.array(predictor.labels)
        for label in dict.fromkeys(predictor.labels):
            group = sums.setdefault((k if per_record else -1, "" if combined else label), [0.0, 0.0])
            group[0] += float(np.sum(scaled[labels == label] ** 2))
            group[1] += float(np.sum(shares[labels == label] ** 2))
    samples = sum(group[1] for group in sums.values())
    # Prior knowledge of a variable uses up no degree of freedom of the samples.
    freedom = max(samples - (len(x) - len(problem.prior)), 1.0) / samples
    sigma = {key: float(np.sqrt(total / (count * freedom))) for key, (total, count) in sums.items()}
    return [
        {
            label: max(sigma[(k if per_record else -1, "" if combined else label)], np.finfo(float).tiny)
            for label in dict.fromkeys(predictor.labels)
        }
        for k, predictor in enumerate(problem.predictors)
    ]


def _without_outliers(problem: Problem, x: FloatArray) -> Problem:
    """Reduce the weights of outliers if there are few; otherwise restore full weights."""
    outliers = ResidualView(problem, x).outliers()
    in_full = all(bool(np.all(one == 1.0)) for one in problem.noise.shares)
    if not outliers.few or (in_full and not outliers.any):
        return problem
    return replace(problem, noise=replace(problem.noise, shares=tuple(outliers.shares())))


def _colored(problem: Problem, x: FloatArray) -> Problem:
    """Give the problem the residuals' correlation, if white noise would hardly look like them."""
    view = ResidualView(problem, x)
    if problem.noise.correlation == 0.0 and whiteness(view.series()).chance >= _COLORED:
        return problem
    return replace(problem, noise=problem.noise.colored(problem.predictors, view.correlation()))


def _change_of_shares(before: NoiseModel, after: NoiseModel) -> float:
    return max(float(np.max(np.abs(a - b))) for a, b in zip(before.shares, after.shares, strict=True))


def _levels(problem: Problem, settings: FitSettings) -> FloatArray:
    """Standard deviation of each series of each record; 1 if the settings give them."""
    if settings.noise.sigma:
        return np.ones(1)
    found = []
    for predictor, weights in zip(problem.predictors, problem.noise.weights, strict=True):
        labels = np.array(predictor.labels)
        found += [1.0 / float(weights[labels == label][0]) for label in dict.fromkeys(predictor.labels)]
    return np.array(found)


def _largest(problem: Problem, x: FloatArray) -> float:
    return max(
        float(np.max(np.abs(data - predicted)))
        for data, predicted in zip(problem.data, problem.predictions(x), strict=True)
    )
