"""Noise whose samples depend on each other: first-order autoregressive, and what makes it white again."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from pyjoystick.support import FloatArray

#: Correlations from sample to sample that are looked for.
_RANGE: Final = (-0.9, 0.995)
#: Singular values below this part of the largest are zero.
_ZERO: Final = 1e-8


class Memory(NamedTuple):
    """Correlation of each sample with the one before it, and nothing further: an AR(1) process.

    Attributes:
        previous: correlation with the sample before; 0 where a series begins, shape (n,)
    """

    previous: FloatArray

    @classmethod
    def of(cls, labels: Sequence[str], correlation: float) -> Memory:
        """The same correlation within each series of a record, none from one series to the next."""
        same = np.array([False, *(a == b for a, b in zip(labels[1:], labels[:-1], strict=True))])
        return cls(np.where(same, correlation, 0.0))

    def innovations(self, values: FloatArray) -> FloatArray:
        """What is new in each sample, in the same standard deviation; an array of shape (n, ...)."""
        if not self.previous.any():
            return values
        shape = (-1, *(1,) * (values.ndim - 1))
        before = np.concatenate((np.zeros_like(values[:1]), values[:-1]))
        rho = self.previous.reshape(shape)
        return np.asarray((values - rho * before) / np.sqrt(1.0 - rho**2))

    def noise(self, innovations: FloatArray) -> FloatArray:
        """The samples that have these innovations, shape (n,)."""
        found = innovations.copy()
        for i in np.flatnonzero(self.previous):
            rho = float(self.previous[i])
            found[i] = rho * found[i - 1] + math.sqrt(1.0 - rho**2) * innovations[i]
        return found


class Block(NamedTuple):
    """The residuals of one record.

    Attributes:
        labels: name of the series of each, length n
        residuals: in standard deviations of the noise, shape (n,)
        jacobian: their derivatives with respect to the variables, shape (n, variables)
        repeats: how many records the mean was taken off of, 1 where it was not
    """

    labels: Sequence[str]
    residuals: FloatArray
    jacobian: FloatArray
    repeats: FloatArray


def estimated_correlation(blocks: Sequence[Block]) -> float:
    """The correlation from sample to sample by restricted maximum likelihood.

    The likelihood is that of what the fitted variables leave over, so that fitting many of them does not make
    the noise look whiter than it is. Where the mean over repeats was taken off, what all repeats have in
    common, such as physics that the model lacks, does not count as noise.
    """
    lengths = np.linalg.norm(np.concatenate([one.jacobian for one in blocks]), axis=0)
    scale = np.where(lengths > 0.0, lengths, 1.0)

    def cost(correlation: float) -> float:
        residuals, rows, count, logs = [], [], 0.0, 0.0
        for one in blocks:
            memory = Memory.of(one.labels, correlation)
            own = np.where(one.repeats > 1.0, 1.0 - 1.0 / one.repeats, 1.0)
            residuals.append(memory.innovations(one.residuals))
            rows.append(memory.innovations(one.jacobian / scale))
            count += float(np.sum(own))
            logs += float(np.sum(own * np.log1p(-(memory.previous**2))))
        left, values = _left_over(np.concatenate(residuals), np.concatenate(rows))
        freedom = max(count - len(values), 1.0)
        return freedom * math.log(max(left, 1e-300) / freedom) + logs + 2.0 * float(np.sum(np.log(values)))

    found = minimize_scalar(cost, bounds=_RANGE, method="bounded", options={"xatol": 1e-5})
    return float(found.x)


def _left_over(residuals: FloatArray, jacobian: FloatArray) -> tuple[float, FloatArray]:
    """The sum of squares that the columns cannot explain, and their singular values but zeros."""
    basis, values, _ = np.linalg.svd(jacobian[:, jacobian.any(axis=0)], full_matrices=False)
    kept = values > _ZERO * max(values, default=0.0)
    explained = basis[:, kept].T @ residuals
    return float(residuals @ residuals - explained @ explained), np.asarray(values[kept])
