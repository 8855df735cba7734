"""Compare a result with a published reference result."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

TOLERANCE = 1e-4
"""Relative to the range of a signal."""
NEAR = 1e-3
"""Relative to the range: a reference result may itself have an error of this size."""
TIME_TOLERANCE = 1e-6
"""Relative to the length of the run: largest time shift of a jump between the two results."""
_LEAST_RANGE = 1e-6
_LEAST_SHARE = 1e-3
"""Lower limit for the range of a signal, absolute and relative to its largest magnitude: signals that are
constant in a reference result vary by rounding in others.
"""


@dataclass(frozen=True, slots=True)
class Reference:
    """A reference result: times (n,), twice at events; values (n, signals); signal names."""

    time: NDArray[np.float64]
    values: NDArray[np.float64]
    signals: tuple[str, ...]

    @property
    def instants(self) -> NDArray[np.float64]:
        """The times without duplicates."""
        return np.unique(self.time)


def read_reference(folder: Path) -> Reference:
    """Read the columns of ``NAME/NAME.csv`` that ``comparisonSignals.txt`` lists.

    Raises `OSError` or `ValueError` if the folder does not contain a reference result.
    """
    names = (folder / "comparisonSignals.txt").read_text("utf-8").split()
    table = folder / f"{folder.name}.csv"
    with table.open(encoding="utf-8", newline="") as lines:
        header, *rows = csv.reader(lines)
    header[0] = header[0].lower()  # "Time" in some files
    columns = [header.index(name) for name in names if name in header and name != "time"]
    data = np.array([row for row in rows if row], dtype=np.float64)
    return Reference(data[:, header.index("time")], data[:, columns], tuple(header[c] for c in columns))


def largest_error(reference: Reference, result: pd.DataFrame) -> tuple[float, str]:
    """Return the largest distance from the reference, relative to the signal's range, and that signal.

    Args:
        reference: the reference result.
        result: a column for each signal, at `Reference.instants`.

    The distance is measured from the band between the smallest and the largest reference value within
    `TIME_TOLERANCE` of each time, so that a jump may be on either side of it.
    """
    reach = TIME_TOLERANCE * (reference.time[-1] - reference.time[0])
    worst = (0.0, "")
    for number, name in enumerate(reference.signals):
        lower, upper = _band(reference.time, reference.values[:, number], reference.instants, reach)
        values = result[name].to_numpy(dtype=np.float64)
        outside = np.maximum(np.maximum(lower - values, values - upper), 0.0)
        error = float(np.max(outside)) / _range(reference.values[:, number])
        worst = max(worst, (error if np.isfinite(error) else np.inf, name))
    return worst


def _band(
    time: NDArray[np.float64], values: NDArray[np.float64], instants: NDArray[np.float64], reach: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the minimum and maximum near each time, with linear interpolation between the points."""
    first = np.searchsorted(time, instants - reach, side="left")
    last = np.searchsorted(time, instants + reach, side="right")
    ends = [_on_lines(time, values, instants + shift) for shift in (-reach, reach)]
    lower, upper = np.minimum(*ends), np.maximum(*ends)
    for k, (i, j) in enumerate(zip(first, last, strict=True)):
        lower[k] = min(lower[k], values[i:j].min())
        upper[k] = max(upper[k], values[i:j].max())
    return lower, upper


def _on_lines(
    time: NDArray[np.float64], values: NDArray[np.float64], at: NDArray[np.float64]
) -> NDArray[np.float64]:
    interpolated: NDArray[np.float64] = np.interp(at, time, values)
    return interpolated


def _range(values: NDArray[np.float64]) -> float:
    largest = float(np.max(np.abs(values)))
    return max(float(np.ptp(values)), _LEAST_SHARE * largest, _LEAST_RANGE)
