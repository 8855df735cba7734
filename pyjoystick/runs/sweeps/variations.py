"""How one parameter varies: levels, or a distribution given by its quantiles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import special

from pyjoystick.support import FloatArray

#: The open interval of probabilities that every quantile is finite on.
_SMALLEST: Final = 2.0**-54


@dataclass(frozen=True, slots=True)
class Levels:
    """Given values: the levels of a grid, or a choice with equal chances where runs are sampled.

    Attributes:
        values: the levels, each once, numbers or Booleans
    """

    values: tuple[Any, ...]

    def quantile(self, probability: FloatArray) -> NDArray[Any]:
        """The value at each probability in [0, 1), in the order of the levels."""
        index = np.minimum((probability * len(self.values)).astype(np.intp), len(self.values) - 1)
        return np.array(self.values)[index]


@dataclass(frozen=True, slots=True)
class Uniform:
    """Equal density from `low` to `high`."""

    low: float
    high: float

    def quantile(self, probability: FloatArray) -> FloatArray:
        """The value at each probability in [0, 1)."""
        return self.low + (self.high - self.low) * probability


@dataclass(frozen=True, slots=True)
class LogUniform:
    """Equal density of the logarithm from `low` to `high`, both above zero."""

    low: float
    high: float

    def quantile(self, probability: FloatArray) -> FloatArray:
        """The value at each probability in [0, 1)."""
        exponent = math.log(self.low) + math.log(self.high / self.low) * probability
        return np.clip(np.exp(exponent), self.low, self.high)


@dataclass(frozen=True, slots=True)
class Normal:
    """The normal distribution, truncated to `low` .. `high`, which may be infinite.

    `mean` and `deviation` are those before it is truncated; `mean` lies from `low` to `high`.
    """

    mean: float
    deviation: float
    low: float = -math.inf
    high: float = math.inf

    def quantile(self, probability: FloatArray) -> FloatArray:
        """The value at each probability in [0, 1)."""
        below, upto = (special.ndtr((end - self.mean) / self.deviation) for end in (self.low, self.high))
        inside = below + (upto - below) * np.clip(probability, _SMALLEST, 1.0 - _SMALLEST)
        return np.clip(self.mean + self.deviation * special.ndtri(inside), self.low, self.high)


@dataclass(frozen=True, slots=True)
class LogNormal:
    """The logarithm is normal; truncated to `low` .. `high`, `low` zero or more.

    Attributes:
        median: before it is truncated, above zero and from `low` to `high`
        log_deviation: standard deviation of the natural logarithm; where small, the relative deviation
        low, high: the ends, `high` may be infinite
    """

    median: float
    log_deviation: float
    low: float = 0.0
    high: float = math.inf

    def quantile(self, probability: FloatArray) -> FloatArray:
        """The value at each probability in [0, 1)."""
        ends = [math.log(end) if end > 0.0 else -math.inf for end in (self.low, self.high)]
        logarithm = Normal(math.log(self.median), self.log_deviation, *ends)
        return np.clip(np.exp(logarithm.quantile(probability)), self.low, self.high)


Variation = Levels | Uniform | LogUniform | Normal | LogNormal
