"""Checks of the parameters and variable names given to a run."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from numbers import Integral, Real
from typing import Final

import numpy as np

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.support import ParameterError, UnknownParameterError, UnknownVariableError, type_text

#: Values to which a variable of an FMU can be set.
Value = float | bool | str

#: Real types of FMI 2 and 3.
REALS: Final = ("Real", "Float64", "Float32")
#: Integer types of FMI 2 and 3.
INTEGERS: Final = (
    "Integer",
    "Enumeration",
    *(f"{sign}Int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "U")),
)
#: Types of numbers.
NUMBERS: Final = ("Real", "Float64", "Float32", *INTEGERS)
_NOT_RUN: Final = ("Binary", "Clock")
#: Floats represent all integers up to this.
EXACT: Final = 2**53


def checked_parameters(description: FmuDescription, parameters: Mapping[str, Value]) -> dict[str, Value]:
    """Check parameters; returns their values in the type of each variable.

    Raises:
        UnknownParameterError: the FMU has no variable of that name
        ParameterError: the parameters are not a mapping; a variable cannot be set, or its value is of the
            wrong type, NaN or out of range; or two are names of one variable
    """
    if not callable(getattr(parameters, "items", None)):  # also accepts a row of a pandas table
        raise ParameterError("parameters", type_text(parameters), "a mapping from names to values")
    values = {
        name: checked_value(_settable(description, name, value), value) for name, value in parameters.items()
    }
    require_one_name(description, "parameters", values)
    return values


def checked_varied(
    description: FmuDescription, varied: Iterable[str], parameters: Mapping[str, Value]
) -> list[Variable]:
    """Check the names of variables that differ between runs, given the `parameters` that all runs share.

    Raises:
        UnknownParameterError: the FMU has no variable of that name
        ParameterError: the variable cannot be set, is text, or is given twice, also by another of its names
    """
    names = (varied,) if isinstance(varied, str) else tuple(varied)
    variables = []
    for i, name in enumerate(names):
        variable = _settable(description, name, "varied")
        if variable.type == "String":
            raise ParameterError("varied", name, "a number or Boolean variable")
        if name in names[:i] or name in parameters:
            raise ParameterError("varied", name, "given once, either varied or as a parameter of all runs")
        variables.append(variable)
    require_one_name(description, "varied", (*parameters.keys(), *names))
    return variables


def require_one_name(description: FmuDescription, field: str, names: Iterable[str]) -> None:
    """Raise ParameterError if two of these variables of the FMU are one: an alias and what it stands for."""
    found: dict[tuple[str, int], str] = {}
    for name in names:
        other = found.setdefault(description.variables[name].reference, name)
        if other != name:
            raise ParameterError(field, f"{other} and {name}", "given by one name", "they name one variable")


def _settable(description: FmuDescription, name: str, value: object) -> Variable:
    variable = description.variables.get(name)
    if variable is None:
        raise UnknownParameterError(name, description.settable_names())
    if not variable.settable_at_start:
        kind = "calculated parameter" if variable.causality == "calculatedParameter" else variable.causality
        hint = "give it as an input" if kind == "input" else f"it is a variable of kind {kind}"
        raise ParameterError(name, value, "left out of the parameters", hint)
    require_scalar(variable)
    return variable


def require_scalar(variable: Variable) -> None:
    """Raise ParameterError for variables without a single value: arrays, and FMI 3 clocks and binaries."""
    if variable.is_array or variable.type in _NOT_RUN:
        what = "an array" if variable.is_array else f"of type {variable.type}"
        raise ParameterError(variable.name, what, "a single number, Boolean or text")


def checked_value(variable: Variable, value: object) -> Value:
    """`value` in the type of the variable; raises ParameterError as `checked_parameters`."""
    if variable.type == "Boolean":
        if isinstance(value, bool | np.bool_):
            return bool(value)
        raise ParameterError(variable.name, value, "True or False")
    if variable.type == "String":
        if isinstance(value, str) and "\0" not in value:
            return value
        raise ParameterError(variable.name, repr(value), "text without null characters")
    kind = Integral if variable.type in INTEGERS else Real
    if isinstance(value, bool | np.bool_ | np.timedelta64) or not isinstance(value, kind):
        raise ParameterError(variable.name, value, allowed_values(variable))
    number = int(value) if isinstance(value, Integral) else float(value)
    low, high = limits(variable)
    if not low <= number <= high:  # NaN and infinities too
        hint = f"its type is {variable.type}" if variable.type in (*INTEGERS, "Float32") else ""
        raise ParameterError(variable.name, value, allowed_values(variable), hint)
    if variable.items and number not in variable.items:
        raise ParameterError(variable.name, value, f"one of {', '.join(map(str, variable.items))}")
    return number if variable.type in INTEGERS else float(number)


def whole_number_for(variable: Variable, value: float) -> int:
    """Convert a signal to the integer that it represents; raises ParameterError unless that is certain."""
    stored = np.iinfo(stored_type(variable))
    is_exact = isinstance(value, Integral | np.bool_) or (abs(value) <= EXACT and value == math.floor(value))
    if not is_exact or not stored.min <= value <= stored.max:
        hint = f"its type is {variable.type}; a float is exact up to 2^53"
        raise ParameterError(variable.name, value, allowed_values(variable), hint)
    return int(value)


def limits(variable: Variable) -> tuple[float, float]:
    """Smallest and largest value of a number or a Boolean (0 and 1); by default, those of its type."""
    if variable.type == "Boolean":
        return 0, 1
    low: float = -sys.float_info.max
    high: float = sys.float_info.max
    if variable.type in INTEGERS:
        stored = np.iinfo(stored_type(variable))
        low, high = int(stored.min), int(stored.max)
    elif variable.type == "Float32":
        low, high = float(np.finfo(np.float32).min), float(np.finfo(np.float32).max)
    return (
        low if variable.minimum is None else max(low, variable.minimum),
        high if variable.maximum is None else min(high, variable.maximum),
    )


def stored_type(variable: Variable) -> str:
    """Name of the NumPy type for the variable's integers."""
    if variable.type in ("Integer", "Enumeration"):
        return "int64" if variable.is_fmi3 else "int32"
    return variable.type.lower()


