"""Tables of runs: indexed by time, with one column per variable and units in ``DataFrame.attrs``.

``attrs["units"]`` has the unit of each column and of ``time`` by name, ``attrs["display_units"]`` a
dictionary ``{"unit", "factor", "offset"}`` for each column with a display unit (displayed value = factor *
value + offset), ``attrs["descriptions"]`` a line on each column.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.support import replacing

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, slots=True)
class DisplayUnit:
    """A unit for display: displayed value = `factor` * value + `offset`."""

    unit: str
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Quantity:
    """Description of a column; `unit` is empty for a pure number."""

    name: str
    unit: str = ""
    display_unit: DisplayUnit | None = None
    description: str = ""


def make_table(
    time: ArrayLike, columns: Mapping[str, ArrayLike], quantities: Iterable[Quantity]
) -> pd.DataFrame:
    """Make a table of the given columns over ``time`` (s), shape (n,) each, with units in its attrs."""
    import pandas as pd  # only for tables, which FMU processes do not make

    table = pd.DataFrame(dict(columns), index=pd.Index(np.asarray(time, dtype=np.float64), name="time"))
    described = {quantity.name: quantity for quantity in quantities}
    table.attrs["units"] = {"time": "s"} | {name: one.unit for name, one in described.items()}
    table.attrs["display_units"] = {
        name: asdict(one.display_unit) for name, one in described.items() if one.display_unit
    }
    table.attrs["descriptions"] = {name: one.description for name, one in described.items()}
    return table


def unit_of(table: pd.DataFrame, name: str) -> str:
    """Unit of a column or of ``time``; empty if the table has none."""
    return str(table.attrs.get("units", {}).get(name, ""))


def heading(table: pd.DataFrame, name: str) -> str:
    """Name and unit as in a CSV file: ``theta (rad)``, or the name alone for a pure number."""
    unit = unit_of(table, name)
    return f"{name} ({unit})" if unit else name


def write_csv(table: pd.DataFrame, path: str | PathLike[str]) -> None:
    """Write a table as CSV, atomically and with all digits.

    The headings are name and unit. Read it back with
    ``pandas.read_csv(path, index_col="time (s)")``.

    Raises:
        OutputFileError: the file cannot be written
    """
    headed = table.rename(columns={str(name): heading(table, str(name)) for name in table.columns})
    with replacing(path) as temporary:
        headed.to_csv(temporary, index_label=heading(table, "time"), lineterminator="\n", encoding="utf-8")
