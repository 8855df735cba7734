"""Runs of the FMU sampled at the times of one record and driven by its columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from pyjoystick.fmu import Plan, Variable
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings, Runs, run_rows
from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.support import FloatArray


class RecordRuns:
    """Runs of the FMU for one record, giving the true variables and not an instrument's readings.

    Attributes:
        settings: the FMU
        record: the measured record
        count: number of runs so far
    """

    def __init__(self, settings: FmuSettings, record: Measurement, inputs: Sequence[str]) -> None:
        """Take the columns of the record that drive the FMU."""
        self.settings = settings
        self.record = record
        self.count = 0
        self._inputs = (
            pd.DataFrame({name: record.series(name) for name in inputs}, index=record.time)
            if inputs
            else None
        )

    @property
    def known(self) -> Mapping[str, Variable]:
        """The variables of the FMU."""
        return self.settings.fmu.description.variables

    def value(self, name: str) -> float:
        """Value of a parameter that is not varied."""
        value = self.settings.constants.get(name, self.known[name].start)
        return float(value or 0.0)

    def input_at(self, name: str, instrument: Instrument, late: FloatArray) -> FloatArray:
        """A column that drives the FMU, at times after `Instrument.origin` (s)."""
        times = late + instrument.release_time
        return np.asarray(np.interp(times, self.record.time, self.record.series(name)))

    def variables(
        self,
        row: FloatArray,
        names: Sequence[str],
        plan: Plan,
    ) -> FloatArray:
        """Variables of the FMU at the release and at later times, from one run.

        Args:
            row: parameters, shape (varied,)
            names: names of the variables; repeats are allowed
            plan: made by `plan` for these variables and n times

        Returns:
            shape (n + 1, names); NaN if the run fails
        """
        found = self.run(plan, row[np.newaxis]).numbers[0]
        return np.asarray(found[:, [plan.outputs.index(one) for one in names]])

    def run(self, plan: Plan, rows: FloatArray) -> Runs:
        """Run rows of parameters, shape (rows, varied), and count the runs."""
        self.count += len(rows)
        return run_rows(plan, rows, self.settings)

    def plan(
        self,
        instrument: Instrument,
        late: FloatArray,
        names: Sequence[str],
        *,
        added: tuple[str, FloatArray] | None = None,
        moved: tuple[str, float] | None = None,
        settings: FmuSettings | None = None,
    ) -> Plan:
        """Make a plan of runs that record variables at the release and at later times.

        Args:
            instrument: instrument of the record
            late: times after `Instrument.origin` on the record's clock (s), shape (n,), increasing
            names: names of the variables
            added: an input and what to add to it at the release and at those times, shape (n + 1,)
            moved: a parameter that is not varied and what to add to it
            settings: if not those of the fit
        """
        rate = 1.0 + instrument.time_base
        instants = np.concatenate(([0.0], rate * late))
        inputs = self._inputs
        if inputs is not None:
            inputs = inputs.set_axis(rate * (inputs.index - instrument.release_time))
        if added is not None:
            inputs = _with_added(inputs, instants, *added)
        settings = settings or self.settings
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


def _with_added(
    inputs: pd.DataFrame | None, instants: FloatArray, name: str, values: FloatArray
) -> pd.DataFrame:
    """The inputs, linear between their samples, with something added to one of them."""
    if inputs is None:
        return pd.DataFrame({name: values}, index=instants)
    index = np.union1d(inputs.index, instants)
    table = pd.DataFrame({one: np.interp(index, inputs.index, inputs[one]) for one in inputs}, index=index)
    more = np.interp(index, instants, values, left=0.0, right=0.0)
    table[name] = table[name] + more if name in table else more
    return table
