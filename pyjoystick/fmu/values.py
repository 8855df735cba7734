"""Checks of what a run is given: parameters, names of variables, and what varies from run to run."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from numbers import Integral, Real
from typing import Final

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.support import FloatArray, ParameterError, UnknownParameterError, UnknownVariableError

#: What a variable of an FMU may be set to.
Value = float | bool | str

#: Types of real numbers, of FMI 2 and 3.
REALS: Final = ("Real", "Float64", "Float32")
#: Types with whole numbers, of FMI 2 and 3.
INTEGERS: Final = (
    "Integer",
    "Enumeration",
    *(f"{sign}Int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "U")),
)
_STORED: Final = {"Integer": "int32", "Enumeration": "int32"}
_NOT_RUN: Final = ("Binary", "Clock")


def checked_parameters(description: FmuDescription, parameters: Mapping[str, Value]) -> dict[str, Value]:
    """The parameters with their values in the type of each variable.

    Raises:
        UnknownParameterError: the FMU has no variable of that name
        ParameterError: the variable cannot be set, or its value is of the wrong type, NaN or out of range
    """
    return {
        name: checked_value(_settable(description, name, value), value) for name, value in parameters.items()
    }


def checked_varied(
    description: FmuDescription, varied: Iterable[str], parameters: Mapping[str, Value]
) -> list[Variable]:
    """The variables that each run gives, beside the `parameters` that all runs share.

    Raises:
        UnknownParameterError: the FMU has no variable of that name
        ParameterError: the variable cannot be set, is text, or is given twice
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
    return variables


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
    """Raise ParameterError for what has no single value: arrays, clocks and binaries of FMI 3."""
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
        if isinstance(value, str):
            return value
        raise ParameterError(variable.name, value, "text")
    kind = Integral if variable.type in INTEGERS else Real
    if isinstance(value, bool | np.bool_) or not isinstance(value, kind) or not math.isfinite(value):
        raise ParameterError(variable.name, value, allowed_values(variable))
    number = int(value) if isinstance(value, Integral) else float(value)
    low, high = limits(variable)
    if not low <= number <= high:
        hint = f"its type is {variable.type}" if variable.type in INTEGERS else ""
        raise ParameterError(variable.name, value, allowed_values(variable), hint)
    return number if variable.type in INTEGERS else float(number)


def limits(variable: Variable) -> tuple[float, float]:
    """The least and the largest value of a number or a Boolean (0 and 1); of its type where not given."""
    if variable.type == "Boolean":
        return 0, 1
    low: float = -sys.float_info.max
    high: float = sys.float_info.max
    if variable.type in INTEGERS:
        stored = np.iinfo(_STORED.get(variable.type, variable.type.lower()))
        low, high = int(stored.min), int(stored.max)
    return (
        low if variable.minimum is None else max(low, variable.minimum),
        high if variable.maximum is None else min(high, variable.maximum),
    )


def allowed_values(variable: Variable) -> str:
    """The range of a number in words, with the unit."""
    number = "an integer" if variable.type in INTEGERS else "a finite number"
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
        require_scalar(description.variables[name])
    return [description.variables[name] for name in names]


class Varied:
    """The variables that each run gives, with what they may be.

    Attributes:
        variables: in the order of a row
        names: of the variables
    """

    def __init__(self, variables: Sequence[Variable]) -> None:
        self.variables = tuple(variables)
        self.names = tuple(variable.name for variable in variables)
        ranges = np.array([limits(variable) for variable in variables], dtype=np.float64).reshape(-1, 2)
        self._low, self._high = ranges.T
        self._whole = np.array([one.type in (*INTEGERS, "Boolean") for one in variables], dtype=np.bool_)

    def row(self, values: ArrayLike) -> FloatArray:
        """The values of one run, shape (1, variables); raises ParameterError as `table`."""
        row = _numbers(values)
        if row.shape != self._low.shape:
            wanted = f"of shape {self._low.shape}, for {', '.join(self.names) or 'no varied parameters'}"
            raise ParameterError("values", f"an array of shape {row.shape}", wanted)
        row = row.reshape(1, -1)
        sound = self._sound(row)
        if not sound.all():
            self._refuse(row, sound, "")
        return row

    def table(self, table: pd.DataFrame | ArrayLike) -> tuple[pd.DataFrame, FloatArray]:
        """The values of many runs, with names and as numbers, shape (runs, variables).

        Raises:
            ParameterError: the table has other columns, or a value is NaN, out of range, or no whole number
                or no 0 or 1 where it must be; the field is then ``name[row]``
        """
        named = self._named(table)
        numbers = _numbers(named)
        sound = self._sound(numbers)
        if not sound.all():
            self._refuse(numbers, sound, f"[{named.index[np.nonzero(~sound)[0][0]]}]")
        return named, numbers

    def _named(self, table: pd.DataFrame | ArrayLike) -> pd.DataFrame:
        if not isinstance(table, pd.DataFrame):
            numbers = _numbers(table)
            if numbers.ndim != 2 or numbers.shape[1] != len(self.names):
                wanted = f"of shape (runs, {len(self.names)}), for {', '.join(self.names)}"
                raise ParameterError("table", f"an array of shape {numbers.shape}", wanted)
            return pd.DataFrame(numbers, columns=list(self.names))
        if sorted(map(str, table.columns)) != sorted(self.names):
            has = ", ".join(map(str, table.columns)) or "none"
            raise ParameterError("table", f"the columns {has}", f"the varied: {', '.join(self.names)}")
        return table[list(self.names)]

    def _sound(self, numbers: FloatArray) -> np.typing.NDArray[np.bool_]:
        sound: np.typing.NDArray[np.bool_] = (numbers >= self._low) & (numbers <= self._high)
        if self._whole.any():
            sound &= ~self._whole | (numbers == np.floor(numbers))
        return sound

    def _refuse(self, numbers: FloatArray, sound: np.typing.NDArray[np.bool_], place: str) -> None:
        row, column = (int(places[0]) for places in np.nonzero(~sound))
        variable = self.variables[column]
        allowed = "0 or 1" if variable.type == "Boolean" else allowed_values(variable)
        raise ParameterError(f"{variable.name}{place}", numbers[row, column], allowed)


def _numbers(values: pd.DataFrame | ArrayLike) -> FloatArray:
    try:
        return np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError("values", f"a {type(values).__name__}", "made of numbers in rows") from None
