"""Inputs of a run: constants, or series that are piecewise linear and may jump."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Union

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.values import REALS, Value, checked_value, limits, require_one_name, require_scalar
from pyjoystick.support import (
    FloatArray,
    ParameterError,
    SeriesError,
    UnknownInputError,
    real_numbers,
    type_text,
)

if TYPE_CHECKING:
    import pandas as pd

#: Largest relative difference of the lengths of steps that count as equal: times in files are rounded.
EQUAL_STEPS: Final = 1e-3
ONE_STEP_LENGTH: Final = "{} takes communication steps of one length only, as its description says"

#: Constants by name of the input, or a table indexed by time (s) with one column per input. Between rows,
#: continuous inputs are linear and others keep their value; before the first and after the last row, all
#: are constant. Two rows with the same time are a jump to the second. If `attrs["units"]` of the table gives
#: a column a unit, it must be that of the input, and s for the index.
Inputs = Union[Mapping[str, Value], "pd.DataFrame"]  # `|` does not accept forward references
_INDEX: Final = "index of the inputs"
#: Words in the name of an index that is no time in s.
_NOT_SECONDS: Final = re.compile(
    r"(?<![a-z])(?:[pnmµμu]s|[mn]secs?|(?:milli|mi[ck]ro|nano)se[ck](?:onds?|unden?|s)?|millis|"
    r"min(?:ute[ns]?|s)?|h(?:(?:ou)?rs?)?|stunden?|d(?:ays?)?|tage?|samples?|frames?|ticks?|zeilen?)(?![a-z])"
)
#: What may stand in brackets after a name.
_SECONDS: Final = frozenset({"s", "sec", "secs", "second", "seconds", "sekunde", "sekunden"})


@dataclass(frozen=True, slots=True, eq=False)
class InputSeries:
    """One input at the communication points t[0] .. t[n-1].

    Attributes:
        variable: the input
        values: its value at t[k] and just after, shape (n,), integers and text as given
        slopes: its derivative from t[k] to t[k+1], shape (n - 1,)
    """

    variable: Variable
    values: NDArray[Any]
    slopes: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class InputTable:
    """Checked inputs.

    Attributes:
        time: s, shape (n,), nondecreasing
        columns: values over time by name of the input, shape (n,), as given
    """

    time: FloatArray
    columns: Mapping[str, NDArray[Any]]


def checked_inputs(description: FmuDescription, inputs: Inputs) -> InputTable:
    """Check inputs and return them as columns of finite values.

    Raises:
        UnknownInputError: the FMU has no input of that name
        ParameterError: the inputs are neither a mapping nor a table; the table is empty, or has an input
            twice or in another unit, or its time is not in s; two names are those of one input; a value is of
            the wrong type, NaN or out of range
        SeriesError: the index of the table is not a time in s, not finite or decreases
    """
    if isinstance(inputs, Mapping):
        _require_known(description, inputs)
        index: Any = np.zeros(1)
        columns: dict[str, Any] = {name: _constant(name, value) for name, value in inputs.items()}
    else:
        _require_table(inputs)
        _require_known(description, inputs.columns)
        _require_units(description, inputs)
        index, columns = _seconds(inputs.index), {str(name): inputs[name] for name in inputs}
    for name, column in columns.items():
        variable = description.variables[name]
        require_scalar(variable)
        for value in _doubtful(variable, column):
            checked_value(variable, value)
    try:
        time = real_numbers(index)
    except (TypeError, ValueError) as error:
        raise SeriesError(_INDEX, "must be time in s") from error
    for i in np.flatnonzero(~np.isfinite(time) | (np.diff(time, prepend=-np.inf) < 0.0))[:1]:
        raise SeriesError(_INDEX, f"is {time[i]} at row {i}; must be finite and not fall")
    return InputTable(time, {name: np.asarray(column) for name, column in columns.items()})


def checked_constants(description: FmuDescription, inputs: Mapping[str, Value]) -> dict[str, Value]:
    """Constant inputs, each in the type of its variable.

    Raises:
        UnknownInputError: the FMU has no input of that name
        ParameterError: the inputs are not a mapping; a value is of the wrong type, NaN or out of range
    """
    if not isinstance(inputs, Mapping):
        raise ParameterError("inputs", type_text(inputs), "a mapping from names to constants")
    checked_inputs(description, inputs)
    return {name: checked_value(description.variables[name], value) for name, value in inputs.items()}


def _require_known(description: FmuDescription, given: Iterable[object]) -> None:
    """Reject names of no input, and a second name of one."""
    names = tuple(map(str, given))
    for name in names:
        variable = description.variables.get(name)
        if variable is None or variable.causality != "input":
            raise UnknownInputError(name, description.names("input"))
    require_one_name(description, "inputs", names)


def _require_table(inputs: object) -> None:
    """Reject anything but a table, and tables without rows or with duplicate columns."""
    import pandas as pd

    if not isinstance(inputs, pd.DataFrame):
        allowed = "a mapping from names to constants, or a pandas DataFrame of inputs indexed by time in s"
        raise ParameterError("inputs", type_text(inputs), allowed)
    for name in inputs.columns[inputs.columns.duplicated()][:1]:
        raise ParameterError("inputs", f"the columns {', '.join(map(str, inputs))}", f"one column for {name}")
    if inputs.empty and len(inputs.columns):
        raise ParameterError("inputs", "an empty table", "at least one row")


def _require_units(description: FmuDescription, inputs: pd.DataFrame) -> None:
    """Reject columns in another unit than their input's, and an index that is not in s."""
    units = inputs.attrs.get("units") or {}
    if not isinstance(units, Mapping):
        raise ParameterError('attrs["units"]', type_text(units), "a mapping from names to units")
    time = inputs.index.name or "time"
    if units.get(time, "s") != "s":
        raise ParameterError(f"unit of {time}", units[time], "s")
    word = str(time).lower()
    in_brackets, elsewhere = re.search(r"[(\[]\s*([^)\]]*?)\s*[)\]]", word), _NOT_SECONDS.search(word)
    unit = in_brackets[1] if in_brackets else elsewhere[0] if elsewhere else "s"
    if unit not in _SECONDS:
        raise SeriesError(_INDEX, f"is named {time!r}; must be time in s, not {unit}")
    for name in inputs.columns:
        wanted = description.variables[name].unit
        if wanted and units.get(name, wanted) != wanted:
            raise ParameterError(f"unit of {name}", units[name], wanted)


