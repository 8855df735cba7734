"""How a parameter varies, as the settings file says it."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from pyjoystick.fmu import FmuDescription, Variable, checked_varied
from pyjoystick.runs.sweeps.amounts import REALS, difference_of, number_of, value_of
from pyjoystick.runs.sweeps.variations import Levels, LogNormal, LogUniform, Normal, Uniform, Variation
from pyjoystick.support import ParameterError, PyJoystickError, Table

_DISTRIBUTIONS: Final = ("uniform", "loguniform", "normal", "lognormal")
_FORMS: Final = "values = [...], or from, to and count, or distribution = ..."


def read_variation(table: Table, name: str, fmu: FmuDescription) -> Variation:
    """One table [vary.name].

    Raises:
        SettingsError: the FMU has no such parameter, or the table is not as docs/sweeps.md says
    """
    try:
        (variable,) = checked_varied(fmu, [name], {})
    except ParameterError as error:
        raise table.error("", "is not a parameter or start value that can be varied", error.hint) from error
    except PyJoystickError as error:
        raise table.refused("", error) from error
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
    table.finish()
    return variation


def _values(table: Table, variable: Variable) -> Levels:
    values = []
    for given in table.entries("values"):
        try:
            values.append(value_of(variable, given))
        except ParameterError as error:
            raise table.refused("values", error) from error
    if len(set(values)) < len(values):
        raise table.error("values", "must not repeat a value")
    return Levels(tuple(values))


def _range(table: Table, variable: Variable) -> Levels:
    first, last = _number(table, "from", variable), _number(table, "to", variable)
    count = table.integer("count", 2)
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
    if deviation <= 0.0:
        raise table.error("log_deviation", "must be above 0")
    return LogNormal(median, deviation, max(low, 0.0), high)


def _ends(table: Table, variable: Variable) -> tuple[float, float]:
    low, high = _number(table, "low", variable), _number(table, "high", variable)
    if low >= high:
        raise table.error("high", f"must be above low, {low:g} {variable.unit}".rstrip())
    return low, high


def _truncation(table: Table, variable: Variable) -> tuple[float, float]:
    """The ends given or, where not, those of the FMU's range."""
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    if table.optional("low") is not None:
        low = _number(table, "low", variable)
    if table.optional("high") is not None:
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
    try:
        return number_of(variable, table.value(key))
    except ParameterError as error:
        raise table.refused(key, error) from error


def _deviation(table: Table, variable: Variable) -> float:
    try:
        return difference_of(variable, table.value("deviation"))
    except ParameterError as error:
        raise table.refused("deviation", error) from error
