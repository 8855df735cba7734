"""Plans: runs prepared once and executed many times with different parameters."""

from __future__ import annotations

import itertools
import logging
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.fmu.batch import Batch, BatchResult, NewRunner, OnProgress, number_of_threads
from pyjoystick.fmu.errors import FmuEndedError
from pyjoystick.fmu.inputs import Inputs, checked_inputs, communication_points, input_series
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.own_process.pool import ProcessPool
from pyjoystick.fmu.own_process.runner import Outcome, RemoteRunner
from pyjoystick.fmu.preparation import prepare
from pyjoystick.fmu.reductions import Peaks, Reduction, checked_reductions, operations_of, units_of
from pyjoystick.fmu.run_log import log_runs
from pyjoystick.fmu.runner import Job, Runner
from pyjoystick.fmu.sandbox.pool import SandboxPool
from pyjoystick.fmu.sandbox.runner import SandboxRunner
from pyjoystick.fmu.stepping.engine import Loop, loop
from pyjoystick.fmu.stepping.program import FATAL, OK, WARNING
from pyjoystick.fmu.stepping.reducing import Operation
from pyjoystick.fmu.values import Value, checked_outputs, checked_parameters, checked_varied, default_outputs
from pyjoystick.fmu.varied import Varied
from pyjoystick.motion import ratio_to_rate
from pyjoystick.support import (
    FloatArray,
    ParameterError,
    SimulationError,
    increasing_times,
    notebook_progress,
    positive,
)

if TYPE_CHECKING:
    import pandas as pd

_LOG = logging.getLogger(__name__)

#: Distinguishes the plans that are sent to a process.
_keys = itertools.count()


