"""Multi-threaded execution of many runs of one plan."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import FmuEndedError, FmuFileError
from pyjoystick.fmu.not_finite import first_not_finite
from pyjoystick.fmu.own_process.runner import RemoteRunner
from pyjoystick.fmu.reductions import Reduction, not_finite
from pyjoystick.fmu.runner import Job, Runner, Samples
from pyjoystick.fmu.sandbox.runner import SandboxRunner
from pyjoystick.fmu.stepping.program import OK, STOPPED
from pyjoystick.support import FloatArray, PyJoystickError, Shown, whole_number

if TYPE_CHECKING:
    import pandas as pd

#: Called in the calling thread with the number of finished runs and the number of all runs.
OnProgress = Callable[[int, int], None]

AnyRunner = Runner | RemoteRunner | SandboxRunner
NewRunner = Callable[[], AnyRunner]

_LARGEST_PIECE: Final = 64
#: Interval at which the progress of the threads is checked (s).
_INTERVAL: Final = 0.1
#: Time to wait for threads that have been asked to stop (s); their current step may never end. On a busy
#: machine even a short one can take a second. Threads that miss it leave their temporary folder behind.
_GRACE: Final = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class BatchResult(Shown):
    """Results of many runs, one row per run in the order of the given table.

    Attributes:
        parameters: the varied parameters, one column per name, with the index of the given table
        values: samples, shape (runs, samples, variables); NaN in runs that failed or were not done, and after
            the end of runs that the FMU terminated, but not in runs that failed because results are not
            finite; None if the runs were reduced
        reduced: results of the reductions, one column each, indexed as `parameters`, NaN as in `values`; its
            ``attrs["units"]`` has the unit of each column. None if there are no reductions.
        messages: empty for a successful run, else when and why it failed, with the FMU's messages
        failed: shape (runs,), True for runs that started and did not reach their end, or have results that
            are not finite
        done: shape (runs,), True for finished runs, including failed ones
        interrupted: the batch was stopped by Ctrl-C or `Plan.stop`; runs may be missing
    """

    _shown_by = "pyjoystick.fmu.notebook"

    parameters: pd.DataFrame
    values: FloatArray | None
    reduced: pd.DataFrame | None
    messages: list[str]
    failed: NDArray[np.bool_]
    done: NDArray[np.bool_]
    interrupted: bool


def number_of_threads(threads: int | None, runs: int, *, one_instance: bool) -> int:
    """Number of threads for a batch; raises ParameterError unless it is a whole number above zero."""
    if threads is None:
        threads = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    threads = whole_number("threads", threads, 1)
    return 1 if one_instance else max(1, min(threads, runs))


class Batch:
    """The runs of a job, handed out to threads in pieces.

    Attributes:
        messages: empty, or why the run failed, by run
        failed: shape (runs,)
        done: shape (runs,), set by the loop during its work
    """

    def __init__(self, new_runner: NewRunner, job: Job, values: FloatArray, outputs: Sequence[str]) -> None:
        """Prepare the batch.

        Args:
            new_runner: makes a runner for the job; called once per thread
            job: the runs
            values: samples of all runs, shape (runs, samples, variables), or shape (0, samples, variables) if
                each thread needs room for one run only
            outputs: names of the variables
        """
        self._new_runner = new_runner
        self._job = job
        self._values = values
        self._outputs = outputs
        runs = len(job.rows)
        self.messages = [""] * runs
        self.failed = np.zeros(runs, np.bool_)
        self.done = job.done
        self._lock = threading.Lock()
        self._next = 0
        self._working = 0
        self._finished = threading.Event()
        self._returned: list[tuple[int, int]] = []
        self._refusal = ""
        self._error: BaseException | None = None

    def stop(self) -> None:
        """Ask the threads to stop after their current step."""
        self._job.stop[0] = True

    def carry_out(self, threads: int, on_progress: OnProgress | None) -> bool:
        """Work until everything is done or stopped; returns whether it was stopped.

        Raises:
            FmuFileError: the FMU cannot be instantiated even once
        """
        waiting = self._runners(threads)
        self._working = self._threads = len(waiting)
        try:
            while waiting:
                self._start(waiting.pop())
            self._watch(on_progress)
        except BaseException as error:
            self.stop()
            for runner in waiting:
                self._finish(runner)
            self._wait_a_little()
            if not isinstance(error, KeyboardInterrupt):
                raise
        if self._error is not None:
            raise self._error
        is_stopped = bool(self._job.stop[0])
        if self._refusal and not is_stopped:
            self._fail_what_is_left()
        return is_stopped

    def fail_reductions_not_finite(self, reductions: Sequence[Reduction]) -> None:
        """Fail the finished runs with reductions that are not finite, because outputs of the FMU are not."""
        cells = self._job.cells
        for run, column in not_finite(reductions, cells).items():
            if self.done[run] and not self.failed[run]:
                self._mark_failed(run, f"{column} is not finite: an output of the FMU was not")
                cells[run] = np.nan

    def _start(self, runner: AnyRunner) -> None:
        # Daemon threads: a step that never ends must not keep the process alive.
        thread = threading.Thread(target=self._work, args=(runner,), daemon=True)
        try:
            thread.start()
        except RuntimeError:  # no more threads; after Ctrl-C instead, the thread may be running
            self._finish(runner)
            raise

    def _runners(self, threads: int) -> list[AnyRunner]:
        runners: list[AnyRunner] = []
        try:
            while len(runners) < threads:
                runners.append(self._new_runner())
        except PyJoystickError:
            if not runners:
                raise
            # An FMU that allows fewer instances runs on fewer threads.
        except BaseException:
            for runner in runners:
                runner.close()
            raise
        return runners

    def _watch(self, on_progress: OnProgress | None) -> None:
        told = -1
        is_finished = False
        while not is_finished and not self._job.stop[0]:
            is_finished = self._finished.wait(_INTERVAL)
            count = int(np.count_nonzero(self.done))
            if on_progress is not None and count != told:
                on_progress(count, len(self.done))
                told = count
        self._wait_a_little()

    def _wait_a_little(self) -> None:
        with suppress(KeyboardInterrupt):
            self._finished.wait(_GRACE)

    def _work(self, runner: AnyRunner) -> None:
        try:
            values = self._values if len(self._values) else np.empty((1, *self._values.shape[1:]))
            while (piece := self._piece()) is not None:
                try:
                    self._run_piece(runner, *piece, values)
                finally:
                    self._fail_samples_not_finite(*piece)
        except FmuFileError as error:  # a broken instance could not be replaced
            self._refusal = str(error)
        except BaseException as error:  # handed over to the calling thread
            self._error = error
            self.stop()
        finally:
            self._finish(runner)

    def _finish(self, runner: AnyRunner) -> None:
        runner.close()
        with self._lock:
            self._working -= 1
            if not self._working:
                self._finished.set()

    def _piece(self) -> tuple[int, int] | None:
        """The next runs for a thread: many at first, few at the end, so that all threads end together."""
        with self._lock:
            if self._job.stop[0]:
                return None
            if self._returned:
                return self._returned.pop()
            left = len(self.done) - self._next
            if not left:
                return None
            first = self._next
            self._next += min(_LARGEST_PIECE, max(1, left // (4 * self._threads)))
            return first, self._next

    def _run_piece(self, runner: AnyRunner, first: int, last: int, values: FloatArray) -> None:
        while first < last:
            try:
                status = runner.advance(first, last, values)
            except FmuFileError:
                with self._lock:
                    first += int(np.argmin(self.done[first:last]))
                    self._returned.append((first, last))
                raise
            if status in (OK, STOPPED) or self._job.stop[0]:
                return
            run, error = runner.failure(status)
            self._mark_failed(run, str(error), error.samples if isinstance(error, FmuEndedError) else None)
            first = run + 1

    def _fail_samples_not_finite(self, first: int, last: int) -> None:
        """Fail the finished runs of a piece with samples that are not finite; their samples are kept.

        The threads do this, because it takes a hundredth of the time of a run.
        """
        samples = self._values[first:last]  # empty if the runs are reduced
        for i in np.flatnonzero(~np.isfinite(samples).all(axis=(1, 2))):
            run = first + int(i)
            if self.done[run] and not self.failed[run]:
                columns = dict(zip(self._outputs, samples[i].T, strict=True))
                said = first_not_finite(self._job.instants, columns)
                self.messages[run] = f"results are not finite: {said}"
                self.failed[run] = True

    def _mark_failed(self, run: int, message: str, samples: Samples | None = None) -> None:
        if len(self._values):
            self._values[run] = np.nan
        if len(self._values) and samples is not None:
            # A sample between two points of the table has no row.
            kept = np.isin(samples.instants, self._job.instants)
            self._values[run, : np.count_nonzero(kept)] = samples.numbers[kept]
        self.messages[run] = message
        self.failed[run] = self.done[run] = True

    def _fail_what_is_left(self) -> None:
        for run in np.flatnonzero(~self.done).tolist():
            self._mark_failed(run, self._refusal)
