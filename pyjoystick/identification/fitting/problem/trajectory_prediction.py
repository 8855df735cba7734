"""Prediction of one record sample by sample."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.fmu import Plan, sensitivity_name
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings
from pyjoystick.identification.fitting.problem.instrument import (
    ANGLE_SCALE,
    DELAY,
    RELEASE_TIME,
    TIME_BASE,
    ZERO_OFFSET,
    Instrument,
)
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.identification.fitting.problem.predictor import Prediction
from pyjoystick.identification.fitting.problem.record_runs import RecordRuns
from pyjoystick.motion import GAP
from pyjoystick.support import FloatArray

#: Plans for the last clocks are cached, because a search returns to the point that it left.
_PLANS_KEPT: Final = 4
#: Rough derivatives use a tolerance larger by this factor.
_ROUGH: Final = 100.0
#: Time step of plotted curves (s), and their largest number of points.
_CURVE_STEP: Final = 1e-3
_MOST_POINTS: Final = 20_000


class TrajectoryPredictor:
    """Outputs at the samples of a record. Before the release, the record shows the start values.

    Attributes:
        motion: runs of the FMU for this record
        outputs: names of the series
        inputs: columns of the record that drive the FMU
    """

    def __init__(
        self,
        settings: FmuSettings,
        record: Measurement,
        outputs: Sequence[str],
        derivatives: Mapping[str, str],
        inputs: Sequence[str],
    ) -> None:
        """Take the required columns of the record.

        Args:
            settings: the FMU
            record: the measured record
            outputs: series to compare
            derivatives: output that is the derivative of another; empty if the clock is fixed and nothing
                drives the FMU
            inputs: columns that drive the FMU
        """
        self.record = record
        self.data: FloatArray = np.concatenate([record.series(name) for name in outputs])
        self.labels = tuple(name for name in outputs for _ in record.time)
        self.times: FloatArray = np.tile(record.time, len(outputs))
        self.outputs = tuple(outputs)
        self.inputs = tuple(inputs)
        self.motion = RecordRuns(settings, record, inputs)
        self._slopes = tuple(derivatives[name] for name in outputs) if derivatives else ()
        # A driven motion was not at rest before its origin; its slope there is used to extrapolate.
        self._is_driven = bool(inputs) and bool(self._slopes)
        self._plans: dict[tuple[float, ...], Plan] = {}
        self._sensitive = settings.fmu.sensitive
        self.differentiable = self._differentiable(settings.varied)

    @property
    def runs(self) -> int:
        """Number of FMU runs so far."""
        return self.motion.count

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """See `Predictor`."""
        late = self.record.time - instrument.origin
        moving = late > 0.0
        if np.count_nonzero(moving) == 0:
            reason = f"ends before the release time, {instrument.release_time:g} s"
            raise FitError(self.record.name, reason)
        plan = self._plan(instrument, late[moving])
        found = self.motion.run(plan, rows)
        series = found.numbers[:, _places(moving), :]
        # An output may also be the derivative of another; it is recorded once.
        motions, rates = (
            series[:, :, [plan.outputs.index(one) for one in names]] for names in (self.outputs, self._slopes)
        )
        if self._is_driven:
            motions = motions + _came_along(rates, late, instrument)
        else:
            rates = np.where(moving[np.newaxis, :, np.newaxis], rates, 0.0)
        shown = _shown(motions, instrument)
        values = np.concatenate([shown[:, :, k] for k in range(len(self.outputs))], axis=1)
        return Prediction(values, self._slopes_of(motions[0], rates[0], instrument, late), found.message)

    def _slopes_of(
        self, motion: FloatArray, rate: FloatArray, instrument: Instrument, late: FloatArray
    ) -> dict[str, FloatArray]:
        """Derivatives of the readings with respect to the instrument's numbers."""
        first = np.zeros_like(motion)
        first[:, 0] = 1.0
        found = {ZERO_OFFSET: first, ANGLE_SCALE: first * motion}
        if self._slopes:
            shown = rate * np.where(first == 1.0, 1.0 + instrument.angle_scale, 1.0)
            earlier = -(1.0 + instrument.time_base) * shown
            found |= {RELEASE_TIME: earlier, DELAY: earlier}
            if not self.inputs:
                found[TIME_BASE] = shown * late[:, np.newaxis]
        return {name: np.concatenate(list(slope.T)) for name, slope in found.items()}

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> Mapping[str, FloatArray]:
        """See `Predictor`; uses the sensitivities of the FMU."""
        if self._sensitive is None or not self.differentiable:
            return {}
        settings = self.motion.settings
        tolerance = (_ROUGH if rough else 1.0) * settings.tolerance
        settings = settings._replace(fmu=self._sensitive, tolerance=tolerance)
        late = self.record.time - instrument.origin
        moving = late > 0.0
        names = self._sensitivities(self.differentiable)
        plan = self.motion.plan(instrument, late[moving], names, settings=settings)
        numbers = self.motion.variables(row, names, plan)
        if not np.all(np.isfinite(numbers)):
            return {}
        columns = dict(zip(names, numbers[_places(moving)].T, strict=True))
        return {name: self._derivative(name, columns, late, instrument) for name in self.differentiable}

    def _derivative(
        self, parameter: str, columns: Mapping[str, FloatArray], late: FloatArray, instrument: Instrument
    ) -> FloatArray:
        """Derivatives of the readings of all outputs with respect to a parameter, concatenated."""
        motions, rates = (
            [columns[sensitivity_name(one, parameter)] for one in names]
            for names in (self.outputs, self._slopes if self._is_driven else ())
        )
        shown = np.column_stack(motions)
        if rates:
            shown += _came_along(np.column_stack(rates), late, instrument)
        shown[:, 0] *= 1.0 + instrument.angle_scale
        return np.concatenate(list(shown.T))

    def _sensitivities(self, parameters: Sequence[str]) -> tuple[str, ...]:
        """Outputs of the sensitive FMU from which derivatives by these parameters are computed."""
        series = (*self.outputs, *(self._slopes if self._is_driven else ()))
        return tuple(dict.fromkeys(sensitivity_name(one, name) for name in parameters for one in series))

    def _differentiable(self, varied: Sequence[str]) -> tuple[str, ...]:
        if self._sensitive is None:
            return ()
        known = self._sensitive.description.variables.keys()
        return tuple(name for name in varied if known >= set(self._sensitivities([name])))

    def curve(self, row: FloatArray, instrument: Instrument) -> pd.DataFrame:
        """Readings for one row of parameters at every millisecond of the record, NaN in gaps.

        Long records have at most 20 000 points, evenly spaced.
        """
        start, end = self.record.time[0], self.record.time[-1]
        time = np.linspace(
            start, end, 1 + min(math.ceil(round((end - start) / _CURVE_STEP, 6)), _MOST_POINTS)
        )
        moving = np.unique(time[time > instrument.origin])
        numbers = np.full((len(time), len(self.outputs)), np.nan)
        if moving.size:
            late, n = time - instrument.origin, len(self.outputs)
            names = (*self.outputs, *self._slopes)
            plan = self.motion.plan(instrument, moving - instrument.origin, names)
            found = self.motion.variables(row, names, plan)
            found = found[np.where(late > 0.0, np.searchsorted(moving, time) + 1, 0)]
            numbers = found[:, :n]
            if self._is_driven:
                numbers = numbers + _came_along(found[:, n:], late, instrument)
            numbers = _shown(numbers, instrument)
        numbers[_is_in_gap(time, self.record.time)] = np.nan
        return pd.DataFrame(numbers, index=time, columns=list(self.outputs))

    def _plan(self, instrument: Instrument, late: FloatArray) -> Plan:
        plan = self._plans.get(instrument.clock)
        if plan is None:
            if len(self._plans) == _PLANS_KEPT:
                del self._plans[next(iter(self._plans))]
            plan = self.motion.plan(instrument, late, (*self.outputs, *self._slopes))
            self._plans[instrument.clock] = plan
        return plan


