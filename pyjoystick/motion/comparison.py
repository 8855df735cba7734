"""Differences between two tables of the same experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from pandas.api.types import is_integer_dtype, is_numeric_dtype

from pyjoystick.motion.tables import unit_of
from pyjoystick.support import ParameterError, SeriesError, UnknownVariableError, positive


@dataclass(frozen=True, slots=True)
class Difference:
    """The largest difference of one variable over a run.

    Attributes:
        variable: name of the column
        unit: its unit
        largest: largest absolute difference, in that unit; NaN if one of the tables contains NaN
        relative: the same relative to the reference's largest magnitude over the run (0 if both are zero)
        time: time at which it occurs (s)
        limit: largest allowed difference, in the unit; None if there is none
        parted_at: time at which the limit is first exceeded, or NaN first occurs (s); None if the limit is
            kept
    """

    variable: str
    unit: str
    largest: float
    relative: float
    time: float
    limit: float | None = None
    parted_at: float | None = None

    @property
    def within_limit(self) -> bool:
        """Whether the limit, if any, is kept and the difference is not NaN."""
        return self.limit is None or self.largest <= self.limit


def compare(
    table: pd.DataFrame, against: pd.DataFrame, *, limits: Mapping[str, float] | None = None
) -> list[Difference]:
    """Largest difference of each numeric variable that both tables have, in the order of the first.

    Args:
        table: a run, indexed by time (s)
        against: the reference at the same times
        limits: largest allowed absolute difference by name of the variable, in its unit

    Raises:
        SeriesError: the times of the tables differ by more than rounding
        UnknownVariableError: a limit is for a variable that the tables do not share
        ParameterError: a limit is not above zero, the units of a variable differ, or no variable is shared
    """
    limits = dict(limits or {})
    shared = [
        str(name) for name in table.columns if name in against.columns and is_numeric_dtype(table[name])
    ]
    for name, limit in limits.items():
        if name not in shared:
            raise UnknownVariableError(name, shared)
        positive(f"limit of {name}", limit, unit_of(table, name))
    if not shared:
        raise ParameterError(
            "columns", list(table.columns), f"some of {', '.join(map(str, against.columns))}"
        )
    time = table.index.to_numpy(dtype=np.float64)
    other = against.index.to_numpy(dtype=np.float64)
    if len(time) != len(other):
        raise SeriesError("time", f"has {len(time)} instants in one table and {len(other)} in the other")
    for i in np.flatnonzero(np.abs(time - other) > 1e-9 * np.maximum(1e-3, np.abs(other)))[:1]:
        raise SeriesError("time", f"is {time[i]} s in one table and {other[i]} s in the other at row {i}")
    return [_difference(table, against, name, limits.get(name)) for name in shared]


def within_limits(differences: Sequence[Difference]) -> bool:
    """Whether every limit is kept."""
    return all(difference.within_limit for difference in differences)


def _exact(column: pd.Series[Any]) -> NDArray[Any]:
    """The numbers as floats, or as Python integers where floats would not be exact."""
    return column.to_numpy(dtype=object if is_integer_dtype(column.dtype) else np.float64)


def _difference(table: pd.DataFrame, against: pd.DataFrame, name: str, limit: float | None) -> Difference:
    unit, other_unit = unit_of(table, name), unit_of(against, name)
    if unit and other_unit and unit != other_unit:
        raise ParameterError(f"unit of {name}", unit, other_unit)
    values, expected = _exact(table[name]), _exact(against[name])
    with np.errstate(invalid="ignore"):  # infinity minus infinity is NaN, which no limit allows
        distance = np.abs(values - expected).astype(np.float64)
    place = int(np.argmax(distance))  # the first NaN if there is one
    largest = float(distance[place])
    magnitude = float(np.max(np.abs(expected)))
    relative = largest / magnitude if magnitude > 0.0 else (0.0 if largest == 0.0 else np.inf)
    beyond = np.zeros(len(distance), dtype=np.bool_) if limit is None else ~(distance <= limit)
    parted_at = float(table.index[int(np.argmax(beyond))]) if beyond.any() else None
    return Difference(
        name, unit or other_unit, largest, relative, float(table.index[place]), limit, parted_at
    )
