"""Residuals at a point, in the forms that the checks and the noise model need."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from pyjoystick.identification.fitting.checks.outliers import Outliers, find_outliers
from pyjoystick.identification.fitting.checks.repeats import Repeats, find_repeats
from pyjoystick.identification.fitting.checks.residual_checks import Series
from pyjoystick.identification.fitting.checks.score_test import column_space
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_color import Block, estimated_correlation
from pyjoystick.support import FloatArray


class ResidualView:
    """Residuals (data minus prediction) and their derivatives at a point.

    Attributes:
        innovations: weighted residuals, decorrelated, by record
        residuals: all of them, followed by those of prior knowledge, shape (terms,)
        jacobian: derivatives of the weighted predictions and of prior knowledge, shape (terms, variables)
    """

    def __init__(self, problem: Problem, x: FloatArray) -> None:
        self._problem = problem
        self._x = x
        self._predicted = problem.predictions(x)
        self._left = [data - one for data, one in zip(problem.data, self._predicted, strict=True)]
        self._slopes = problem.jacobians(x)
        self.innovations = [problem.noise.counted(one, k) for k, one in enumerate(self._left)]
        known = problem.prior
        self.residuals = np.concatenate([*self.innovations, known @ (problem.measured - x)])
        counted = (problem.noise.counted(one, k) for k, one in enumerate(self._slopes))
        self.jacobian = np.concatenate([*counted, known])

    def outliers(self) -> Outliers:
        """Outliers, found without regard to the present shares."""
        noise = self._problem.noise
        full = replace(noise, shares=tuple(np.ones_like(one) for one in noise.shares))
        return find_outliers([full.scaled(one, k) for k, one in enumerate(self._left)])

    def series(self) -> list[Series]:
        """Innovations of each series of each record."""
        basis = np.split(column_space(self.jacobian), np.cumsum([len(one) for one in self.innovations]))
        found = []
        for k, predictor in enumerate(self._problem.predictors):
            labels = np.array(predictor.labels)
            several = len(set(predictor.labels)) > 1
            for label in dict.fromkeys(predictor.labels):
                name = f"{label} of {predictor.record.name}" if several else predictor.record.name
                own = labels == label
                found.append(Series(name, self.innovations[k][own], basis[k][own]))
        return found

    @cached_property
    def repeats(self) -> Repeats:
        """The records that repeat each other."""
        predictors = self._problem.predictors
        late = [
            one.times - self._problem.variables.instrument(self._x, k).origin
            for k, one in enumerate(predictors)
        ]
        return find_repeats([one.labels for one in predictors], late, self._predicted)

    def correlation(self) -> float:
        """Correlation of the noise from sample to sample; with repeats, that of their differences."""
        problem, repeats = self._problem, self.repeats
        scaled = [
            [problem.noise.scaled(one, k) for k, one in enumerate(parts)]
            for parts in (self._left, self._slopes)
        ]
        if repeats.any:
            scaled = [repeats.deviations(parts) for parts in scaled]
        return estimated_correlation(
            [
                Block(predictor.labels, residuals, jacobian, repeats.sizes(k))
                for k, (predictor, residuals, jacobian) in enumerate(
                    zip(problem.predictors, *scaled, strict=True)
                )
            ]
        )
