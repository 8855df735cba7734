"""Series of an FMU's variables in CSV files: inputs of a run, and records of its outputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.values import INTEGERS
from pyjoystick.motion import (
    TIME,
    UNITS,
    Column,
    Heading,
    Match,
    RecordError,
    TableFile,
    read_log_table,
    read_table_file,
    time_heading,
    understood,
)
from pyjoystick.support import FloatArray, UnknownInputError

_TIME: Final = replace(TIME, default_unit="s")
#: Minimum distance of two different times (s); below it, the slope between them would overflow.
_CLOSEST: Final = 1e-12
_TRUTH: Final = {"true": True, "false": False}


def read_inputs(path: str | PathLike[str], fmu: FmuDescription) -> pd.DataFrame:
    """Read inputs over time as a table for `Fmu.run`.

    The first column is the time, in s if its heading has no unit or is empty; the others are as in
    `read_variables`. A column without a heading and cells, as of a comma at the end of every line, is left
    out.

    Raises:
        RecordError: the file is not a table, its first column is no time, two columns are the same input, a
            unit is unknown, a cell is not a finite number, the time runs backward, more than two rows have
            one time, or two different times are less than 1e-12 s apart
        UnknownInputError: a column does not have the name of an input
    """
    file = _with_time_first(read_table_file(Path(path)))
    first, *others = file.head.headings
    others = [one for one in others if one.text or any(file.texts(one))]
    known = fmu.names("input")
    texts: dict[str, str] = {}
    for heading in others:
        # The name of an array element, u[1], looks like a name with a unit.
        name = heading.text if heading.text in known else heading.name
        if name not in known:
            raise UnknownInputError(name, known)
        if name in texts:
            reason = f"has two columns for the input {name}: {texts[name]!r} and {heading.text!r}"
            raise RecordError(str(path), reason, "delete one of them", rows=[file.head.line])
        texts[name] = heading.text
    columns = [_column(fmu.variables[name]) for name in texts]
    found = file.head.match([_TIME, *columns], headings={"time": first.text} | texts)
    table = _table(file, found, fmu)
    steps = np.diff(table.index)
    backward = np.flatnonzero(steps < 0.0)
    if backward.size:
        reason, advice = "the time runs backward", "keep one record a file, its rows in order"
        raise RecordError(str(path), reason, advice, column=first.text, rows=file.rows[backward + 1])
    close = np.flatnonzero((steps > 0.0) & (steps < _CLOSEST))
    if close.size:
        reason, advice = (
            f"two times are less than {_CLOSEST:g} s apart",
            "write a jump as two rows of one time",
        )
        raise RecordError(str(path), reason, advice, column=first.text, rows=file.rows[close + 1])
    thrice = np.flatnonzero((steps[:-1] == 0.0) & (steps[1:] == 0.0))
    if thrice.size:
        reason, advice = "more than two rows have one time", "write a jump as two rows of one time"
        raise RecordError(str(path), reason, advice, column=first.text, rows=file.rows[thrice + 2])
    return table


def _with_time_first(file: TableFile) -> TableFile:
    """The table with the unit of the first heading, which must be a time, understood as that of a log."""
    first, *others = file.head.headings
    if not first.text and _counts_rows(file.numbers(first)):
        reason, advice = (
            "the first column counts the rows and has no name",
            "name it 'time (s)' if these are seconds",
        )
        raise RecordError(str(file.head.path), reason, advice, rows=[file.head.line])
    time = time_heading(first.text) if first.text else Heading("", "time", "")
    if time is None:
        reason, advice = "the first column must be the time", "name it 'time (s)'"
        raise RecordError(str(file.head.path), reason, advice, column=first.text)
    return replace(file, head=replace(file.head, headings=(time, *map(_spelled, others))))


def _spelled(heading: Heading) -> Heading:
    """The heading with the usual spelling of its unit, as N.m for Nm."""
    known = understood(heading.text)
    return replace(heading, unit=known.unit) if heading.unit and known.name == heading.name else heading


def _counts_rows(numbers: FloatArray) -> bool:
    return len(numbers) > 2 and float(numbers[0]).is_integer() and bool((np.diff(numbers) == 1.0).all())


def read_variables(path: str | PathLike[str], fmu: FmuDescription, names: Sequence[str]) -> pd.DataFrame:
    """Read a record of variables as a table indexed by time (s), with columns in the units of the FMU.

    The columns are ``time (s)`` and ``name (unit)``. The unit is the variable's own or its display unit in
    the FMU; a heading without a unit means the variable's own.

    Raises:
        RecordError: the file is not a table, a column is missing, its unit is unknown, a cell is not a finite
            number, or the time does not increase
    """
    log = read_log_table(path)
    file = log.file
    table = _table(file, log.find([_TIME, *(_column(fmu.variables[name]) for name in names)]), fmu)
    backward = np.flatnonzero(np.diff(table.index) <= 0.0)
    if backward.size:
        advice = "keep one record a file, its samples in order"
        rows = file.rows[backward + 1]
        raise RecordError(str(path), "the time does not increase", advice, column="time", rows=rows)
    return table


def _column(variable: Variable) -> Column:
    """The variable in its own unit, its display unit, or another of `UNITS` of its kind."""
    alike = next((units for units in UNITS.values() if variable.unit in units), {})
    units = {variable.unit: 1.0} | {unit: factor / alike[variable.unit] for unit, factor in alike.items()}
    display = variable.display_unit
    if display:
        units[display.unit] = 1.0 / display.factor
    return Column(variable.name, units, default_unit=variable.unit)


def _table(file: TableFile, found: Mapping[str, Match], fmu: FmuDescription) -> pd.DataFrame:
    """The columns in the types and units of their variables, over time (s)."""
    columns = dict(found)
    time = columns.pop("time")
    return pd.DataFrame(
        {name: _values(file, match, fmu.variables[name]) for name, match in columns.items()},
        index=pd.Index(file.finite_numbers(time.heading, time.column.advice) * time.factor, name="time"),
    )


def _values(file: TableFile, match: Match, variable: Variable) -> NDArray[Any]:
    if variable.type == "Boolean":
        cells = [cell.casefold() for cell in file.texts(match.heading)]
        if all(cell in _TRUTH for cell in cells):
            return np.array([_TRUTH[cell] for cell in cells])
    numbers = file.finite_numbers(match.heading, match.column.advice)
    if variable.type in INTEGERS:
        # Parse the text, because integers beyond 2^53 are not exact as floats.
        written = [Decimal(cell) for cell in file.with_points(match.heading)]
        if all(one == one.to_integral_value() for one in written):
            return pd.Series([int(one) for one in written]).to_numpy()
    display = variable.display_unit
    if display is not None and match.unit == display.unit != variable.unit:
        return np.asarray((numbers - display.offset) / display.factor)
    return np.asarray(numbers * match.factor)
