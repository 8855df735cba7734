"""Checks of what a run is given: parameters and names of variables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from numbers import Integral, Real

import numpy as np

from pyjoystick.errors import ParameterError, UnknownParameterError, UnknownVariableError
from pyjoystick.fmu.description import FmuDescription, Variable

#: What a variable of an FMU may be set to.
Value = float | bool | str

_INTEGERS = ("Integer", "Enumeration")


def checked_parameters(description: FmuDescription, parameters: Mapping[str, Value]) -> dict[str, Value]:
    """The parameters with their values in the type of each variable.

    Raises:
        UnknownParameterError: the FMU has no variable of that name
        ParameterError: the variable cannot be set, or its value is of the wrong type, NaN or out of range
    """
    checked: dict[str, Value] = {}
    for name, value in parameters.items():
        variable = description.variables.get(name)
        if variable is None:
            raise UnknownParameterError(name, description.settable_names())
        if not variable.settable_at_start:
            kind = (
                "calculated parameter" if variable.causality == "calculatedParameter" else variable.causality
            )
            hint = "give it as an input" if kind == "input" else f"it is a variable of kind {kind}"
            raise ParameterError(name, value, "left out of the parameters", hint)
        checked[name] = checked_value(variable, value)
    return checked


def checked_value(variable: Variable, value: object) -> Value:
    """`value` in the type of the variable; raises ParameterError as `checked_parameters`."""
    if variable.type == "Boolean":
        if isinstance(value, bool | np.bool_):
            return bool(value)
        raise ParameterError(variable.name, value, "True or False")
    if variable.type == "String":
        if isinstance(value, str):
            return value
        raise ParameterError(variable.name, value, "text")
    kind = Integral if variable.type in _INTEGERS else Real
    if isinstance(value, bool | np.bool_) or not isinstance(value, kind) or not math.isfinite(value):
        raise ParameterError(variable.name, value, allowed_values(variable))
    number = int(value) if isinstance(value, Integral) else float(value)
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    if not low <= number <= high:
        raise ParameterError(variable.name, value, allowed_values(variable))
    return number if variable.type in _INTEGERS else float(number)


def allowed_values(variable: Variable) -> str:
    """The range of a number in words, with the unit."""
    number = "an integer" if variable.type in _INTEGERS else "a finite number"
    unit = f" {variable.unit}" if variable.unit else ""
    if variable.must_be_positive and variable.maximum is None:
        return f"{number} above 0{unit} (at least {variable.minimum:g})"
    if variable.minimum is not None and variable.maximum is not None:
        return f"{number} from {variable.minimum:g} to {variable.maximum:g}{unit}"
    if variable.minimum is not None:
        return f"{number}, {variable.minimum:g}{unit} or more"
    if variable.maximum is not None:
        return f"{number}, {variable.maximum:g}{unit} or less"
    return f"{number} in{unit}" if unit else number


def checked_outputs(description: FmuDescription, outputs: Iterable[str] | None) -> list[Variable]:
    """The variables to record, each once; None means every output of the FMU.

    Raises:
        UnknownVariableError: the FMU has no variable of that name
        ParameterError: the variable is text
    """
    if outputs is None:
        outputs = description.names("output")
    names = tuple(dict.fromkeys((outputs,) if isinstance(outputs, str) else outputs))
    known = [name for name, variable in description.variables.items() if variable.causality != "independent"]
    for name in names:
        if name not in known:
            raise UnknownVariableError(name, known)
        if description.variables[name].type == "String":
            raise ParameterError("outputs", name, "a number or Boolean variable")
    return [description.variables[name] for name in names]
