"""Identifiability and standard errors from the Jacobian at the minimum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import stats

from pyjoystick.support import FloatArray

#: Singular values below this multiple of the error of the Jacobian, or below the floor, count as zero.
_MARGIN: Final = 10.0
_LEAST: Final = 1e-6
#: A column smaller than the largest by this factor, both scaled by the variable's size, is no influence.
_NO_INFLUENCE: Final = 1e-10
#: A column with this relative error reflects the scatter of the FMU's results, not an influence.
SCATTER: Final = 0.1
#: Contributions to a combination below this are omitted from the sentence.
_SHARE: Final = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class Identifiability:
    """Rank of the Jacobian at the minimum, and what it cannot determine.

    Attributes:
        singular_values: of the Jacobian with its columns scaled to length 1, descending, shape (variables,)
        condition: ratio of the largest to the smallest nonzero singular value
        rank: number of nonzero singular values
        variables: number of variables
        threshold: singular values below this count as zero
        undetermined: for each variable, whether the data leave it undetermined, shape (variables,)
        sentences: what the data cannot determine, one sentence each
        weakest: the worst-determined of the determined combinations
    """

    singular_values: FloatArray
    condition: float
    rank: int
    variables: int
    threshold: float
    undetermined: np.ndarray[tuple[int], np.dtype[np.bool_]]
    sentences: tuple[str, ...]
    weakest: str

    @property
    def deficient(self) -> bool:
        """Whether the data leave something undetermined."""
        return self.rank < self.variables


def identifiability(
    jacobian: FloatArray, sizes: FloatArray, labels: Sequence[str], errors: FloatArray
) -> Identifiability:
    """Compute rank and null space of the Jacobian.

    Args:
        jacobian: shape (residuals, variables)
        sizes: references for percentages of each variable, above 0, shape (variables,)
        labels: names of the variables
        errors: relative error of each column, shape (variables,)
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    seen = lengths * sizes > _NO_INFLUENCE * max(float(np.max(lengths * sizes)), 1e-300)
    safe = np.where(seen, lengths, 1.0)
    _, values, rows = np.linalg.svd(np.where(seen, jacobian / safe, 0.0), full_matrices=False)
    threshold = max(_LEAST, _MARGIN * float(np.max(errors[seen], initial=0.0)))
    rank = int(np.sum(values > threshold))
    null = np.zeros((len(sizes) - rank, len(sizes)))
    null[: len(values) - rank] = rows[rank:]
    # In fractions of each variable's size: a joint change that the data do not notice.
    relative = null / (safe * sizes)
    basis = _sparse(relative)
    sentences = tuple(_sentence(vector, labels) for vector in basis)
    weakest = ""
    if rank:
        worst = rows[rank - 1] / (safe * sizes)
        weakest = _combination(worst / np.max(np.abs(worst)), labels)
    return Identifiability(
        values,
        float(values[0] / values[rank - 1]) if rank else float("inf"),
        rank,
        len(sizes),
        threshold,
        np.any(np.abs(basis) > _SHARE, axis=0) if len(basis) else np.zeros(len(sizes), dtype=np.bool_),
        sentences,
        weakest,
    )


def _sparse(vectors: FloatArray) -> FloatArray:
    """Basis of the same space in which each vector has a 1 where the others have 0 (Gauss-Jordan)."""
    basis = vectors.copy()
    used: list[int] = []
    for i in range(len(basis)):
        basis[i:] /= np.maximum(np.max(np.abs(basis[i:]), axis=1, keepdims=True), 1e-300)
        candidates = np.abs(basis[i:]).copy()
        candidates[:, np.array(used, dtype=np.intp)] = 0.0
        row, column = divmod(int(np.argmax(candidates)), candidates.shape[1])
        basis[[i, i + row]] = basis[[i + row, i]]
        basis[i] /= basis[i, column]
        for j in range(len(basis)):
            if j != i:
                basis[j] -= basis[j, column] * basis[i]
        used.append(column)
    for i in range(len(basis)):
        largest = float(np.max(np.abs(basis[i])))
        basis[i] /= largest if largest > 0.0 else 1.0
    return basis


def _sentence(vector: FloatArray, labels: Sequence[str]) -> str:
    taking_part = np.flatnonzero(np.abs(vector) > _SHARE)
    if len(taking_part) == 1:
        return f"{labels[taking_part[0]]} has no influence on what was measured"
    return f"{_combination(vector, labels)} together change nothing that was measured: fix one of them"


def _combination(vector: FloatArray, labels: Sequence[str]) -> str:
    """Text such as ``J +1 %, damping.C +1 %``."""
    ranked: list[int] = np.argsort(-np.abs(vector), kind="stable").tolist()
    order = [j for j in ranked if abs(vector[j]) > _SHARE]
    turn = np.sign(vector[order[0]]) if order else 1.0
    return ", ".join(f"{labels[j]} {turn * vector[j]:+.2g} %" for j in order)


@dataclass(frozen=True, slots=True, eq=False)
class StandardErrors:
    """Uncertainty in the linear approximation.

    Attributes:
        errors: standard errors, shape (variables,); infinite for undetermined variables
        covariance: shape (variables, variables); rows and columns of undetermined variables are NaN
        correlation: correlation matrix, with ones on the diagonal
        quantile: half-width of an interval in standard errors: Student's t if the noise was estimated
        degrees_of_freedom: number of samples minus number of variables
    """

    errors: FloatArray
    covariance: FloatArray
    correlation: FloatArray
    quantile: float
    degrees_of_freedom: int

    def intervals(self, x: FloatArray) -> FloatArray:
        """Lower and upper limits, shape (variables, 2)."""
        half = self.quantile * self.errors
        return np.column_stack((x - half, x + half))

    def of(self, slope: FloatArray) -> float:
        """Standard error of a number whose derivatives with respect to the variables are `slope`.

        Infinite if it depends on an undetermined variable.
        """
        used = slope != 0.0
        variance = float(slope[used] @ self.covariance[np.ix_(used, used)] @ slope[used])
        return math.sqrt(variance) if math.isfinite(variance) else math.inf


def standard_errors(
    jacobian: FloatArray, known: Identifiability, samples: int, level: float, *, sigma_known: bool
) -> StandardErrors:
    """Compute standard errors from a Jacobian of residuals in units of the noise's standard deviation.

    Args:
        jacobian: shape (residuals, variables)
        known: rank and null space of that Jacobian
        samples: number of residuals with nonzero weight
        level: confidence level of the intervals
        sigma_known: whether the noise was given rather than estimated
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    safe = np.where(lengths > 0.0, lengths, 1.0)
    _, values, rows = np.linalg.svd(jacobian / safe, full_matrices=False)
    kept = rows[: known.rank] / values[: known.rank, np.newaxis]
    covariance = (kept.T @ kept) / np.outer(safe, safe)
    errors = np.sqrt(np.diag(covariance))
    undetermined = known.undetermined
    covariance[undetermined] = np.nan
    covariance[:, undetermined] = np.nan
    with np.errstate(invalid="ignore"):
        correlation = covariance / np.outer(errors, errors)
    np.fill_diagonal(correlation, 1.0)
    freedom = max(samples - known.rank, 1)
    tail = 0.5 * (1.0 + level)
    quantile = float(stats.norm.ppf(tail) if sigma_known else stats.t.ppf(tail, freedom))
    return StandardErrors(np.where(undetermined, np.inf, errors), covariance, correlation, quantile, freedom)