def _places(moving: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Indices of the samples of a run that a record shows.

    Index 0 is the state at the release, which the record shows from its start.
    """
    return np.concatenate(
        (np.zeros(np.count_nonzero(~moving), dtype=np.intp), 1 + np.arange(np.count_nonzero(moving)))
    )


def _shown(motions: FloatArray, instrument: Instrument) -> FloatArray:
    """Readings of outputs: scale and zero applied to the first one; shape (..., outputs)."""
    shown = motions.copy()
    shown[..., 0] = (1.0 + instrument.angle_scale) * motions[..., 0] + instrument.zero_offset
    return shown


def _is_in_gap(time: FloatArray, samples: FloatArray) -> NDArray[np.bool_]:
    """Whether times are where samples are missing, shape of `time`."""
    steps = np.diff(samples)
    before = np.clip(np.searchsorted(samples, time, side="right") - 1, 0, len(steps) - 1)
    return np.asarray((steps[before] > GAP * np.median(steps)) & ~np.isin(time, samples))


def _came_along(rates: FloatArray, late: FloatArray, instrument: Instrument) -> FloatArray:
    """Displacement of a driven motion from its origin before its start, to first order; 0 after it.

    Args:
        rates: its velocity, which before the origin is that at the origin, shape (..., n, outputs)
        late: time after the origin on the record's clock (s), shape (n,)
        instrument: instrument of the record
    """
    return (1.0 + instrument.time_base) * np.minimum(late, 0.0)[:, np.newaxis] * rates
