"""Records of any FMU's variables: CSV files whose headings are their names and units."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyjoystick.fmu import FmuDescription
from pyjoystick.identification.fitting.measurement import Measurement
from pyjoystick.motion import CsvFile, Heading, RecordError, read_csv_file
from pyjoystick.support import FloatArray


def read_table_record(path: Path, names: Sequence[str], fmu: FmuDescription) -> Measurement:
    """Read columns by the names of the FMU's variables.

    The columns are ``time (s)`` and ``name (unit)``, the unit being the variable's own or the one that the
    FMU proposes for display; without a unit it is the variable's own.

    Raises:
        RecordError: the file cannot be read, a column is missing, its unit is not known, a cell is no finite
            number, or the time does not increase
    """
    file = read_csv_file(path)
    time = _numbers(file, _column(file, "time"), 1.0, 0.0)
    backward = np.flatnonzero(np.diff(time) <= 0.0)
    if backward.size:
        advice = "one record a file, its samples in order"
        raise RecordError(
            str(path), "time does not increase", advice, column="time", rows=file.lines[backward + 1]
        )
    columns = {}
    for name in names:
        heading = _column(file, name)
        variable = fmu.variables[name]
        display = variable.display_unit
        factor, offset = 1.0, 0.0
        if heading.unit not in ("", variable.unit):
            if display is None or heading.unit != display.unit:
                known = " or ".join(filter(None, (variable.unit, display.unit if display else "")))
                raise RecordError(
                    str(path),
                    "has another unit than the variable of the FMU",
                    f"known are {known}",
                    column=heading.text,
                )
            factor, offset = display.factor, display.offset
        columns[name] = _numbers(file, heading, factor, offset)
    return Measurement(path.stem, time, columns)


def _column(file: CsvFile, name: str) -> Heading:
    found = [heading for heading in file.headings if heading.name == name]
    if len(found) != 1:
        texts = ", ".join(repr(heading.text) for heading in file.headings)
        raise RecordError(
            str(file.path), f"has {len(found)} columns {name!r}", f"one is needed; there are {texts}"
        )
    return found[0]


def _numbers(file: CsvFile, heading: Heading, factor: float, offset: float) -> FloatArray:
    values = file.numbers(heading)
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        advice = "leave these rows out"
        raise RecordError(
            str(file.path),
            "samples without a finite number",
            advice,
            column=heading.text,
            rows=file.lines[bad],
        )
    return np.asarray((values - offset) / factor)
