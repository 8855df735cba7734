"""Arithmetic of the reductions in `pyjoystick.fmu.reductions`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from pyjoystick.motion import extrema_of_derivative, extrema_of_samples, peaks_among
from pyjoystick.support import FloatArray

FINAL, EXTREMES, PEAKS, LOSS = range(4)


class Operation(NamedTuple):
    """One reduction.

    Attributes:
        kind: kind of the reduction
        column: column of the variable in the samples
        derivative: column of its derivative, -1 if there is none
        cell: index of its first result
        most: number of peaks to keep
        height: minimum height of a peak
        prominence: minimum prominence of a peak
    """

    kind: int
    column: int
    derivative: int
    cell: int
    most: int
    height: float
    prominence: float


#: An operation in an array that the compiled kernel reads.
OPERATION: Final = np.dtype(
    [(name, np.intp) for name in Operation._fields[:5]]
    + [(name, np.float64) for name in Operation._fields[5:]],
    align=True,
)


def reduce_run(
    operations: Sequence[Operation], instants: FloatArray, samples: FloatArray, cells: FloatArray
) -> None:
    """Compute the results of one run.

    Args:
        operations: what to keep
        instants: sample times (s), shape (samples,)
        samples: shape (samples, variables)
        cells: the results, shape (cells,), initially NaN
    """
    for i in range(len(operations)):
        operation = operations[i]
        series = samples[:, operation.column]
        cell = operation.cell
        if operation.kind == FINAL:
            cells[cell] = series[-1]
        elif operation.kind == LOSS:
            cells[cell] = series[0] - series[-1]
        elif operation.kind == EXTREMES:
            highest, lowest = np.argmax(series), np.argmin(series)
            cells[cell], cells[cell + 1] = series[highest], instants[highest]
            cells[cell + 2], cells[cell + 3] = series[lowest], instants[lowest]
        else:
            _keep_peaks(operation, instants, samples, cells)


def _keep_peaks(operation: Operation, instants: FloatArray, samples: FloatArray, cells: FloatArray) -> None:
    # Contiguous copies, so that compiled and plain code operate on the same kind of array.
    series = samples[:, operation.column].copy()
    if not np.isfinite(series).all():
        cells[operation.cell] = np.inf  # which no peak is: NaN means that there are fewer than wanted
        return
    if operation.derivative >= 0:
        extrema = extrema_of_derivative(instants, series, samples[:, operation.derivative].copy())
    else:
        extrema = extrema_of_samples(instants, series)
    peaks = peaks_among(extrema, series[0], series[-1], operation.height, operation.prominence)
    for i in range(min(operation.most, len(peaks))):
        cells[operation.cell + 2 * i] = peaks[i, 1]
        cells[operation.cell + 2 * i + 1] = peaks[i, 0]


#: Functions to compile, each after those that it calls.
FUNCTIONS = (_keep_peaks, reduce_run)
