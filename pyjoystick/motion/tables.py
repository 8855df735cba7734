"""Tables of a run: indexed by time, one column a variable, with the units kept in ``DataFrame.attrs``.

``attrs["units"]`` has the unit of each column and of ``time`` by name, ``attrs["display_units"]`` a
dictionary ``{"unit", "factor", "offset"}`` for each column that has a unit for people (value there = factor *
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
    """A unit for people: value in it = `factor` * value + `offset`."""

    unit: str
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a column holds; `unit` is empty for a pure number."""

    name: str
    unit: str = ""
    display_unit: DisplayUnit | None = None
    description: str = ""


def make_table(
    time: ArrayLike, columns: Mapping[str, ArrayLike], quantities: Iterable[Quantity]
) -> pd.DataFrame:
    """A table with the given columns over ``time`` (s), shape (n,) each, and the units in its attrs."""
    import pandas as pd  # for tables alone: the processes that run FMUs make none

    table = pd.DataFrame(dict(columns), index=pd.Index(np.asarray(time, dtype=np.float64), name="time"))
    described = {quantity.name: quantity for quantity in quantities}
    table.attrs["units"] = {"time": "s"} | {name: one.unit for name, one in described.items()}
    table.attrs["display_units"] = {
        name: asdict(one.display_unit) for name, one in described.items() if one.display_unit
    }
    table.attrs["descriptions"] = {name: one.description for name, one in described.items()}
    return table


def unit_of(table: pd.DataFrame, name: str) -> str:
    """The unit of a column or of ``time``; empty where the table has none."""
    return str(table.attrs.get("units", {}).get(name, ""))


def heading(table: pd.DataFrame, name: str) -> str:
    """Name and unit as in a CSV file: ``theta (rad)``, or the name alone for a pure number."""
    unit = unit_of(table, name)
    return f"{name} ({unit})" if unit else name


def write_csv(table: pd.DataFrame, path: str | PathLike[str]) -> None:
    """Write a table as CSV, whole or not at all; numbers have all their digits.

    The headings are name and unit. pandas reads it back by
    ``pandas.read_csv(path, index_col="time (s)")``.

    Raises:
        OutputFileError: the file cannot be written
    """
    headed = table.rename(columns={str(name): heading(table, str(name)) for name in table.columns})
    with replacing(path) as temporary:
        headed.to_csv(temporary, index_label=heading(table, "time"), lineterminator="\n", encoding="utf-8")
