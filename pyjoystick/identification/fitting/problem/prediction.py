"""What the FMU predicts for one record, for many rows of parameters at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.fmu import Plan, Variable, sensitivity_name
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings, run_rows
from pyjoystick.identification.fitting.problem.instrument import (
    ANGLE_SCALE,
    DELAY,
    RELEASE_TIME,
    TIME_BASE,
    ZERO_OFFSET,
    Instrument,
)
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.motion import GAP
from pyjoystick.support import FloatArray

#: Plans of the last clocks are kept: a search comes back to the point that it left.
_PLANS_KEPT = 4
#: By this the tolerance of rough derivatives is larger.
_ROUGH = 100.0
#: Curves are drawn in steps of this (s), and of no more points than this.
_CURVE_STEP = 1e-3
_MOST_POINTS = 20_000


class Prediction(NamedTuple):
    """The numbers that are compared with one record.

    Attributes:
        values: shape (rows, n); NaN in rows whose run failed
        slopes: derivatives of the first row with respect to numbers of the instrument, shape (n,) each;
            those that act through the clock only where the derivatives of the outputs are known
        message: why the first row failed, else empty
    """

    values: FloatArray
    slopes: Mapping[str, FloatArray]
    message: str


class Predictor(Protocol):
    """Predicts what one record shows.

    Attributes:
        record: what was measured
        data: the measured numbers that a prediction is compared with, shape (n,)
        labels: name of the series that each of them belongs to, length n
        times: the instant (s) of the record that each of them belongs to, shape (n,)
        runs: FMU runs so far
        differentiable: varied parameters whose derivatives `derivatives` has
    """

    record: Measurement
    data: FloatArray
    labels: tuple[str, ...]
    times: FloatArray
    runs: int
    differentiable: tuple[str, ...]

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """The prediction for rows of parameters, shape (rows, varied)."""
        ...

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> Mapping[str, FloatArray]:
        """Derivatives of the prediction by `differentiable`, shape (n,) each; none where the run fails.

        Rough ones are good for five digits and take half the time.
        """
        ...


class TrajectoryPredictor:
    """The outputs at the samples of a record. Before the release it is at its start values.

    Attributes:
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
        """Take the columns of the record that are needed.

        Args:
            settings: the FMU
            record: what was measured
            outputs: the series that are compared
            derivatives: output that is the derivative of another; empty where the clock is fixed and nothing
                drives the FMU
            inputs: columns that drive the FMU
        """
        self.record = record
        self.data: FloatArray = np.concatenate([record.series(name) for name in outputs])
        self.labels = tuple(name for name in outputs for _ in record.time)
        self.times: FloatArray = np.tile(record.time, len(outputs))
        self.runs = 0
        self.outputs = tuple(outputs)
        self.inputs = tuple(inputs)
        self._settings = settings
        self._slopes = tuple(derivatives[name] for name in outputs) if derivatives else ()
        self._inputs = (
            pd.DataFrame({name: record.series(name) for name in inputs}, index=record.time)
            if inputs
            else None
        )
        self._plans: dict[tuple[float, ...], Plan] = {}
        self._sensitive = settings.fmu.sensitive
        self.differentiable = self._differentiable()

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """See `Predictor`."""
        late = self.record.time - instrument.origin
        moving = late > 0.0
        if np.count_nonzero(moving) == 0:
            reason = f"ends before the release time, {instrument.release_time:g} s"
            raise FitError(self.record.name, reason)
        plan = self._plan(instrument, late[moving])
        found = run_rows(plan, rows, self._settings)
        self.runs += len(rows)
        series = found.numbers[:, _places(moving), :]
        n = len(self.outputs)
        # An output may be the derivative of another, and is recorded once.
        motions, rates = (
            series[:, :, [plan.outputs.index(one) for one in names]] for names in (self.outputs, self._slopes)
        )
        if self._is_driven:
            motions = motions + _came_along(rates, late, instrument)
        else:
            rates = np.where(moving[np.newaxis, :, np.newaxis], rates, 0.0)
        shown = motions.copy()
        shown[:, :, 0] = (1.0 + instrument.angle_scale) * motions[:, :, 0] + instrument.zero_offset
        values = np.concatenate([shown[:, :, k] for k in range(n)], axis=1)
        return Prediction(values, self._slopes_of(motions[0], rates[0], instrument, late), found.message)

    def _slopes_of(
        self, motion: FloatArray, rate: FloatArray, instrument: Instrument, late: FloatArray
    ) -> dict[str, FloatArray]:
        """Derivatives of what is shown with respect to the numbers of the instrument."""
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
        """See `Predictor`; by the sensitivities of the FMU."""
        if self._sensitive is None or not self.differentiable:
            return {}
        tolerance = (_ROUGH if rough else 1.0) * self._settings.tolerance
        settings = self._settings._replace(fmu=self._sensitive, tolerance=tolerance)
        late = self.record.time - instrument.origin
        moving = late > 0.0
        names = self._sensitivities(self.differentiable)
        numbers = self.variables(row, instrument, late[moving], names, settings=settings)
        if not np.all(np.isfinite(numbers)):
            return {}
        columns = dict(zip(names, numbers[_places(moving)].T, strict=True))
        return {name: self._shown(name, columns, late, instrument) for name in self.differentiable}

    def _shown(
        self, parameter: str, columns: Mapping[str, FloatArray], late: FloatArray, instrument: Instrument
    ) -> FloatArray:
        """The derivatives of the outputs by a parameter as the record shows them, one after the other."""
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
        """The outputs of the sensitive FMU that derivatives by these parameters take."""
        series = (*self.outputs, *(self._slopes if self._is_driven else ()))
        return tuple(dict.fromkeys(sensitivity_name(one, name) for name in parameters for one in series))

    def _differentiable(self) -> tuple[str, ...]:
        if self._sensitive is None:
            return ()
        known = self._sensitive.description.variables.keys()
        return tuple(name for name in self._settings.varied if known >= set(self._sensitivities([name])))

    def curve(self, row: FloatArray, instrument: Instrument) -> pd.DataFrame:
        """What is shown for one row of parameters at every millisecond of the record, NaN where samples lack.

        Of long records so many instants are left out that 20 000 remain.
        """
        start, end = self.record.time[0], self.record.time[-1]
        time = np.linspace(
            start, end, 1 + min(math.ceil(round((end - start) / _CURVE_STEP, 6)), _MOST_POINTS)
        )
        steps = np.diff(self.record.time)
        before = np.clip(np.searchsorted(self.record.time, time, side="right") - 1, 0, len(steps) - 1)
        lacking = (steps[before] > GAP * np.median(steps)) & ~np.isin(time, self.record.time)
        moving = np.unique(time[time > instrument.origin])
        numbers = np.full((len(time), len(self.outputs)), np.nan)
        if moving.size:
            late, n = time - instrument.origin, len(self.outputs)
            found = self.variables(
                row, instrument, moving - instrument.origin, (*self.outputs, *self._slopes)
            )
            found = found[np.where(late > 0.0, np.searchsorted(moving, time) + 1, 0)]
            numbers = found[:, :n]
            if self._is_driven:
                numbers = numbers + _came_along(found[:, n:], late, instrument)
            numbers[:, 0] = (1.0 + instrument.angle_scale) * numbers[:, 0] + instrument.zero_offset
        numbers[lacking] = np.nan
        return pd.DataFrame(numbers, index=time, columns=list(self.outputs))

    def variables(
        self,
        row: FloatArray,
        instrument: Instrument,
        late: FloatArray,
        names: Sequence[str],
        added: tuple[str, FloatArray] | None = None,
        moved: tuple[str, float] | None = None,
        settings: FmuSettings | None = None,
    ) -> FloatArray:
        """Variables of the FMU at the release and at instants after it, not as an instrument shows them.

        Args:
            row: parameters, shape (varied,)
            instrument: of the record
            late: instants after `Instrument.origin` on the clock of the record (s), shape (n,), increasing
            names: of the variables
            added: an input and what is added to it at the release and at those instants, shape (n + 1,)
            moved: a parameter that is not varied and what is added to it
            settings: where not those of the fit

        Returns:
            shape (n + 1, names); NaN where the run fails
        """
        plan = self._plan_at(instrument, late, names, added, moved, settings)
        self.runs += 1
        found = run_rows(plan, row[np.newaxis], self._settings).numbers[0]
        return np.asarray(found[:, [plan.outputs.index(one) for one in names]])

    @property
    def known(self) -> Mapping[str, Variable]:
        """The variables of the FMU."""
        return self._settings.fmu.description.variables

    def value(self, name: str) -> float:
        """A parameter that is not varied."""
        value = self._settings.constants.get(name, self.known[name].start)
        return float(value or 0.0)

    def input_at(self, name: str, instrument: Instrument, late: FloatArray) -> FloatArray:
        """A column that drives the FMU, at instants after `Instrument.origin` (s)."""
        times = late + instrument.release_time
        return np.asarray(np.interp(times, self.record.time, self.record.series(name)))

    @property
    def _is_driven(self) -> bool:
        """Whether the motion before its origin is known: driven, it was not at rest."""
        return self._inputs is not None and bool(self._slopes)

    def _plan(self, instrument: Instrument, late: FloatArray) -> Plan:
        plan = self._plans.get(instrument.clock)
        if plan is None:
            if len(self._plans) == _PLANS_KEPT:
                del self._plans[next(iter(self._plans))]
            plan = self._plan_at(instrument, late, (*self.outputs, *self._slopes))
            self._plans[instrument.clock] = plan
        return plan

    def _plan_at(
        self,
        instrument: Instrument,
        late: FloatArray,
        names: Sequence[str],
        added: tuple[str, FloatArray] | None = None,
        moved: tuple[str, float] | None = None,
        settings: FmuSettings | None = None,
    ) -> Plan:
        """A plan of runs with these instants after the release, on the clock of the record (s)."""
        rate = 1.0 + instrument.time_base
        instants = np.concatenate(([0.0], rate * late))
        inputs = self._inputs
        if inputs is not None:
            inputs = inputs.set_axis(rate * (inputs.index - instrument.release_time))
        if added is not None:
            inputs = _with_added(inputs, instants, *added)
        settings = settings or self._settings
        constants = dict(settings.constants)
        if moved is not None:
            name, change = moved
            constants[name] = self.value(name) + change
        return settings.fmu.plan(
            instants,
            varied=settings.varied,
            parameters=constants,
            inputs=inputs,
            outputs=tuple(names),
            tolerance=settings.tolerance,
        )