def _seconds(index: pd.Index[Any]) -> pd.Index[Any]:
    """The index as seconds; rejects row counts, dates and durations, which would be different times."""
    import pandas as pd

    # Row numbers stay integers even if rows were dropped.
    if index.inferred_type == "integer" and index.name is None and len(index) > 1:
        problem = "has whole numbers and no name, as one that counts the rows; must be time in s"
        raise SeriesError(
            _INDEX, f'{problem}: DataFrame(..., index=time); name the index "time" if these are seconds'
        )
    since_first = "(index - index[0]).total_seconds()"
    for kind, seconds in (
        (pd.TimedeltaIndex, "index.total_seconds()"),
        (pd.DatetimeIndex, since_first),
        (pd.PeriodIndex, f"index = index.to_timestamp(), then {since_first}"),
    ):
        if isinstance(index, kind):
            raise SeriesError(_INDEX, f"is a {kind.__name__}; must be time in s, as numbers: {seconds}")
    return index


def _doubtful(variable: Variable, column: pd.Series[Any] | NDArray[Any]) -> Iterable[object]:
    """Values that may not be allowed: for floats of a real input, those out of range; otherwise all."""
    if variable.type not in REALS or column.dtype != np.float64:
        return column.tolist()
    low, high = limits(variable)
    values = np.asarray(column)
    return values[~((values >= low) & (values <= high))]


def _constant(name: str, value: object) -> NDArray[Any]:
    """A single row, for an input that is constant during the run."""
    if not np.isscalar(value):
        allowed = "a number; a table (pandas DataFrame indexed by time in s) gives values that change"
        raise ParameterError(name, type_text(value), allowed)
    return np.array([value], dtype=object if isinstance(value, str) else None)


def communication_points(description: FmuDescription, instants: FloatArray, table: InputTable) -> FloatArray:
    """The output times and, between them, the times at which the inputs have a kink or a jump.

    Only the output times, which must be equally spaced, for an FMU that takes steps of one length only.
    """
    if not description.variable_steps:
        steps = np.diff(instants)
        if steps.max() - steps.min() > EQUAL_STEPS * steps.max():
            given = f"steps of {steps.min():.6g} s to {steps.max():.6g} s"
            raise ParameterError(
                "time", given, "equally spaced", ONE_STEP_LENGTH.format(description.path.name)
            )
        return instants
    inner = table.time[(table.time > instants[0]) & (table.time < instants[-1])]
    return np.union1d(instants, inner) if inner.size else instants


def input_series(description: FmuDescription, table: InputTable, points: FloatArray) -> list[InputSeries]:
    """All inputs of the table at the communication points, shape (n,), n >= 2."""
    time = table.time
    series = []
    for name, column in table.columns.items():
        variable = description.variables[name]
        after: NDArray[Any]
        if variable.type in REALS and variable.variability == "continuous":
            samples = column.astype(np.float64)
            after = _limit(time, samples, points, np.searchsorted(time, points, side="right"))
            before = _limit(time, samples, points, np.searchsorted(time, points, side="left"))
            slopes = (before[1:] - after[:-1]) / np.diff(points)
        else:
            last = np.searchsorted(time, points, side="right") - 1
            after, slopes = column[np.maximum(last, 0)], np.zeros(len(points) - 1)
        series.append(InputSeries(variable, after, slopes))
    return series


def _limit(
    time: FloatArray,
    samples: FloatArray,
    points: FloatArray,
    following: NDArray[np.intp],
) -> FloatArray:
    """Linear interpolation between `following` and the row before it, constant beyond both ends."""
    right = np.clip(following, 0, len(time) - 1)
    left = np.clip(following - 1, 0, len(time) - 1)
    span = time[right] - time[left]
    part = np.divide(points - time[left], span, out=np.zeros_like(points), where=span > 0.0)
    return np.asarray(samples[left] + part * (samples[right] - samples[left]))
