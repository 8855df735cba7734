"""Reading the file of a testing machine."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Final

from pyjoystick.laboratory.load_curve.curve import LoadCurve
from pyjoystick.motion import RecordError, find_column, finite_numbers, read_csv_file, unit_factor

#: Factors to SI units by quantity and unit.
UNITS: Final[Mapping[str, Mapping[str, float]]] = {
    "travel": {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6},
    "force": {"N": 1.0, "kN": 1e3, "mN": 1e-3},
}


def read_load_curve(
    path: str | PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
) -> LoadCurve:
    """Read one cycle of loading and perhaps unloading from a CSV file.

    The file has one line of headings, such as ``travel (mm);force (N)``, then one sample a row in the order
    in which they were taken; other columns are left alone.

    Args:
        path: the file, with columns separated by commas, semicolons or tabs and decimal points
        columns: headings where they are others: ``{"travel": "Extension", "force": "Load"}``
        units: units of columns without one in their heading; see `UNITS`

    Raises:
        RecordError: the file cannot be read, a column is missing, has no unit or an unknown one, a cell is no
            number, or the record is not one cycle; the message names file, column and rows and what to do
    """
    for given in {**(columns or {}), **(units or {})}:
        if given not in UNITS:
            raise RecordError("columns", f"{given!r} is no quantity", f"known are {', '.join(UNITS)}")
    file = read_csv_file(Path(path))
    series = {}
    for quantity, factors in UNITS.items():
        heading = find_column(file, quantity, (columns or {}).get(quantity, quantity), required=True)
        assert heading is not None
        factor = unit_factor(file, heading, factors, (units or {}).get(quantity, ""))
        series[quantity] = factor * finite_numbers(file, heading, "delete rows without numbers")
    return LoadCurve.from_cycle(series["travel"], series["force"], source=str(path), rows=file.lines)
