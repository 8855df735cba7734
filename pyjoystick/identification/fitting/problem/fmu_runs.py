"""Runs of the fitted FMU for several rows of parameters at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu, FmuRunError, Plan, Reduction, Value
from pyjoystick.identification.errors import FitInterruptedError
from pyjoystick.support import FloatArray

#: Up to this many runs are done one after the other.
_FEW: Final = 24


class FmuSettings(NamedTuple):
    """Common to all runs of a fit: the open FMU, varied and constant parameters, and the tolerance."""

    fmu: Fmu
    varied: tuple[str, ...]
    constants: Mapping[str, Value]
    tolerance: float

    def ranges(self) -> tuple[FloatArray, FloatArray]:
        """Smallest and largest values that the FMU allows for the varied parameters, shape (varied,) each."""
        known = [self.fmu.description.variables[name] for name in self.varied]
        low = np.array([-np.inf if one.minimum is None else one.minimum for one in known])
        high = np.array([np.inf if one.maximum is None else one.maximum for one in known])
        return low, high


class Runs(NamedTuple):
    """Results of runs for some rows.

    Attributes:
        numbers: the samples, shape (rows, samples, outputs), or the reduced values, shape (rows, columns);
            NaN in rows that failed
        message: why the first row failed, else empty
    """

    numbers: FloatArray
    message: str


def run_rows(plan: Plan, rows: FloatArray, settings: FmuSettings, reduction: Reduction | None = None) -> Runs:
    """Run some rows; a row outside the ranges of the FMU, as ties may produce, counts as failed.

    Raises:
        FitInterruptedError: Ctrl-C was pressed
    """
    low, high = settings.ranges()
    allowed = np.all((rows >= low) & (rows <= high) & np.isfinite(rows), axis=1)
    shape = (plan.time.size, len(plan.outputs)) if reduction is None else (len(reduction.columns),)
    numbers = np.full((len(rows), *shape), np.nan)
    message = "" if allowed[0] else "a parameter is outside the range that the FMU allows"
    if not allowed.any():
        return Runs(numbers, message)
    if reduction is None and len(rows) <= _FEW:
        return _few_runs(plan, rows, allowed, numbers, message)
    batch = plan.run_batch(rows[allowed], reductions=None if reduction is None else [reduction])
    if batch.interrupted:
        raise FitInterruptedError
    found = batch.values if batch.reduced is None else batch.reduced.to_numpy(dtype=np.float64)
    numbers[allowed] = found
    return Runs(numbers, message or batch.messages[0])


def _few_runs(
    plan: Plan, rows: FloatArray, allowed: NDArray[np.bool_], numbers: FloatArray, message: str
) -> Runs:
    """Run one after the other: for a few runs, starting the threads of a batch takes longer than it saves."""
    try:
        for i in np.flatnonzero(allowed):
            try:
                numbers[i] = plan.run(rows[i])
            except FmuRunError as error:
                message = message or (str(error) if i == 0 else "")
    except KeyboardInterrupt:
        raise FitInterruptedError from None
    return Runs(numbers, message)