def _places(moving: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Numbers of the samples of a run that a record shows.

    The first is the state at the release, which the record shows from its beginning.
    """
    return np.concatenate(
        (np.zeros(np.count_nonzero(~moving), dtype=np.intp), 1 + np.arange(np.count_nonzero(moving)))
    )


def _with_added(
    inputs: pd.DataFrame | None, instants: FloatArray, name: str, values: FloatArray
) -> pd.DataFrame:
    """The inputs, straight between their samples, with something added to one of them."""
    if inputs is None:
        return pd.DataFrame({name: values}, index=instants)
    index = np.union1d(inputs.index, instants)
    table = pd.DataFrame({one: np.interp(index, inputs.index, inputs[one]) for one in inputs}, index=index)
    more = np.interp(index, instants, values, left=0.0, right=0.0)
    table[name] = table[name] + more if name in table else more
    return table


def _came_along(rates: FloatArray, late: FloatArray, instrument: Instrument) -> FloatArray:
    """What a driven motion still had to go before its origin, to first order; 0 after it.

    Args:
        rates: its velocity, and that at its origin before it, shape (..., n, outputs)
        late: time after the origin on the clock of the record (s), shape (n,)
        instrument: of the record
    """
    return (1.0 + instrument.time_base) * np.minimum(late, 0.0)[:, np.newaxis] * rates
