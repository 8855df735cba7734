"""What is fitted: series of samples by the names of the FMU's variables, and a guess of their release."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

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


_HELD = 0.95
_BEGUN = 0.9
_HALF = 0.5


class Release(NamedTuple):
    """Angle (rad) before the release, and the instant (s) of the release on the clock of the record."""

    angle: float
    time: float


def guess_release(time: FloatArray, theta: FloatArray) -> Release:
    """The release of a free oscillation.

    The angle is the median of the samples before the fall. A motion that begins at rest falls as the square
    of time at first; the instants at which the angle has fallen to 0.9 and to 0.5 of it give the beginning.

    Args:
        time: instants (s), shape (n,)
        theta: angle (rad), shape (n,), with the release at the largest or at the first sample
    """
    largest = float(theta[np.argmax(np.abs(theta))])
    ratio = theta / largest
    fallen = int(np.argmax(ratio < _BEGUN)) if (ratio[0] >= _BEGUN) else 0
    if fallen == 0:
        return Release(float(theta[0]), float(time[0]))
    held = theta[:fallen][ratio[:fallen] >= _HELD]
    angle = float(np.median(held)) if held.size else largest
    begun = _crossing(time, theta / angle, _BEGUN)
    half = _crossing(time, theta / angle, _HALF)
    part = math.sqrt(1.0 - _BEGUN) / (math.sqrt(1.0 - _HALF) - math.sqrt(1.0 - _BEGUN))
    return Release(angle, begun - (half - begun) * part)


def _crossing(time: FloatArray, ratio: FloatArray, level: float) -> float:
    """The first instant at which the series has fallen to `level`, on a straight line between samples."""
    below = np.flatnonzero(ratio < level)
    if not below.size:
        return float(time[-1])
    i = int(below[0])
    if i == 0:
        return float(time[0])
    part = (ratio[i - 1] - level) / (ratio[i - 1] - ratio[i])
    return float(time[i - 1] + part * (time[i] - time[i - 1]))
