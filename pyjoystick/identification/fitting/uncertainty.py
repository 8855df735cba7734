"""Standard errors, intervals and correlations from the Jacobian at the minimum."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.identifiability import Identifiability
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class StandardErrors:
    """The linear approximation of the uncertainty.

    Attributes:
        errors: standard errors, shape (variables,); infinite where the data leave a variable open
        covariance: shape (variables, variables); rows and columns of open variables are NaN
        correlation: the same, scaled; the diagonal is 1
        quantile: half-width of an interval in standard errors: Student's t where the noise was estimated
        degrees_of_freedom: samples less variables
    """

    errors: FloatArray
    covariance: FloatArray
    correlation: FloatArray
    quantile: float
    degrees_of_freedom: int

    def intervals(self, x: FloatArray) -> FloatArray:
        """Lower and upper ends, shape (variables, 2)."""
        half = self.quantile * self.errors
        return np.column_stack((x - half, x + half))

    def of(self, slope: FloatArray) -> float:
        """Standard error of a number whose derivatives with respect to the variables are `slope`.

        Infinite where it depends on a variable that the data leave open.
        """
        used = slope != 0.0
        variance = float(slope[used] @ self.covariance[np.ix_(used, used)] @ slope[used])
        return math.sqrt(variance) if math.isfinite(variance) else math.inf


def standard_errors(
    jacobian: FloatArray, known: Identifiability, samples: int, level: float, *, sigma_known: bool
) -> StandardErrors:
    """Standard errors from a Jacobian of residuals in units of the noise's standard deviation.

    Args:
        jacobian: shape (residuals, variables)
        known: rank of that Jacobian
        samples: number of residuals that count
        level: confidence level of the intervals
        sigma_known: the noise was given and not estimated
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    safe = np.where(lengths > 0.0, lengths, 1.0)
    _, values, rows = np.linalg.svd(jacobian / safe, full_matrices=False)
    kept = rows[: known.rank] / values[: known.rank, np.newaxis]
    covariance = (kept.T @ kept) / np.outer(safe, safe)
    errors = np.sqrt(np.diag(covariance))
    open_ones = known.undetermined
    covariance[open_ones] = np.nan
    covariance[:, open_ones] = np.nan
    with np.errstate(invalid="ignore"):
        correlation = covariance / np.outer(errors, errors)
    np.fill_diagonal(correlation, 1.0)
    freedom = max(samples - known.rank, 1)
    tail = 0.5 * (1.0 + level)
    quantile = float(stats.norm.ppf(tail) if sigma_known else stats.t.ppf(tail, freedom))
    return StandardErrors(np.where(open_ones, np.inf, errors), covariance, correlation, quantile, freedom)