def allowed_values(variable: Variable) -> str:
    """The range of a number as text, with the unit."""
    number = "an integer" if variable.type in INTEGERS else "a finite number"
    unit = f" {variable.unit}" if variable.unit else ""
    if variable.must_be_positive and variable.maximum is None:
        return f"{number} above 0{unit} (at least {variable.minimum:g})"
    low, high = (_as_written(bound) for bound in (variable.minimum, variable.maximum))
    if low and high:
        return f"{number} from {low} to {high}{unit}"
    if low:
        return f"{number}, {low}{unit} or more"
    if high:
        return f"{number}, {high}{unit} or less"
    return f"{number} in{unit}" if unit else number


def _as_written(bound: float | None) -> str:
    return "" if bound is None else str(bound) if isinstance(bound, int) else f"{bound:g}"


def default_outputs(
    description: FmuDescription, *, texts: bool = False
) -> tuple[list[Variable], tuple[str, ...]]:
    """Outputs that can be recorded, with arrays as their elements, and the names of the others.

    Args:
        description: the FMU
        texts: whether text can be recorded
    """
    outputs = [description.variables[name] for name in description.names("output")]
    can_be = [one.type not in _NOT_RUN and (texts or one.type != "String") for one in outputs]
    recorded = [part for one, can in zip(outputs, can_be, strict=True) if can for part in one.elements()]
    return recorded, tuple(one.name for one, can in zip(outputs, can_be, strict=True) if not can)


def checked_outputs(
    description: FmuDescription, outputs: Iterable[str] | None, *, texts: bool = False
) -> list[Variable]:
    """Check the variables to record, without repeats; None means those of `default_outputs`.

    Arrays are given by element: ``x[1]``, ``grid[2,3]``.

    Raises:
        UnknownVariableError: the FMU has no variable of that name
        ParameterError: a name is no text; or the variable is a whole array, of a type that has no values, or
            text
    """
    if outputs is None:
        return default_outputs(description, texts=texts)[0]
    names = tuple(dict.fromkeys((outputs,) if isinstance(outputs, str) else outputs))
    for name in names:
        if not isinstance(name, str):
            raise ParameterError("outputs", type_text(name), "names of variables")
    parts: dict[str, Variable] = {}
    for name in names:
        if name not in parts:
            parts |= _parts(description, name, texts=texts)
    return [parts[name] for name in names]


def _parts(description: FmuDescription, name: str, *, texts: bool) -> dict[str, Variable]:
    """The variable of this name or, if it is an element of an array, all elements."""
    variables = description.variables
    whole = variables.get(name) or variables.get(name.rpartition("[")[0])
    parts = {part.name: part for part in whole.elements()} if whole else {}
    if whole is None or whole.causality == "independent" or name not in (whole.name, *parts):
        raise UnknownVariableError(name, [*(n for n, v in variables.items() if v.causality != "independent")])
    if whole.type in _NOT_RUN:
        require_scalar(replace(whole, is_array=False))
    if name not in parts:
        some = ", ".join([*list(parts)[:3], *["..."] * (len(parts) > 3)])
        raise ParameterError(name, "an array", f"recorded by its elements: {some or 'it has none'}")
    if whole.type == "String" and not texts:
        hint = "Fmu.run records text; plans, sweeps and Model Exchange do not"
        raise ParameterError("outputs", name, "a number or Boolean variable", hint)
    return parts
