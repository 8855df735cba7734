"""Outliers: samples that are not part of the noise, and their weights."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy import stats

from pyjoystick.support import FloatArray

#: A normal sample exceeds the limit in one of this many fits.
_CHANCE: Final = 1e-3
#: Hampel's weights: 1 up to the first limit, 0 beyond the second (standard deviations).
_FULL: Final = 3.5
_NONE: Final = 6.0
#: A larger share of outliers, or a longer run of them, is a misfit instead.
_MOST: Final = 0.05
_LONGEST: Final = 3
#: Median absolute value of a standard normal variable.
_MEDIAN: Final = 0.6744897501960817


class Outliers(NamedTuple):
    """Samples that normal noise does not explain.

    Attributes:
        deviations: residuals by record in robust standard deviations, shape (n,) each
        limit: threshold in standard deviations
        few: whether the outliers are few and isolated
    """

    deviations: tuple[FloatArray, ...]
    limit: float
    few: bool

    @property
    def any(self) -> bool:
        """Whether there are any outliers."""
        return any(bool(np.any(np.abs(one) > self.limit)) for one in self.deviations)

    def shares(self) -> list[FloatArray]:
        """Weight of each residual, 0 to 1, by record."""
        return [
            np.sqrt(np.clip((_NONE - np.abs(one)) / (_NONE - _FULL), 0.0, 1.0)) for one in self.deviations
        ]

    def places(self) -> list[tuple[int, int, float]]:
        """Record, sample and deviation of each outlier."""
        return [
            (k, int(i), float(one[i]))
            for k, one in enumerate(self.deviations)
            for i in np.flatnonzero(np.abs(one) > self.limit)
        ]


def find_outliers(residuals: Sequence[FloatArray]) -> Outliers:
    """Find the outliers among residuals.

    Args:
        residuals: data minus prediction by record, in units of the noise up to a common factor, shape (n,)
            each
    """
    joined = np.concatenate(residuals)
    size = float(np.median(np.abs(joined))) / _MEDIAN
    limit = float(stats.norm.isf(0.5 * _CHANCE / max(len(joined), 1)))
    deviations = tuple(one / size if size > 0.0 else np.zeros_like(one) for one in residuals)
    beyond = [np.abs(one) > limit for one in deviations]
    count = sum(int(np.count_nonzero(one)) for one in beyond)
    longest = max((_longest(one.tolist()) for one in beyond), default=0)
    return Outliers(deviations, limit, count <= _MOST * len(joined) and longest <= _LONGEST)


def _longest(flags: Sequence[bool]) -> int:
    """Length of the longest run of true values."""
    longest = now = 0
    for flag in flags:
        now = now + 1 if flag else 0
        longest = max(longest, now)
    return longest
