"""Noise of a measured torque, as the angle shows it, and the filter that whitens it."""

from __future__ import annotations

import math
from copy import copy
from typing import Final, NamedTuple

import numpy as np

from pyjoystick.support import FloatArray

#: Orders of differences from which the level of white noise is estimated.
_ORDERS: Final = range(2, 8)
#: Median of the magnitude of normal noise, in standard deviations.
_MEDIAN: Final = 0.6744897501960817


def white_level(values: FloatArray) -> float:
    """Standard deviation of the white noise in evenly spaced samples of something smooth.

    White noise gives the same estimate from differences of any order. What is smooth adds less to higher
    ones, so that the smallest estimate is the best; the median leaves out corners and outliers.
    """
    found = []
    for order in _ORDERS:
        differences = np.diff(values, order)
        if len(differences) > 0:
            gain = math.sqrt(math.comb(2 * order, order))
            found.append(float(np.median(np.abs(differences))) / (_MEDIAN * gain))
    return min(found, default=0.0)


class TorqueNoise(NamedTuple):
    """White noise of the torque measured in one record.

    Attributes:
        level: its standard deviation (N m)
        effects: what it adds to the residuals, in the unit of the data, for independent numbers of one
            standard deviation each; shape (n, numbers)
    """

    level: float
    effects: FloatArray


class Whitener:
    """Whitens residuals that contain white noise of one standard deviation and `effects @ numbers`.

    The numbers are independent, of one standard deviation each. The filter is the symmetric one, so that a
    whitened residual still belongs to its sample.
    """

    def __init__(self, effects: FloatArray) -> None:
        """Take the effects, shape (n, numbers)."""
        self._basis, self._sizes, _ = np.linalg.svd(effects, full_matrices=False)

    def times(self, factor: float) -> Whitener:
        """The filter for effects that are larger by a factor."""
        found = copy(self)
        found._sizes = factor * self._sizes
        return found

    @property
    def logarithm(self) -> float:
        """Logarithm of the determinant of the covariance."""
        return float(np.sum(np.log1p(self._sizes**2)))

    def whitened(self, values: FloatArray) -> FloatArray:
        """Residuals, shape (n, ...), as independent ones of one standard deviation."""
        return self._scaled(values, 1.0 / np.sqrt(1.0 + self._sizes**2))

    def colored(self, values: FloatArray) -> FloatArray:
        """The inverse of `whitened`."""
        return self._scaled(values, np.sqrt(1.0 + self._sizes**2))

    def _scaled(self, values: FloatArray, gains: FloatArray) -> FloatArray:
        parts = self._basis.T @ values
        factors = (gains - 1.0).reshape(-1, *(1,) * (values.ndim - 1))
        return np.asarray(values + self._basis @ (factors * parts))
