"""What is fitted: series of samples by the names of the FMU's variables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.fmu import FmuDescription, read_variables
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray, SeriesError, UnknownVariableError, increasing_times


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """One measured run.

    Attributes:
        name: what it is called in reports
        time: instants (s), shape (n,), increasing
        columns: series by the name of the FMU's variable, in its unit, shape (n,) each

    Raises:
        ParameterError: the time does not increase
        SeriesError: a series has another length, or NaN or infinity in it
    """

    name: str
    time: FloatArray
    columns: Mapping[str, FloatArray]

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", increasing_times(self.time))
        checked = {name: self._checked(name, series) for name, series in self.columns.items()}
        object.__setattr__(self, "columns", checked)

    def series(self, name: str) -> FloatArray:
        """A column by name; raises UnknownVariableError where there is none."""
        if name not in self.columns:
            raise UnknownVariableError(name, self.columns)
        return self.columns[name]

    @classmethod
    def from_record(cls, record: Record) -> Measurement:
        """The angle (rad) of a record and, where it was measured, its angular velocity (rad/s)."""
        columns = {"theta": record.theta}
        if record.omega is not None:
            columns["omega"] = record.omega
        return cls(record.name, record.time, columns)

    @classmethod
    def from_table(cls, name: str, table: pd.DataFrame) -> Measurement:
        """A table indexed by time (s) with columns in the units of the FMU, as its runs give."""
        columns = {str(column): table[column].to_numpy(dtype=np.float64) for column in table.columns}
        return cls(name, table.index.to_numpy(dtype=np.float64), columns)

    def _checked(self, name: str, series: ArrayLike) -> FloatArray:
        values = np.array(series, dtype=np.float64)
        if values.shape != self.time.shape:
            raise SeriesError(name, f"has the shape {values.shape}, time has {self.time.shape}")
        for i in np.flatnonzero(~np.isfinite(values))[:1]:
            raise SeriesError(name, f"is {values[i]} at index {i}; must be finite")
        values.setflags(write=False)
        return values


def read_table_record(path: Path, names: Sequence[str], fmu: FmuDescription) -> Measurement:
    """Read variables of an FMU from a CSV file, as `pyjoystick.fmu.read_variables` does."""
    return Measurement.from_table(path.stem, read_variables(path, fmu, names))


def measurements(records: Iterable[Record | Measurement]) -> tuple[Measurement, ...]:
    """Records and measurements as measurements with names that differ."""
    found: list[Measurement] = []
    for one in records:
        measured = Measurement.from_record(one) if isinstance(one, Record) else one
        names = {other.name for other in found}
        name, number = measured.name, 2
        while name in names:
            name, number = f"{measured.name} ({number})", number + 1
        found.append(Measurement(name, measured.time, measured.columns))
    return tuple(found)
