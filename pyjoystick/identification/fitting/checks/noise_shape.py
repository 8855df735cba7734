"""The noise as the residuals show it: its level, its outliers and its color, and the weights that follow."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from pyjoystick.identification.fitting.checks.residual_checks import CHANCE, whiteness
from pyjoystick.identification.fitting.checks.residual_view import ResidualView
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_color import Memory
from pyjoystick.identification.fitting.problem.noise_model import estimated_sigmas, weights_of
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.support import FloatArray

#: Levels that change by less than this part, and shares and correlations by less than this, have settled.
_LEVEL_CHANGE = 1e-4
_SHAPE_CHANGE = 1e-3
#: Noise is called colored if white noise would look like it once in this many fits.
_COLORED = 2.0 * CHANCE


class NoiseShape(NamedTuple):
    """What is assumed of the noise.

    Attributes:
        levels: standard deviations, shape (levels,); empty where they are given
        shares: how much each residual counts, shape (all samples,)
        correlation: from sample to sample
    """

    levels: FloatArray
    shares: FloatArray
    correlation: float

    def settled(self, before: NoiseShape) -> bool:
        """Whether the minimum stays where it is with this shape."""
        # One level for all is a common factor.
        ratios = self.levels / before.levels
        return (
            bool(np.allclose(ratios, ratios[:1], rtol=_LEVEL_CHANGE, atol=0.0))
            and float(np.max(np.abs(self.shares - before.shares))) < _SHAPE_CHANGE
            and abs(self.correlation - before.correlation) < _SHAPE_CHANGE
        )


def first_shape(problem: Problem, settings: FitSettings) -> NoiseShape:
    """What is assumed before there is a fit: white noise of one level relative to the data."""
    return NoiseShape(_levels(problem, settings), np.concatenate(problem.shares), 0.0)


def shaped(problem: Problem, x: FloatArray, settings: FitSettings, least: float) -> NoiseShape:
    """Give a problem the weights, shares and memories of the noise that the residuals at x show.

    Args:
        problem: the problem
        x: the minimum
        settings: what of the noise is known, and what may be assumed
        least: residuals no larger than this (in the unit of the data) are no noise
    """
    noise, peaks = settings.noise, settings.comparison == "peaks"
    moved = 0.0
    if not peaks and _largest(problem, x) > least:
        if noise.robust:
            outliers = ResidualView(problem, x).outliers()
            if outliers.few and (outliers.any or not _all_in_full(problem)):
                before, problem.shares = problem.shares, outliers.shares()
                moved = max(float(np.max(np.abs(a - b))) for a, b in zip(before, problem.shares, strict=True))
        # The color of residuals that outliers still pull at is not that of the noise.
        if noise.colored and moved < _SHAPE_CHANGE:
            view = ResidualView(problem, x)
            if problem.correlation != 0.0 or whiteness(view.series()).chance < _COLORED:
                problem.correlation = view.correlation()
                problem.memories = [Memory.of(one.labels, problem.correlation) for one in problem.predictors]
    if not noise.sigma:
        sigmas = estimated_sigmas(problem, x, per_record=noise.per_record, combined=peaks)
        problem.weights = weights_of(problem, sigmas)
    return NoiseShape(_levels(problem, settings), np.concatenate(problem.shares), problem.correlation)


def _levels(problem: Problem, settings: FitSettings) -> FloatArray:
    """One standard deviation for each series of each record, but for a factor that stays the same."""
    if settings.noise.sigma:
        return np.ones(1)
    found = []
    for predictor, weights in zip(problem.predictors, problem.weights, strict=True):
        labels = np.array(predictor.labels)
        found += [1.0 / float(weights[labels == label][0]) for label in dict.fromkeys(predictor.labels)]
    return np.array(found)


def _largest(problem: Problem, x: FloatArray) -> float:
    return max(
        float(np.max(np.abs(data - predicted)))
        for data, predicted in zip(problem.data, problem.predictions(x), strict=True)
    )


def _all_in_full(problem: Problem) -> bool:
    return all(bool(np.all(one == 1.0)) for one in problem.shares)
