"""Execution of a plan's runs in a separate process."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import FmuRunError
from pyjoystick.fmu.own_process.pool import ProcessPool, run_error
from pyjoystick.fmu.own_process.process import OwnProcess, ProcessEndedError
from pyjoystick.fmu.runner import Job
from pyjoystick.fmu.stepping.program import ERROR, OK, STOPPED
from pyjoystick.support import FloatArray

#: Target duration of a group of runs (s); if a run crashes, its group must be repeated.
_GROUP_TIME: Final = 0.1
#: Number of first runs without the compiler, which would be loaded in vain if they crash the process.
_PLAIN_RUNS: Final = 4


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """Results of some runs, up to the first that failed.

    Attributes:
        values: samples, shape (runs, samples, variables), unless they are reduced
        cells: results of the operations, shape (runs, cells)
        done: shape (runs,)
        raw: samples as the FMU stores them, if there was one run
        failure: index of the run that failed, and the error
        is_fatal: whether the failure also made the process unusable for other runs
    """

    values: FloatArray | None
    cells: FloatArray
    done: NDArray[np.bool_]
    raw: NDArray[np.void] | None
    failure: tuple[int, FmuRunError] | None
    is_fatal: bool


class RemoteRunner:
    """Like `pyjoystick.fmu.runner.Runner`, in a process that is replaced when it ends."""

    def __init__(
        self, pool: ProcessPool, job: Job, key: int, plan: Mapping[str, Any], settings: Mapping[str, Any]
    ) -> None:
        """Initialize without a process, so that several runners can start theirs at the same time.

        Args:
            pool: processes that have loaded the FMU
            job: the runs
            key: identifies the plan
            plan: settings of the plan
            settings: settings for `Plan.carry_out`
        """
        self._pool = pool
        self._job = job
        self._key = key
        self._plan = plan
        self._settings = settings
        self._process: OwnProcess | None = None
        self._group = 1
        self._raw: NDArray[np.void] | None = None
        self._failed: tuple[int, FmuRunError] | None = None

    def close(self) -> None:
        """Return the process to the pool."""
        if self._process is not None:
            process, self._process = self._process, None
            self._pool.give_back(process)

    def advance(self, first: int, last: int, values: FloatArray) -> int:
        """Execute the runs `first` to `last` - 1, up to the first that fails.

        Returns:
            OK, STOPPED, or ERROR, which requires a call of `failure`

        Raises:
            FmuFileError: the FMU cannot be loaded again
        """
        self._failed = None
        while first < last and not self._job.stop[0]:
            end = min(last, first + self._group)
            begin = clock.perf_counter()
            try:
                outcome = self._ask(first, end)
            except ProcessEndedError as ended:
                if self._job.stop[0]:
                    return STOPPED
                # Earlier runs of its group were finished but lost; repeat them, up to the crash.
                self._failed = first + ended.run, self._error(ended)
                last = first + ended.run
                continue
            finally:
                if self._process is not None and not self._pool.is_reusable(self._process):
                    self.close()
            self._keep(outcome, first, end, values)
            if outcome.failure is not None:
                run, error = outcome.failure
                self._failed = first + run, error
                return ERROR
            self._set_group(clock.perf_counter() - begin)
            first = end
        if self._job.stop[0]:
            return STOPPED
        return OK if self._failed is None else ERROR

    def failure(self, _status: int) -> tuple[int, FmuRunError]:
        """Index of the run that failed, and the error."""
        assert self._failed is not None
        return self._failed

    def recorded(self) -> NDArray[np.void]:
        """Samples of the last run as the FMU stores them, shape (samples,)."""
        assert self._raw is not None
        return self._raw

    def _ask(self, first: int, end: int) -> Outcome:
        if self._process is None:
            self._process = self._pool.take()
        process = self._process
        load_compiler = self._settings["load_compiler"] and process.runs >= _PLAIN_RUNS
        if process.plan != (self._key, load_compiler):
            process.ask("plan", self._plan, load_compiler)
            process.plan = self._key, load_compiler
        outcome: Outcome = process.ask(
            "carry_out",
            self._job.rows[first:end],
            self._job.cells.shape[1],
            {**self._settings, "load_compiler": load_compiler},
            time_limit=self._pool.time_limit,
            is_stopped=lambda: bool(self._job.stop[0]),
        )
        process.runs += end - first
        if outcome.is_fatal:
            process.close()
        return outcome

    def _set_group(self, took: float) -> None:
        if self._process is None:
            self._group = 1  # a new process starts with one run
        else:
            self._group = 2 * self._group if took < _GROUP_TIME else max(1, self._group // 2)

    def _keep(self, outcome: Outcome, first: int, end: int, values: FloatArray) -> None:
        done = first + np.flatnonzero(outcome.done)
        if outcome.values is not None:
            values[done] = outcome.values[outcome.done]
        self._job.cells[first:end] = outcome.cells
        self._job.done[done] = True
        self._raw = outcome.raw

    def _error(self, ended: ProcessEndedError) -> FmuRunError:
        times = self._job.preparation.program.times
        # Without a point, it had not begun, or it was freeing the instance of a finished run.
        point = -1 if ended.point < 0 and ended.samples else max(0, ended.point)
        return run_error(ended, float(times[point]), self._pool.description.path)
