"""Columns of a file by what they hold, in SI units."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from pyjoystick.motion.records.csv_file import CsvFile, Heading
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import FloatArray


def find_column(file: CsvFile, quantity: str, wanted: str, *, required: bool) -> Heading | None:
    """The column whose heading is `wanted`, with its unit or without; None where it may be missing and is.

    Raises:
        RecordError: several columns have that heading, or none and it is required
    """
    candidates = [
        heading
        for heading in file.headings
        if wanted.casefold() in (heading.text.casefold(), heading.name.casefold())
    ]
    if len(candidates) == 1:
        return candidates[0]
    texts = ", ".join(repr(heading.text) for heading in file.headings)
    if candidates:
        advice = f"say which one is meant by its whole heading; there are {texts}"
        raise RecordError(str(file.path), f"has {len(candidates)} columns {wanted!r}", advice)
    if required:
        advice = f"name the column of {quantity}; there are {texts}"
        if len(file.headings) == 1:
            advice = f"separate the columns by commas, semicolons or tabs; the heading is {texts}"
        raise RecordError(str(file.path), f"has no column {wanted!r}", advice)
    return None


def unit_factor(file: CsvFile, heading: Heading, factors: Mapping[str, float], given: str) -> float:
    """What turns a column into SI units.

    Args:
        file: the file
        heading: of the column
        factors: to SI units, by unit
        given: unit of a column that has none in its heading, or an empty string

    Raises:
        RecordError: there is no unit, an unknown one, or another one than is given
    """
    known = ", ".join(factors)
    if heading.unit and given and heading.unit != given:
        reason = f"has the unit {heading.unit} in its heading, but {given} is asked for"
        raise RecordError(str(file.path), reason, "leave one of the two out", column=heading.text)
    unit = heading.unit or given
    if not unit:
        advice = f"write it in the heading or give it as an option: {known}"
        raise RecordError(str(file.path), "has no unit", advice, column=heading.text)
    if unit not in factors:
        raise RecordError(
            str(file.path), "has an unknown unit", f"known are {known}", column=heading.text, value=unit
        )
    return factors[unit]


def finite_numbers(file: CsvFile, heading: Heading, advice: str) -> FloatArray:
    """The numbers of a column, none of them missing.

    Raises:
        RecordError: a cell is empty, no number or not finite
    """
    numbers = file.numbers(heading)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if bad.size:
        raise RecordError(
            str(file.path),
            "samples without a finite number",
            advice,
            column=heading.text,
            rows=file.lines[bad].tolist(),
            value=file.cells[bad[0]][file.headings.index(heading)] or "nothing",
        )
    return numbers