class Plan:
    """A prepared run in which only some values vary; made by `Fmu.plan`.

    It is thread-safe, and can be pickled like its FMU.

    Attributes:
        time: sample times (s), shape (samples,)
        varied: names of the parameters that each run gives
        outputs: names of the recorded variables
        variables: descriptions of the recorded variables
        units: their units by name
        left_out: names of outputs omitted by default: text and binary data
    """

    def __init__(
        self,
        fmu: Any,
        pool: InstancePool | ProcessPool | SandboxPool,
        time: ArrayLike,
        varied: Iterable[str],
        parameters: Mapping[str, Value],
        inputs: Inputs | None,
        outputs: Iterable[str] | None,
        tolerance: float,
    ) -> None:
        description = pool.description
        # The FMU closes its pool when it is garbage-collected.
        self._fmu = fmu
        self._pool = pool
        self.time: FloatArray = increasing_times(time)
        constants = checked_parameters(description, parameters)
        self._varied = Varied(checked_varied(description, varied, parameters))
        table = checked_inputs(description, {} if inputs is None else inputs)
        self.left_out: tuple[str, ...] = ()
        if outputs is None:
            self.variables, self.left_out = default_outputs(description)
        else:
            self.variables = checked_outputs(description, outputs, texts=True)
        points = communication_points(description, self.time, table)
        self._preparation = prepare(
            description,
            pool.library.fmi if isinstance(pool, InstancePool) else None,
            points,
            np.isin(points, self.time, assume_unique=True),
            positive("tolerance", tolerance),
            constants,
            self._varied.variables,
            input_series(description, table, points),
            self.variables,
        )
        self.varied = self._varied.names
        self.outputs: tuple[str, ...] = tuple(variable.name for variable in self.variables)
        self.units = {variable.name: variable.unit for variable in self.variables}
        self._settings: dict[str, Any] = {
            "time": self.time,
            "varied": self.varied,
            "parameters": dict(parameters),
            "inputs": inputs if inputs is None or isinstance(inputs, Mapping) else inputs.copy(),
            "outputs": self.outputs,
            "tolerance": tolerance,
        }
        self._key = next(_keys)
        self._rates: set[tuple[str, str]] = set()
        self._batches: dict[int, NDArray[np.bool_]] = {}
        self._loop: Loop | None = None
        log_runs(description, self.time, parameters, self.varied, tolerance)

    def __reduce__(self) -> tuple[Any, ...]:
        return _planned, (self._fmu, self._settings)

    def run(self, values: ArrayLike = ()) -> FloatArray:
        """Execute one run.

        Args:
            values: the varied parameters in the order of `varied`, shape (len(varied),)

        Returns:
            the samples, shape (samples, variables), in the units of the FMU; Booleans are 0 and 1, and
            integers beyond 2^53 are rounded. Unlike `Fmu.run`, it does not warn of samples that are NaN or
            infinite: searches call it for values that lead there.

        Raises:
            ParameterError: a value is missing, NaN, of the wrong type or out of range, or an output is text
            FmuTimeLimitError: the run takes longer than the FMU's `time_limit`
            FmuEndedError: the FMU terminated the simulation; the error's `samples` are those so far
            FmuRunError: the FMU rejects its settings or fails during the run
        """
        self._require_numbers()
        samples = self._empty(1)
        try:
            self._run_once(self._varied.row(values), samples, load_compiler=True)
        except FmuEndedError as error:
            error.samples = error.samples.numbers
            raise
        run: FloatArray = samples[0]
        return run

    def record(self) -> NDArray[np.void]:
        """Execute one run without varied parameters; returns samples as the FMU stores them, by variable.

        Texts are Python strings.
        """
        return self._run_once(self._varied.row(()), self._empty(1), load_compiler=False)

    def run_batch(
        self,
        table: pd.DataFrame | ArrayLike,
        *,
        threads: int | None = None,
        reductions: Sequence[Reduction] | None = None,
        on_progress: OnProgress | None = None,
    ) -> BatchResult:
        """Execute many runs; results are bitwise independent of the number of threads.

        A failing run is marked and the others go on. Ctrl-C stops within a second and returns the finished
        runs with `BatchResult.interrupted` set; so does `stop` when another thread calls it.

        Args:
            table: one row per run, as an array of shape (runs, len(varied)) or a table with the columns
                `varied` in any order
            threads: number of threads, with one instance of the FMU each; by default the number of cores
                available to this process. An FMU that can be instantiated only once uses one.
            reductions: what to keep of each run; by default every sample
            on_progress: called in the calling thread, about ten times per second, with the number of finished
                runs and of all runs; an exception in it stops the batch and is passed on. By default, a
                notebook shows a progress bar.

        Raises:
            ParameterError: a value of the table is not allowed (the message names its row), a setting is not,
                an output is text, peaks are to be found by the derivative of another variable, or the samples
                do not fit into memory
            UnknownVariableError: a reduction uses a variable that is not among `outputs`
        """
        self._require_numbers()
        stop = np.zeros(1, np.bool_)
        self._batches[id(stop)] = stop  # first, because loading the compiler takes a while
        try:
            with notebook_progress("runs") as show:
                tell = on_progress or (lambda done, runs: show(f"{done} of {runs}", done, runs))
                return self._carry_out(table, stop, threads, reductions, tell)
        finally:
            del self._batches[id(stop)]

    def _require_rates(self, reductions: Sequence[Reduction], numbers: NDArray[Any]) -> None:
        """Reject peaks by the derivative of another variable, as the first run shows them."""
        pairs = {
            (one.variable, one.derivative)
            for one in reductions
            if isinstance(one, Peaks) and one.derivative is not None
        } - self._rates
        if not pairs or not len(numbers):
            return
        try:
            samples = self.run(numbers[0])
        except SimulationError:
            return  # the batch will say why
        for variable, derivative in sorted(pairs):
            value, slope = (samples[:, self.outputs.index(name)] for name in (variable, derivative))
            ratio = ratio_to_rate(self.time, value, slope, smallest=0.0)
            if ratio is not None:
                hint = f"{variable} changes {ratio:.3g} times as fast"
                raise ParameterError("derivative", derivative, f"the time derivative of {variable}", hint)
        self._rates |= pairs

    def _carry_out(
        self,
        table: pd.DataFrame | ArrayLike,
        stop: NDArray[np.bool_],
        threads: int | None,
        reductions: Sequence[Reduction] | None,
        on_progress: OnProgress | None,
    ) -> BatchResult:
        named, numbers = self._varied.table(table)
        runs = len(numbers)
        kept = None if reductions is None else checked_reductions(reductions, self.outputs)
        columns = [] if kept is None else [column for reduction in kept for column in reduction.columns]
        count = number_of_threads(threads, runs, one_instance=self._pool.has_one)
        values = self._empty(runs if kept is None else 0)
        operations = operations_of(kept or (), self.outputs)
        self._require_rates(kept or (), numbers)
        job = self._job(self._rows(numbers), len(columns), stop)
        _LOG.debug("%d runs of %s on at most %d instances", runs, self._pool.description.path.name, count)
        batch = Batch(self._new_runner(job, operations, load_compiler=True), job, values, self.outputs)
        interrupted = batch.carry_out(count, on_progress) if runs else False
        values[~batch.done[: len(values)]] = np.nan
        reduced = None
        if kept is not None:
            import pandas as pd  # see `tables.make_table`

            batch.fail_reductions_not_finite(kept)
            reduced = pd.DataFrame(job.cells, index=named.index, columns=columns)
            reduced.attrs["units"] = units_of(kept, self.units)
        return BatchResult(
            parameters=named,
            values=values if kept is None else None,
            reduced=reduced,
            messages=batch.messages,
            failed=batch.failed,
            done=batch.done,
            interrupted=interrupted,
        )

    def stop(self) -> None:
        """Make running batches of this plan return soon with the finished runs; thread-safe."""
        for stop in tuple(self._batches.values()):
            stop[0] = True

    def carry_out(
        self, rows: NDArray[np.void], cells: int, *, operations: Sequence[Operation], load_compiler: bool
    ) -> Outcome:
        """Execute runs up to the first that fails; called in the process that has received the plan.

        Args:
            rows: varied values, one row per run
            cells: number of results of the operations
            operations: what to keep of each run; if empty, its samples
            load_compiler: as in `stepping.engine.loop`
        """
        job = self._job(rows, cells)
        values = self._empty(1 if operations else len(rows))
        runner = self._new_runner(job, operations, load_compiler=load_compiler)()
        try:
            status = runner.advance(0, len(rows), values)
            failure = None if status in (OK, WARNING) else runner.failure(status)
            raw = runner.recorded() if len(rows) == 1 and failure is None else None
        finally:
            runner.close()
        kept = None if operations else values
        return Outcome(kept, job.cells, job.done, raw, failure, is_fatal=status == FATAL)

    def _run_once(self, row: NDArray[Any], samples: FloatArray, *, load_compiler: bool) -> NDArray[np.void]:
        job = self._job(self._rows(row), 0)
        runner = self._new_runner(job, (), load_compiler=load_compiler)()
        try:
            status = runner.advance(0, 1, samples)
            if status not in (OK, WARNING):
                raise runner.failure(status)[1]
            return runner.recorded()
        finally:
            runner.close()

    def _job(self, rows: NDArray[np.void], cells: int, stop: NDArray[np.bool_] | None = None) -> Job:
        done, kept = np.zeros(len(rows), np.bool_), np.full((len(rows), cells), np.nan)
        stop = np.zeros(1, np.bool_) if stop is None else stop
        return Job(self._preparation, self.time, rows, kept, done, stop, self._pool.time_limit)

    def _new_runner(self, job: Job, operations: Sequence[Operation], *, load_compiler: bool) -> NewRunner:
        """Make the runners of a job: in this process, in separate processes or in sandboxes."""
        if isinstance(self._pool, SandboxPool):
            return partial(SandboxRunner, self._pool, job, operations)
        if isinstance(self._pool, ProcessPool):
            settings = {"operations": operations, "load_compiler": load_compiler}
            return partial(RemoteRunner, self._pool, job, self._key, self._settings, settings)
        return partial(Runner, self._pool, job, self.loop_of(operations, load_compiler=load_compiler))

    def loop_of(self, operations: Sequence[Operation], *, load_compiler: bool) -> Loop:
        """The loop; without reductions it is cached from the first run that loads the compiler."""
        if self._loop is not None and not operations:
            return self._loop
        made = loop(self._preparation.program, operations, self.time, load_compiler=load_compiler)
        if load_compiler and not operations:
            self._loop = made
        return made

    def _rows(self, numbers: NDArray[Any]) -> NDArray[np.void]:
        """The varied values as the FMU stores them, one row per run."""
        rows: NDArray[np.void] = self._preparation.varied.rows(len(numbers))
        for name, column in zip(self.varied, numbers.T, strict=True):
            rows[name] = column
        return rows

    def _require_numbers(self) -> None:
        for variable in self.variables:
            if variable.type == "String":
                hint = "Fmu.run records text"
                raise ParameterError("outputs", variable.name, "a number or Boolean variable", hint)

    def _empty(self, runs: int) -> FloatArray:
        shape = (runs, self.time.size, len(self.outputs))
        try:
            return np.empty(shape)
        except (MemoryError, ValueError):
            size = f"{8 * np.prod(shape, dtype=np.float64) / 2**30:.3g} GiB of samples"
            raise ParameterError("table", size, "smaller, or reduced (see reductions)") from None


def _planned(fmu: Any, settings: dict[str, Any]) -> Plan:
    """Restore a plan from a pickle."""
    plan: Plan = fmu.plan(**settings)
    return plan
