"""Results of a run: the tables [[results]] of the settings file, and their columns."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from pyjoystick import fmu
from pyjoystick.fmu import FmuDescription, Peaks, Reduction, Variable, checked_outputs
from pyjoystick.runs.fmu_settings import difference_of
from pyjoystick.support import FloatArray, Table

if TYPE_CHECKING:
    import pandas as pd

_KINDS: Final[dict[str, Callable[[str], Reduction]]] = {
    "final": fmu.Final,
    "extremes": fmu.Extremes,
    "loss": fmu.Loss,
}
#: Columns of every result file, besides parameters and results.
COLUMNS: Final = ("run", "failed", "message")
_DEFAULT_PEAKS: Final = 5
_FEWEST_BETWEEN_PEAKS: Final = 5
_LIMITS: Final = ("minimum_height", "minimum_prominence")


def read_results(tables: Iterable[Table], description: FmuDescription) -> tuple[Reduction, ...]:
    """Read the tables [[results]].

    Raises:
        SettingsError: an unknown kind or variable, or the same result twice
    """
    results: list[Reduction] = []
    for table in tables:
        result = _result(table, description)
        if set(result.columns) & set(columns_of(results)):
            raise table.error("variable", "has a result of this kind already")
        results.append(result)
    return tuple(results)


def columns_of(results: Sequence[Reduction]) -> list[str]:
    """Names of the result columns."""
    return [column for result in results for column in result.columns]


def variables_of(results: Sequence[Reduction]) -> list[str]:
    """Names of the variables from which the results are computed."""
    names = [name for one in results for name in (one.variable, getattr(one, "derivative", None)) if name]
    return list(dict.fromkeys(names))


def coarse_peaks(table: pd.DataFrame, results: Sequence[Reduction], time: FloatArray) -> list[str]:
    """Names of the variables with peaks less than five samples after one another or the start in some run.

    Such peaks are wrong by 1e-4 of their value and more, and smaller ones are missed.

    Args:
        table: results of a sweep
        results: its reductions
        time: the samples (s), shape (n,)
    """
    found = []
    closest = _FEWEST_BETWEEN_PEAKS * float(np.max(np.diff(time)))
    for one in results:
        if isinstance(one, Peaks):
            times = table[list(one.columns[1::2])].to_numpy(dtype=np.float64)
            apart = np.diff(times, axis=1)
            first = times[np.isnan(apart).all(axis=1), 0] - time[0]  # the only one
            if len(time) <= _FEWEST_BETWEEN_PEAKS or (np.append(apart, first) < closest).any():
                found.append(one.variable)
    return found


def units_of(results: Sequence[Reduction], description: FmuDescription) -> dict[str, str]:
    """The unit of every column; empty for a pure number."""
    return {
        column: "s" if column.endswith("_time") else _described(one.variable, description).unit
        for one in results
        for column in one.columns
    }


def _result(table: Table, description: FmuDescription) -> Reduction:
    kind = table.choice("kind", ("peaks", *_KINDS))
    variable = _variable(table, "variable", description)
    if kind != "peaks":
        return _KINDS[kind](variable)
    derivative = _variable(table, "derivative", description) if "derivative" in table else None
    limits = {key: _limit(table, key, description, variable) for key in _LIMITS if key in table}
    with table.at():
        return Peaks(variable, table.integer("count", 1, _DEFAULT_PEAKS), derivative, **limits)


def _variable(table: Table, key: str, description: FmuDescription) -> str:
    name = table.text(key)
    with table.at(key):
        checked_outputs(description, [name])
    return name


def _limit(table: Table, key: str, description: FmuDescription, variable: str) -> float:
    with table.at(key):
        return difference_of(_described(variable, description), table.value(key))


def _described(name: str, description: FmuDescription) -> Variable:
    """Description of a variable, which may be an element of an array."""
    return checked_outputs(description, [name])[0]
