"""A run prepared once and carried out many times with other parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick._types import FloatArray
from pyjoystick.checks import increasing_times
from pyjoystick.errors import ParameterError
from pyjoystick.fmu.batch import BatchResult
from pyjoystick.fmu.errors import FmuRunError
from pyjoystick.fmu.inputs import Inputs
from pyjoystick.fmu.reductions import Extremes, Final, Loss, Reduction, checked_reductions
from pyjoystick.fmu.values import Value, checked_outputs
from pyjoystick.peaks import find_peaks

#: Called in the calling thread with the number of runs that are done and the number of all runs.
OnProgress = Callable[[int, int], None]


class Plan:
    """Everything of a run but the values that vary, checked once; made by `Fmu.plan`.

    Attributes:
        time: instants of the samples (s), shape (samples,)
        varied: names of the parameters that each run gives
        outputs: names of the recorded variables
    """

    def __init__(
        self,
        fmu: Any,
        time: ArrayLike,
        varied: Iterable[str],
        parameters: Mapping[str, Value],
        inputs: Inputs | None,
        outputs: Iterable[str] | None,
        tolerance: float,
    ) -> None:
        self.time: FloatArray = increasing_times(time)
        self.varied: tuple[str, ...] = (varied,) if isinstance(varied, str) else tuple(varied)
        self.outputs: tuple[str, ...] = tuple(v.name for v in checked_outputs(fmu.description, outputs))
        self._fmu = fmu
        self._parameters = dict(parameters)
        self._inputs = inputs
        self._tolerance = tolerance
        self._stopped = False

    def run(self, values: ArrayLike = ()) -> FloatArray:
        """One run.

        Args:
            values: the varied parameters in the order of `varied`, shape (len(varied),)

        Returns:
            the samples, shape (samples, variables), in the units of the FMU; Booleans are 0 and 1

        Raises:
            ParameterError: a value is missing, not finite, of the wrong type or out of range
            FmuRunError: the FMU refuses its settings or fails during the run
        """
        row = np.asarray(values, dtype=np.float64)
        if row.shape != (len(self.varied),):
            raise ParameterError("values", f"shape {row.shape}", f"of shape ({len(self.varied)},)")
        given = dict(zip(self.varied, row.tolist(), strict=True))
        table = self._fmu.run(
            self.time,
            parameters=self._parameters | given,
            inputs=self._inputs,
            outputs=self.outputs,
            tolerance=self._tolerance,
        )
        return table.to_numpy(dtype=np.float64)

    def run_batch(
        self,
        table: pd.DataFrame | ArrayLike,
        *,
        threads: int | None = None,
        reductions: Sequence[Reduction] | None = None,
        on_progress: OnProgress | None = None,
    ) -> BatchResult:
        """Many runs; the result is the same, bit for bit, whatever the number of threads.

        A failing run is marked and the others go on. Ctrl-C stops within a second and returns what is done
        with `BatchResult.interrupted` set; so does `stop` when another thread calls it.

        Args:
            table: one row a run, as an array of shape (runs, len(varied)) or a table with the columns
                `varied` in any order
            threads: number of threads, one instance of the FMU each; the cores that this process may use
                where not given
            reductions: what to keep of each run; every sample of every run is kept where not given
            on_progress: called about ten times a second in the calling thread; an exception in it stops the
                batch and is passed on

        Raises:
            ParameterError: a value of the table is not allowed (the message names its row), or the settings
            UnknownVariableError: a reduction asks for a variable that is not among `outputs`
        """
        if not isinstance(table, pd.DataFrame):
            table = pd.DataFrame(np.asarray(table, dtype=np.float64), columns=list(self.varied))
        rows = table[list(self.varied)].to_numpy(dtype=np.float64)
        kept = None if reductions is None else checked_reductions(reductions, self.outputs)
        values = np.full((len(rows), self.time.size, len(self.outputs)), np.nan)
        messages = [""] * len(rows)
        done = np.zeros(len(rows), dtype=np.bool_)
        self._stopped = False
        for i, row in enumerate(rows):
            if self._stopped:
                break
            done[i] = True
            try:
                values[i] = self.run(row)
            except FmuRunError as error:
                messages[i] = str(error)
            if on_progress is not None:
                on_progress(i + 1, len(rows))
        reduced = None
        if kept is not None:
            names = [column for reduction in kept for column in reduction.columns]
            cells = [[x for reduction in kept for x in self._reduce(reduction, run)] for run in values]
            reduced = pd.DataFrame(cells, index=table.index, columns=names)
        return BatchResult(
            parameters=table[list(self.varied)],
            values=values if kept is None else None,
            reduced=reduced,
            messages=messages,
            failed=np.array([message != "" for message in messages], dtype=np.bool_),
            done=done,
            interrupted=not done.all(),
        )

    def stop(self) -> None:
        """Have a running `run_batch` return soon with what is done; may be called from any thread."""
        self._stopped = True

    def _reduce(self, reduction: Reduction, values: FloatArray) -> list[float]:
        series = values[:, self.outputs.index(reduction.variable)]
        if np.isnan(series).any():
            return [np.nan] * len(reduction.columns)
        if isinstance(reduction, Final):
            return [series[-1]]
        if isinstance(reduction, Loss):
            return [series[0] - series[-1]]
        if isinstance(reduction, Extremes):
            high, low = int(np.argmax(series)), int(np.argmin(series))
            return [series[high], self.time[high], series[low], self.time[low]]
        slope = None if reduction.derivative is None else values[:, self.outputs.index(reduction.derivative)]
        peaks = find_peaks(
            self.time,
            series,
            slope,
            minimum_height=reduction.minimum_height,
            minimum_prominence=reduction.minimum_prominence,
        ).iloc[: reduction.count]
        cells = np.full((reduction.count, 2), np.nan)
        cells[: len(peaks)] = peaks[["value", "time"]]
        return cells.ravel().tolist()
