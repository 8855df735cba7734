"""Straight lines in log-log, C = A * height^n, with t-based intervals and confidence bands."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import t as student

from pyjoystick.identification.errors import DampingEstimateError
from pyjoystick.support import FloatArray

#: Coefficients are limited to between exp(-this) and exp(this) N m s/rad.
_LARGEST: Final = 50.0


@dataclass(frozen=True, slots=True, eq=False)
class PowerLine:
    """Least-squares line of ln C over ln height, expressed as a power law.

    Attributes:
        coefficient: A (N m s/rad): the line's C at a height of 1 (rad or rad/s)
        exponent: n, the slope
        points: number of points
        scatter: standard deviation of the points about the line (in ln C)
        center: mean of ln height
        spread: sum of squares of ln height about its mean
    """

    coefficient: float
    exponent: float
    points: int
    scatter: float
    center: float
    spread: float

    def at(self, height: ArrayLike) -> FloatArray:
        """C (N m s/rad) on the line at heights (rad or rad/s)."""
        return np.asarray(self.coefficient * np.power(height, self.exponent), dtype=np.float64)

    def band(self, height: ArrayLike, confidence: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Lower and upper confidence limits of the line itself (the mean of ln C) at heights.

        The points are taken as independent. Peaks of one record share its release, and curvature is not
        scatter; where these matter, the band is too narrow.
        """
        distance = np.log(np.asarray(height, dtype=np.float64)) - self.center
        error = self.scatter * np.sqrt(1.0 / self.points + distance**2 / self.spread)
        factor = np.exp(self._quantile(confidence) * error)
        return self.at(height) / factor, self.at(height) * factor

    def coefficient_interval(self, confidence: float = 0.95) -> tuple[float, float]:
        """Confidence interval of A."""
        low, high = self.band(1.0, confidence)
        return float(low), float(high)

    def exponent_interval(self, confidence: float = 0.95) -> tuple[float, float]:
        """Confidence interval of n."""
        half = self._quantile(confidence) * self.scatter / math.sqrt(self.spread)
        return self.exponent - half, self.exponent + half

    def _quantile(self, confidence: float) -> float:
        if not 0.0 < confidence < 1.0:
            raise DampingEstimateError(f"confidence = {confidence}: must be between 0 and 1")
        return float(student.ppf(0.5 + 0.5 * confidence, self.points - 2))


def fit_power_line(height: ArrayLike, damping: ArrayLike, *, name: str) -> PowerLine:
    """Fit a line through points.

    Args:
        height: magnitudes of peaks (rad or rad/s), shape (n,), above 0
        damping: C_exp (N m s/rad), shape (n,), above 0
        name: name of the line in messages

    Raises:
        DampingEstimateError: fewer than three points, a point that is not above zero, all of one height, or a
            coefficient outside any plausible range
    """
    heights, values = np.asarray(height, dtype=np.float64), np.asarray(damping, dtype=np.float64)
    if len(heights) < 3:
        raise DampingEstimateError(
            f"{name}: {len(heights)} points; a line with a band needs 3: take more peaks or records"
        )
    if not (np.all(heights > 0.0) and np.all(values > 0.0)):
        raise DampingEstimateError(f"{name}: a logarithm needs heights and C above zero")
    x, y = np.log(heights), np.log(values)
    center = float(np.mean(x))
    spread = float(np.sum((x - center) ** 2))
    if spread == 0.0:
        raise DampingEstimateError(f"{name}: all points have the same height; a line needs two heights")
    slope = float(np.sum((x - center) * y)) / spread
    intercept = float(np.mean(y)) - slope * center
    if abs(intercept) > _LARGEST:
        raise DampingEstimateError(
            f"{name}: the line is C = exp({intercept:.3g})*height**{slope:.3g}, which is not damping: "
            "do the records have a zero offset?"
        )
    squares = float(np.sum((y - intercept - slope * x) ** 2))
    scatter = math.sqrt(squares / (len(x) - 2))
    return PowerLine(math.exp(intercept), slope, len(x), scatter, center, spread)
