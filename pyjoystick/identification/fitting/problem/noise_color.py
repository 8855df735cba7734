"""Autocorrelated noise: first-order autoregressive, and the filter that whitens it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from pyjoystick.support import FloatArray

#: Range of correlations from sample to sample that is searched.
_RANGE: Final = (-0.9, 0.995)
#: Singular values below this part of the largest count as zero.
_ZERO: Final = 1e-8


class Memory(NamedTuple):
    """An AR(1) process: each sample is correlated with the one before it.

    Attributes:
        previous: correlation with the sample before; 0 where a series starts, shape (n,)
    """

    previous: FloatArray

    @classmethod
    def of(cls, labels: Sequence[str], correlation: float) -> Memory:
        """Use the same correlation within each series of a record, and none between series."""
        same = np.array([False, *(a == b for a, b in zip(labels[1:], labels[:-1], strict=True))])
        return cls(np.where(same, correlation, 0.0))

    def innovations(self, values: FloatArray) -> FloatArray:
        """Innovation of each sample, with the same standard deviation; an array of shape (n, ...)."""
        if not self.previous.any():
            return values
        shape = (-1, *(1,) * (values.ndim - 1))
        before = np.concatenate((np.zeros_like(values[:1]), values[:-1]))
        rho = self.previous.reshape(shape)
        return np.asarray((values - rho * before) / np.sqrt(1.0 - rho**2))

    def noise(self, innovations: FloatArray) -> FloatArray:
        """Samples that have these innovations, shape (n,)."""
        found = innovations.copy()
        for i in np.flatnonzero(self.previous):
            rho = float(self.previous[i])
            found[i] = rho * found[i - 1] + math.sqrt(1.0 - rho**2) * innovations[i]
        return found


class Block(NamedTuple):
    """Residuals of one record.

    Attributes:
        labels: name of the series of each residual, length n
        residuals: in standard deviations of the noise, shape (n,)
        jacobian: their derivatives with respect to the variables, shape (n, variables)
        repeats: number of records whose mean was subtracted, 1 if none was
    """

    labels: Sequence[str]
    residuals: FloatArray
    jacobian: FloatArray
    repeats: FloatArray


def estimated_correlation(blocks: Sequence[Block]) -> float:
    """Estimate the correlation from sample to sample by restricted maximum likelihood.

    It uses the likelihood of what the fitted variables cannot explain, so that fitting many of them does not
    make the noise look whiter than it is. Where the mean over repeats was subtracted, effects common to all
    repeats, such as missing physics, do not count as noise.
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
        return restricted_likelihood(residuals, rows, count, logs, sigma_known=False)[0]

    found = minimize_scalar(cost, bounds=_RANGE, method="bounded", options={"xatol": 1e-5})
    return float(found.x)


def restricted_likelihood(
    residuals: Sequence[FloatArray],
    rows: Sequence[FloatArray],
    samples: float,
    logarithm: float,
    *,
    sigma_known: bool,
) -> tuple[float, float]:
    """Minus twice the logarithm of the restricted likelihood, up to a constant, and the noise's level.

    Args:
        residuals: whitened residuals by record, shape (n,) each
        rows: their derivatives with respect to the variables, shape (n, variables) each
        samples: number of independent samples
        logarithm: logarithm of the determinant of the covariance that was removed by whitening
        sigma_known: whether the level is 1 rather than the one for which the likelihood is largest
    """
    left, values = _left_over(np.concatenate(residuals), np.concatenate(rows))
    freedom = max(samples - len(values), 1.0)
    level = 1.0 if sigma_known else max(left, 1e-300) / freedom
    cost = left / level + freedom * math.log(level) + logarithm + 2.0 * float(np.sum(np.log(values)))
    return cost, math.sqrt(level)


def _left_over(residuals: FloatArray, jacobian: FloatArray) -> tuple[float, FloatArray]:
    """Sum of squares that the columns cannot explain, and their nonzero singular values."""
    basis, values, _ = np.linalg.svd(jacobian[:, jacobian.any(axis=0)], full_matrices=False)
    kept = values > _ZERO * max(values, default=0.0)
    explained = basis[:, kept].T @ residuals
    return float(residuals @ residuals - explained @ explained), np.asarray(values[kept])
