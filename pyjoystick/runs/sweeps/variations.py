"""Variation of a parameter: levels, or a distribution given by its quantile function."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import special

from pyjoystick.fmu import REALS, FmuDescription, Variable, checked_varied
from pyjoystick.runs.fmu_settings import difference_of, number_of, value_of
from pyjoystick.support import FloatArray, ParameterError, Table

_DISTRIBUTIONS: Final = ("uniform", "loguniform", "normal", "lognormal")
#: More runs, or more levels of one parameter, are taken for a mistake.
MOST_RUNS: Final = 10_000_000
_FORMS: Final = "values = [...], or from, to and count, or distribution = ..."

#: Open interval of probabilities for which every quantile is finite.
_SMALLEST: Final = 2.0**-54
#: Largest standard deviation of a logarithm.
_WIDEST: Final = 10.0


@dataclass(frozen=True, slots=True)
class Levels:
    """Given values: levels of a grid, or a choice with equal probabilities in sampled designs.

    Attributes:
        values: distinct levels, numbers or Booleans
    """

    values: tuple[Any, ...]

    def quantile(self, probability: FloatArray) -> NDArray[Any]:
        """Value at each probability in [0, 1), in the order of the levels."""
        index = np.minimum((probability * len(self.values)).astype(np.intp), len(self.values) - 1)
        # Unlike NumPy, pandas keeps large integers exact.
        return pd.Series(self.values).to_numpy()[index]


@dataclass(frozen=True, slots=True)
class Uniform:
    """Uniform density from `low` to `high`."""

    low: float
    high: float

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Value at each probability in [0, 1)."""
        return self.low + (self.high - self.low) * probability


@dataclass(frozen=True, slots=True)
class LogUniform:
    """Uniform density of the logarithm from `low` to `high`, both above zero."""

    low: float
    high: float

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Value at each probability in [0, 1)."""
        exponent = math.log(self.low) + math.log(self.high / self.low) * probability
        return np.clip(np.exp(exponent), self.low, self.high)


@dataclass(frozen=True, slots=True)
class Normal:
    """Normal distribution, truncated to `low` .. `high`, which may be infinite.

    `mean` and `deviation` are those before truncation; `mean` is between `low` and `high`.
    """

    mean: float
    deviation: float
    low: float = -math.inf
    high: float = math.inf

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Value at each probability in [0, 1)."""
        below, upto = (special.ndtr((end - self.mean) / self.deviation) for end in (self.low, self.high))
        inside = below + (upto - below) * np.clip(probability, _SMALLEST, 1.0 - _SMALLEST)
        return np.clip(self.mean + self.deviation * special.ndtri(inside), self.low, self.high)


@dataclass(frozen=True, slots=True)
class LogNormal:
    """Log-normal distribution, truncated to `low` .. `high`, with `low` zero or more.

    Attributes:
        median: before truncation, above zero and between `low` and `high`
        log_deviation: standard deviation of the natural logarithm; if small, the relative deviation
        low, high: limits; `high` may be infinite
    """

    median: float
    log_deviation: float
    low: float = 0.0
    high: float = math.inf

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Value at each probability in [0, 1)."""
        ends = [math.log(end) if end > 0.0 else -math.inf for end in (self.low, self.high)]
        logarithm = Normal(math.log(self.median), self.log_deviation, *ends)
        return np.clip(np.exp(logarithm.quantile(probability)), self.low, self.high)


Variation = Levels | Uniform | LogUniform | Normal | LogNormal


def read_variation(table: Table, name: str, fmu: FmuDescription) -> Variation:
    """Read one table [vary.name].

    Raises:
        SettingsError: the FMU has no such parameter, or the table does not conform to docs/sweeps.md
    """
    with table.at():
        try:
            (variable,) = checked_varied(fmu, [name], {})
        except ParameterError as error:
            raise table.error(
                "", "is not a parameter or start value that can be varied", error.hint
            ) from error
    if "values" in table:
        variation: Variation = _values(table, variable)
    elif variable.type not in REALS:
        raise table.error("", f"must have values = [...], as the variable is of type {variable.type}")
    elif "distribution" in table:
        variation = _distribution(table, variable)
    elif "from" in table or "to" in table:
        variation = _range(table, variable)
    else:
        raise table.error("", f"must have {_FORMS}")
    return variation


def _values(table: Table, variable: Variable) -> Levels:
    values = []
    for given in table.entries("values"):
        with table.at("values"):
            values.append(value_of(variable, given))
    if len(set(values)) < len(values):
        raise table.error("values", "must not repeat a value")
    return Levels(tuple(values))


def _range(table: Table, variable: Variable) -> Levels:
    first, last = _number(table, "from", variable), _number(table, "to", variable)
    count = table.integer("count", 2)
    if count > MOST_RUNS:
        raise table.error("count", f"must be {MOST_RUNS} at most")
    spacing = table.choice("spacing", ("linear", "log"), "linear")
    if first == last:
        raise table.error("to", "must differ from `from`")
    if spacing == "log" and not first * last > 0.0:
        raise table.error("spacing", "must be linear where `from` and `to` are not of one sign")
    space = np.linspace if spacing == "linear" else np.geomspace
    return Levels(tuple(space(first, last, count).tolist()))


def _distribution(table: Table, variable: Variable) -> Variation:
    distribution = table.choice("distribution", _DISTRIBUTIONS)
    if distribution == "uniform":
        return Uniform(*_ends(table, variable))
    if distribution == "loguniform":
        low, high = _ends(table, variable)
        if low <= 0.0:
            raise table.error("low", "must be above 0 for distribution loguniform")
        return LogUniform(low, high)
    low, high = _truncation(table, variable)
    if distribution == "normal":
        mean = _within(table, "mean", variable, low, high)
        return Normal(mean, _deviation(table, variable), low, high)
    median = _within(table, "median", variable, max(low, 0.0), high)
    if median <= 0.0:
        raise table.error("median", "must be above 0")
    deviation = table.number("log_deviation")
    if not 0.0 < deviation <= _WIDEST:
        allowed = f"must be above 0 and at most {_WIDEST:g}, a factor of {math.exp(_WIDEST):.2g}"
        raise table.error("log_deviation", allowed)
    return LogNormal(median, deviation, max(low, 0.0), high)


def _ends(table: Table, variable: Variable) -> tuple[float, float]:
    low, high = _number(table, "low", variable), _number(table, "high", variable)
    if low >= high:
        raise table.error("high", f"must be above low, {low:g} {variable.unit}".rstrip())
    return low, high


def _truncation(table: Table, variable: Variable) -> tuple[float, float]:
    """Given limits or, by default, those of the FMU's range."""
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    if "low" in table:
        low = _number(table, "low", variable)
    if "high" in table:
        high = _number(table, "high", variable)
    if low >= high:
        raise table.error("high", f"must be above low, {low:g} {variable.unit}".rstrip())
    return low, high


def _within(table: Table, key: str, variable: Variable, low: float, high: float) -> float:
    number = _number(table, key, variable)
    if not low <= number <= high:
        raise table.error(key, f"must lie from {low:g} to {high:g} {variable.unit}".rstrip())
    return number


def _number(table: Table, key: str, variable: Variable) -> float:
    with table.at(key):
        return number_of(variable, table.value(key))


def _deviation(table: Table, variable: Variable) -> float:
    with table.at("deviation"):
        return difference_of(variable, table.value("deviation"))
