"""Measurements: series of samples by names of FMU variables, and the guess of their release."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.fmu import FmuDescription, read_variables
from pyjoystick.motion import Record, find_swings
from pyjoystick.support import (
    FloatArray,
    ParameterError,
    SeriesError,
    UnknownVariableError,
    increasing_times,
    type_text,
)

_TURNED: Final = ("theta", "omega", "alpha")
_RECORDS: Final = "a list of Records (read_record) or Measurements (Measurement.from_table(name, table))"


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """One measured run.

    Attributes:
        name: name in reports
        time: sample times (s), shape (n,), increasing
        columns: series by the name of the FMU's variable, in its unit, shape (n,) each

    Raises:
        ParameterError: the times do not increase
        SeriesError: a series has another length or contains NaN or infinity
    """

    name: str
    time: FloatArray
    columns: Mapping[str, FloatArray]

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", increasing_times(self.time))
        checked = {name: self._checked(name, series) for name, series in self.columns.items()}
        object.__setattr__(self, "columns", checked)

    def series(self, name: str) -> FloatArray:
        """Return a column by name; raises UnknownVariableError if there is none."""
        if name not in self.columns:
            raise UnknownVariableError(name, self.columns)
        return self.columns[name]

    @classmethod
    def from_record(cls, record: Record) -> Measurement:
        """Take the angle (rad) and, if measured, the angular velocity (rad/s) from a record."""
        columns = {"theta": record.theta}
        if record.omega is not None:
            columns["omega"] = record.omega
        return cls(record.name, record.time, columns)

    @classmethod
    def from_table(cls, name: str, table: pd.DataFrame) -> Measurement:
        """Take a table indexed by time (s) with columns in the units of the FMU, as its runs return."""
        columns = {str(column): table[column].to_numpy(dtype=np.float64) for column in table.columns}
        return cls(name, table.index.to_numpy(dtype=np.float64), columns)

    def mirrored(self) -> Measurement:
        """Reverse the sign of the angle and its derivatives."""
        columns = {name: -one if name in _TURNED else one for name, one in self.columns.items()}
        return Measurement(self.name, self.time, columns)

    def _checked(self, name: str, series: ArrayLike) -> FloatArray:
        values = np.array(series, dtype=np.float64)
        if values.shape != self.time.shape:
            raise SeriesError(name, f"has the shape {values.shape}, time has {self.time.shape}")
        for i in np.flatnonzero(~np.isfinite(values))[:1]:
            raise SeriesError(name, f"is {values[i]} at index {i}; must be finite")
        values.setflags(write=False)
        return values


def read_table_record(path: Path, names: Sequence[str], fmu: FmuDescription) -> Measurement:
    """Read variables of an FMU from a CSV file with `pyjoystick.fmu.read_variables`."""
    return Measurement.from_table(path.stem, read_variables(path, fmu, names))


def measurements(records: Iterable[Record | Measurement]) -> tuple[Measurement, ...]:
    """Convert records to measurements and make names unique; ParameterError for any other type."""
    if not isinstance(records, Iterable) or isinstance(records, pd.DataFrame):
        raise ParameterError("records", type_text(records), _RECORDS)
    found: list[Measurement] = []
    for one in records:
        if not isinstance(one, Record | Measurement):
            raise ParameterError("records", f"{type_text(one)} among them", _RECORDS)
        measured = Measurement.from_record(one) if isinstance(one, Record) else one
        names = {other.name for other in found}
        name, number = measured.name, 2
        while name in names:
            name, number = f"{measured.name} ({number})", number + 1
        found.append(Measurement(name, measured.time, measured.columns))
    return tuple(found)


#: Fractions of the release angle: the fall has reached half when a sample is below the first, and the fall
#: has started when one is below the second or below what `_CLEAR` standard deviations of the noise can reach.
_HALF: Final = 0.5
_BEGUN: Final = 0.9
_CLEAR: Final = 4.0
_LEAST_BEGUN: Final = 0.7
#: Samples during the hold are above this fraction of the largest.
_HELD: Final = 0.8
#: Number of samples used to estimate the scatter.
_FEWEST: Final = 5
#: Number of samples used to decide whether a record starts with the hold.
_BEGINNING: Final = 3


class Release(NamedTuple):
    """How a record starts.

    Attributes:
        angle: before the release (rad)
        time: time of the release on the record's clock (s)
        spread: uncertainty range of the angle (rad); 0 if it follows from the angle
    """

    angle: float
    time: float
    spread: float = 0.0


def guess_release(time: FloatArray, theta: FloatArray) -> Release:
    """Guess the release of a free oscillation.

    The angle is the median of the samples before the fall. From rest, the angle first falls as the square of
    time, so the start follows from the times at which it has fallen to half and, before that, to 0.9 or
    to what is clear of the noise of the hold. Single outliers have no influence.

    The hold is found as the first swing, not the largest: if the springs of one side are weaker, or the zero
    is off, the joystick may swing farther on the other side than it was held.

    Args:
        time: sample times (s), shape (n,)
        theta: angle (rad), shape (n,), with the release in the first swing or at the first sample
    """
    padded = np.concatenate((theta[:1], theta, theta[-1:]))
    smooth = np.median([padded[:-2], theta, padded[2:]], axis=0)
    swings = find_swings(smooth, _HALF * float(np.max(np.abs(smooth))))
    if not swings:
        return Release(float(theta[0]), float(time[0]))
    ratio = smooth / swings[0].value
    fallen = int(np.argmax(ratio < _HALF)) if np.any(ratio < _HALF) else len(ratio)
    before = theta[:fallen][ratio[:fallen] >= _HELD]
    if fallen == 0 or not before.size:
        return Release(float(theta[0]), float(time[0]))
    angle = float(np.median(before))
    clear = _CLEAR * _scatter(before) / abs(angle)
    level = float(np.clip(1.0 - clear, _LEAST_BEGUN, _BEGUN))
    if np.median(theta[: min(fallen, _BEGINNING)]) / angle < level:
        return Release(float(theta[0]), float(time[0]))
    angle = float(np.median(before[before / angle >= 0.5 * (1.0 + level)]))
    half = _last_crossing(time, smooth / angle, _HALF, fallen)
    begun = _last_crossing(time, smooth / angle, level, fallen)
    part = math.sqrt(1.0 - level) / (math.sqrt(1.0 - _HALF) - math.sqrt(1.0 - level))
    return Release(angle, begun - (half - begun) * part)


def _scatter(series: FloatArray) -> float:
    """Standard deviation of the noise of a series that changes slowly."""
    if len(series) < _FEWEST:
        return 0.0
    return 1.4826 * float(np.median(np.abs(np.diff(series, 2)))) / math.sqrt(6.0)


def _last_crossing(time: FloatArray, ratio: FloatArray, level: float, fallen: int) -> float:
    """Time of the last fall through `level` before index `fallen`, with linear interpolation."""
    above = np.flatnonzero(ratio[:fallen] >= level)
    i = int(above[-1]) + 1 if above.size else 0
    if i in (0, len(time)):
        return float(time[min(i, len(time) - 1)])
    part = (ratio[i - 1] - level) / (ratio[i - 1] - ratio[i])
    return float(time[i - 1] + part * (time[i] - time[i - 1]))
