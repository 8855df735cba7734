"""What the FMU predicts for one record, for many rows of parameters at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu, FmuRunError, Plan, Reduction, Value
from pyjoystick.identification.errors import FitError, FitInterruptedError
from pyjoystick.identification.fitting.measurement import Measurement
from pyjoystick.support import FloatArray

#: Plans of the last release times are kept: a search comes back to the point that it left.
_PLANS_KEPT = 4
#: Up to so many runs are done one after the other.
_FEW = 24
#: Curves are drawn in steps of this (s), and of no more points than this.
_CURVE_STEP = 1e-3
_MOST_POINTS = 20_000
#: Samples lack where two are further apart than this many of the usual steps.
_GAP = 1.5


class Prediction(NamedTuple):
    """The numbers that are compared with one record.

    Attributes:
        values: shape (rows, n); NaN in rows whose run failed
        time_slope: derivative of the first row with respect to the release time, shape (n,); zero where the
            release time is fixed
        message: why the first row failed, else empty
    """

    values: FloatArray
    time_slope: FloatArray
    message: str


class Predictor(Protocol):
    """Predicts what one record shows.

    Attributes:
        record: what was measured
        data: the measured numbers that a prediction is compared with, shape (n,)
        labels: name of the series that each of them belongs to, length n
        times: the instant (s) of the record that each of them belongs to, shape (n,)
        runs: FMU runs so far
    """

    record: Measurement
    data: FloatArray
    labels: tuple[str, ...]
    times: FloatArray
    runs: int

    def predict(self, rows: FloatArray, release_time: float) -> Prediction:
        """The prediction for rows of parameters, shape (rows, varied)."""
        ...


class FmuSettings(NamedTuple):
    """What all runs of a fit share: the open FMU, varied and constant parameters, and its tolerance."""

    fmu: Fmu
    varied: tuple[str, ...]
    constants: Mapping[str, Value]
    tolerance: float

    def ranges(self) -> tuple[FloatArray, FloatArray]:
        """What the FMU allows for the varied parameters: least and largest values, shape (varied,) each."""
        known = [self.fmu.description.variables[name] for name in self.varied]
        low = np.array([-np.inf if one.minimum is None else one.minimum for one in known])
        high = np.array([np.inf if one.maximum is None else one.maximum for one in known])
        return low, high


class TrajectoryPredictor:
    """The outputs at the samples of a record. Before the release it is at its start values."""

    def __init__(
        self,
        settings: FmuSettings,
        record: Measurement,
        outputs: Sequence[str],
        derivatives: Mapping[str, str],
        inputs: Sequence[str],
    ) -> None:
        """Take the columns of the record that are needed.

        Args:
            settings: the FMU
            record: what was measured
            outputs: the series that are compared
            derivatives: output that is the derivative of another; empty where the release time is fixed
            inputs: columns that drive the FMU
        """
        self.record = record
        self.data: FloatArray = np.concatenate([record.series(name) for name in outputs])
        self.labels = tuple(name for name in outputs for _ in record.time)
        self.times: FloatArray = np.tile(record.time, len(outputs))
        self.runs = 0
        self._settings = settings
        self._outputs = tuple(outputs)
        self._slopes = tuple(derivatives[name] for name in outputs) if derivatives else ()
        self._inputs = (
            pd.DataFrame({name: record.series(name) for name in inputs}, index=record.time)
            if inputs
            else None
        )
        self._plans: dict[float, Plan] = {}

    def predict(self, rows: FloatArray, release_time: float) -> Prediction:
        """See `Predictor`."""
        moving = self.record.time > release_time
        if np.count_nonzero(moving) == 0:
            raise FitError(self.record.name, f"ends before the release time, {release_time:g} s")
        found = run_rows(self._plan(release_time, moving), rows, self._settings)
        self.runs += len(rows)
        # The first sample of the run is the state at the release, which the record shows from its beginning.
        places = np.concatenate(
            (np.zeros(np.count_nonzero(~moving), dtype=np.intp), 1 + np.arange(moving.sum()))
        )
        series = found.numbers[:, places, :]
        n = len(self._outputs)
        values = np.concatenate([series[:, :, k] for k in range(n)], axis=1)
        slope = np.zeros(values.shape[1])
        if self._slopes:
            slope = np.concatenate(
                [np.where(moving, -series[0, :, n + k], 0.0) for k in range(len(self._slopes))]
            )
        return Prediction(values, slope, found.message)

    def curve(self, row: FloatArray, release_time: float) -> pd.DataFrame:
        """The outputs for one row of parameters at every millisecond of the record, NaN where samples lack.

        Of long records so many instants are left out that 20 000 remain.
        """
        start, end = self.record.time[0], self.record.time[-1]
        time = np.linspace(
            start, end, 1 + min(math.ceil(round((end - start) / _CURVE_STEP, 6)), _MOST_POINTS)
        )
        steps = np.diff(self.record.time)
        before = np.clip(np.searchsorted(self.record.time, time, side="right") - 1, 0, len(steps) - 1)
        lacking = (steps[before] > _GAP * np.median(steps)) & ~np.isin(time, self.record.time)
        moving = np.unique(time[time > release_time])
        numbers = np.full((len(time), len(self._outputs)), np.nan)
        if moving.size:
            plan = self._plan_at(np.concatenate(([0.0], moving - release_time)), release_time)
            found = run_rows(plan, row[np.newaxis], self._settings).numbers[0, :, : len(self._outputs)]
            self.runs += 1
            numbers = found[np.where(time > release_time, np.searchsorted(moving, time) + 1, 0)]
        numbers[lacking] = np.nan
        return pd.DataFrame(numbers, index=time, columns=list(self._outputs))

    def _plan(self, release_time: float, moving: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Plan:
        plan = self._plans.get(release_time)
        if plan is None:
            if len(self._plans) == _PLANS_KEPT:
                del self._plans[next(iter(self._plans))]
            instants = np.concatenate(([0.0], self.record.time[moving] - release_time))
            self._plans[release_time] = plan = self._plan_at(instants, release_time)
        return plan

    def _plan_at(self, instants: FloatArray, release_time: float) -> Plan:
        """A plan of runs with these instants (s after the release)."""
        inputs = self._inputs
        return self._settings.fmu.plan(
            instants,
            varied=self._settings.varied,
            parameters=self._settings.constants,
            inputs=None if inputs is None else inputs.set_axis(inputs.index - release_time),
            outputs=(*self._outputs, *self._slopes),
            tolerance=self._settings.tolerance,
        )


class Runs(NamedTuple):
    """The runs of a few rows.

    Attributes:
        numbers: the samples, shape (rows, samples, outputs), or what the reduction kept, shape
            (rows, columns); NaN in rows that failed
        message: why the first row failed, else empty
    """

    numbers: FloatArray
    message: str


def run_rows(plan: Plan, rows: FloatArray, settings: FmuSettings, reduction: Reduction | None = None) -> Runs:
    """Run some rows; one outside the ranges of the FMU, as ties may lead to, counts as failed.

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
    """Runs one after the other: for a handful of them the threads of a batch take longer than they save."""
    try:
        for i in np.flatnonzero(allowed):
            try:
                numbers[i] = plan.run(rows[i])
            except FmuRunError as error:
                message = message or (str(error) if i == 0 else "")
    except KeyboardInterrupt:
        raise FitInterruptedError from None
    return Runs(numbers, message)
