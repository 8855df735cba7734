"""A laboratory's table in any file format, and where the columns that a reader needs are in it."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.motion.columns import Column, Heading, Match
from pyjoystick.motion.logs.headings import candidates, is_unit, kind_of, reading_unit, spelled
from pyjoystick.motion.logs.layout import Layout, Scale
from pyjoystick.motion.logs.sheets import form_of, load
from pyjoystick.motion.logs.text_files import (
    decoded,
    delimiter_name,
    find_in_rows,
    find_in_text,
    is_labview_measurement,
)
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.table_files import TableFile, read_table_file, table_of_text
from pyjoystick.motion.units import UNITS
from pyjoystick.support import FloatArray

_LOG = logging.getLogger(__name__)
#: Everything about the file is found out.
AUTOMATIC: Final = Layout()
#: Time between two samples (s) of an instrument that records a joystick.
_USUAL: Final = (1e-6, 0.1)
#: Quantities whose symbols mean other things too: without a unit they are left alone.
SYMBOLIC: Final = ("T", "F")


@dataclass(frozen=True, slots=True)
class LogTable:
    """A laboratory's table.

    Attributes:
        file: headings and cells, numbers with decimal points
        form: what the file is, in words
    """

    file: TableFile
    form: str

    def find(
        self,
        columns: Sequence[Column],
        *,
        headings: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
        scales: Mapping[str, Scale] | None = None,
        override: bool = False,
    ) -> dict[str, Match]:
        """Where columns are, by name; their headings may be in other languages.

        Args:
            columns: what is wanted
            headings: headings by name of the column, where they are others
            units: units by name of the column, where the headings have none or unknown ones
            scales: calibrations by name of the column, of readings in V, mV or counts
            override: whether `units` also replaces known units in headings, but for those of torque and
                force: a wrong factor of an angle or a time is seen, one of a torque is not

        Raises:
            RecordError: as `TableHead.match`; or more than one column or unit may be the one that is wanted
        """
        named, given, wanted = dict(headings or {}), dict(units or {}), []
        found = list(self.file.head.headings)
        for column in columns:
            if column.name in given:
                given[column.name] = spelled(kind_of(column), given[column.name]) or given[column.name]
            scale = (scales or {}).get(column.name)
            one = self._chosen(column, named, certain=bool(scale) or column.name in given)
            if one is not None:
                named[column.name] = one.text
                replaced = override and column.name not in SYMBOLIC
                drop = column.name in given and (replaced or not is_unit(one.unit))
                adapted = replace(one, unit="") if drop else one
                found[found.index(one)] = adapted
                if not scale and column.name not in given:
                    self._require_unit(column, adapted)
            elif not column.required and column.name in SYMBOLIC and kind_of(column):
                continue
            wanted.append(column if scale is None else _calibrated(column, scale))
        return replace(self.file.head, headings=tuple(found)).match(wanted, headings=named, units=given)

    def read(
        self,
        columns: Sequence[Column],
        *,
        headings: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> dict[str, FloatArray]:
        """Columns in SI units by name, shape (n,) each; optional ones that are missing are left out.

        Raises:
            RecordError: as `find`; or a cell is empty, not a number or not finite
        """
        return {
            name: self.file.finite_numbers(self.heading(match), match.column.advice) * match.factor
            for name, match in self.find(columns, headings=headings, units=units).items()
        }

    def heading(self, match: Match) -> Heading:
        """The heading of a match as it stands in the file."""
        return self.file.head.headings[match.index]

    def _chosen(self, column: Column, named: Mapping[str, str], *, certain: bool) -> Heading | None:
        """The heading of a column, None where there is none or what is given leads to none."""
        head = self.file.head
        if column.name in named:
            given = named[column.name]
            found = [one for one in head.headings if one.text == given] or head.named(given)
            return found[0] if len(found) == 1 else None
        found = candidates(column, head.headings)
        if kind_of(column) and column.name in SYMBOLIC and not certain:
            found = [one for one in found if spelled(kind_of(column), one.unit) or reading_unit(one.unit)]
        if len(found) > 1:
            options = " or ".join(f"--column {column.name}={one.text!r}" for one in found)
            same = len({one.name for one in found}) == 1
            reason = f"has {len(found)} columns " + (
                repr(found[0].name) if same else f"that may be {column.name}"
            )
            raise RecordError(
                str(head.path), reason, f"choose one: {options}", rows=[head.line] * bool(head.line)
            )
        return found[0] if found else None

    def _require_unit(self, column: Column, heading: Heading) -> None:
        """Raise where readings have no calibration, or the unit of the time is missing."""
        name, reading = column.name, reading_unit(heading.unit)
        if reading and kind_of(column):
            reason = f"holds readings in {heading.unit}"
            unit = next(iter(column.units))
            advice = f"say what one is: --scale {name}=NUMBER{unit}/{reading}, with --zero {name}=READING"
            raise RecordError(str(self.file.head.path), reason, advice, column=heading.text)
        if name == "time" and not heading.unit and "" not in column.units and not column.default_unit:
            steps = np.diff(self.file.numbers(heading))
            step = float(np.nanmedian(steps)) if np.isfinite(steps).any() else math.nan
            shortest, longest = _USUAL
            usual = {unit: factor for unit, factor in column.units.items() if factor <= 1.0}
            possible = [unit for unit, factor in usual.items() if shortest <= step * factor <= longest]
            reason = (
                f"has no unit; its steps of {step:.6g} can be {' or '.join(possible) or 'in no known unit'}"
            )
            example = " or ".join(f"--unit time={unit}" for unit in possible or usual)
            advice = f"say which: {example}; known are {', '.join(column.units)}"
            raise RecordError(str(self.file.head.path), reason, advice, column=heading.text)


def read_log_table(
    path: str | PathLike[str], layout: Layout = AUTOMATIC, *, numbered: bool = False
) -> LogTable:
    """Read a laboratory's table: text of any delimiter, XLSX, ODS, MATLAB or Parquet.

    Args:
        path: the file
        layout: its form, where that is to be given
        numbered: whether it may lack headings; the columns are then ``#1``, ``#2`` and so on

    Raises:
        RecordError: it cannot be read, holds no table, or can be understood in more than one way; the message
            says which option decides
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError:
        read_table_file(path)  # raises the error of a file that cannot be read
        raise
    form = form_of(path, data[:512])
    comments: tuple[str, ...] = ()
    if form:
        found, words = find_in_rows(path, *load(path, form, layout.sheet), layout), form
        if found is None:
            advice = "write one line of headings, with units, and one sample per row below it"
            raise RecordError(str(path), "holds no headings with two columns of numbers below", advice)
    else:
        text, encoding = decoded(path, data, layout.encoding)
        guessed = "probably " * (not layout.encoding and not encoding.startswith("utf"))
        found, comments = find_in_text(path, text, layout)
        if found is None and is_labview_measurement(text):
            advice = "save it with one column of times (X_Columns One), and tabs between the columns"
            raise RecordError(str(path), "holds no two columns of numbers below its headers", advice)
        if found is None:
            return LogTable(table_of_text(path, text), "text")  # says what is wrong with it
        mark = "comma" if found.decimal == "," else "point"
        words = f"text, {guessed}{encoding}, separated by {delimiter_name(found.delimiter)}, decimal {mark}"
    if not found.names and not numbered:
        raise RecordError(
            str(path),
            "has a number where a heading is expected",
            "begin with a line such as: time (s),theta (deg); or give the numbers of the columns: "
            "--column time=#1 --column theta=#2",
            rows=[found.rows[0][0]],
        )
    _LOG.info("read %s: %d rows (%s)", path, len(found.rows), words)
    return LogTable(found.table(path, comments), words)


def _calibrated(column: Column, scale: Scale) -> Column:
    """A column of readings, which the calibration turns into its quantity."""
    alike = next((units for units in (UNITS["voltage"],) if scale.reading in units), {scale.reading: 1.0})
    units = {unit: scale.factor * factor / alike[scale.reading] for unit, factor in alike.items()}
    return replace(column, units=units, default_unit=scale.reading)
