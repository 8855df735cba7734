"""Execution of a plan's runs on one instance, with errors for runs that fail."""

from __future__ import annotations

import threading
import time as clock
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import FmuEndedError, FmuRunError, FmuTimeLimitError
from pyjoystick.fmu.failures import failure
from pyjoystick.fmu.interrupts import CtrlC
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.preparation import Preparation
from pyjoystick.fmu.pulse import PULSE
from pyjoystick.fmu.stepping.decoding import decode
from pyjoystick.fmu.stepping.engine import Loop
from pyjoystick.fmu.stepping.kernel import transfer
from pyjoystick.fmu.stepping.program import (
    BETWEEN_RUNS,
    FATAL,
    FUNCTION,
    LATE,
    OK,
    POINT,
    RESET,
    RUN,
    SAMPLES,
    STOPPED,
    UNFINISHED,
    WARNING,
)
from pyjoystick.support import FloatArray

_GOOD: Final = (OK, WARNING, UNFINISHED, STOPPED)


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Samples of a run that the FMU terminated.

    Attributes:
        instants: sample times (s), shape (n,); the last may be between two communication points
        numbers: shape (n, variables)
        raw: as the FMU stores them, by variable, shape (n,)
    """

    instants: FloatArray
    numbers: FloatArray
    raw: NDArray[np.void]


@dataclass(frozen=True, slots=True, eq=False)
class Job:
    """Runs to execute, and arrays for their results.

    Attributes:
        preparation: what the runs share
        instants: sample times (s), shape (samples,)
        rows: varied values, one row per run
        cells: results of reductions, shape (runs, cells)
        done: runs that reached their end, shape (runs,)
        stop: set it to end the work, shape (1,)
        time_limit: time limit of a run (s)
    """

    preparation: Preparation
    instants: FloatArray
    rows: NDArray[np.void]
    cells: FloatArray
    done: NDArray[np.bool_]
    stop: NDArray[np.bool_]
    time_limit: float | None = None


class Runner:
    """Executes runs of a job on its own instance, which it replaces if it breaks."""

    def __init__(self, pool: InstancePool, job: Job, loop: Loop) -> None:
        """Take an instance; raises as `InstancePool.take`.

        Args:
            pool: instances of the FMU
            job: the runs
            loop: from `stepping.engine`
        """
        self._pool = pool if job.preparation.drive is None else pool.updating()
        self._job = job
        self._loop = loop
        self._rows_address = job.rows.ctypes.data
        self._has_instance = False
        self._take()

    def close(self) -> None:
        """Return the instance to the pool."""
        if self._has_instance:
            self._give_back()

    def advance(self, first: int, last: int, values: FloatArray) -> int:
        """Execute the runs `first` to `last` - 1, see `stepping.kernel.run_many`.

        Returns:
            OK, STOPPED, or a status that requires a call of `failure`

        Raises:
            FmuFileError: another instance is needed, and the FMU cannot be instantiated
            KeyboardInterrupt: Ctrl-C, with a short delay
        """
        if self._pool.resets:
            return self._on_one_instance(first, last, values)
        status = OK
        for run in range(first, last):
            status = self._on_one_instance(run, run + 1, values)
            if status not in (OK, WARNING):
                break
            self._give_back()  # the next run needs a new instance
        return status

    def _on_one_instance(self, first: int, last: int, values: FloatArray) -> int:
        """`advance` on one instance."""
        limit = self._job.time_limit
        run, since = first, clock.monotonic()
        while True:
            status = self._go_on(run, last, values)
            if status != UNFINISHED:
                return status
            before, run = run, int(self._workspace.place[RUN])
            if run != before:
                since = clock.monotonic()
            elif limit is not None and clock.monotonic() - since > limit:
                return LATE

    def _go_on(self, first: int, last: int, values: FloatArray) -> int:
        """Start the loop, or resume it after a pause."""
        if not self._has_instance:
            self._take(first)
        job, instance = self._job, self._instance
        is_new, instance.is_new = instance.is_new, False
        rows = self._rows_address, first, last
        place = self._workspace.place
        # Only the main thread receives Ctrl-C.
        is_watched = job.time_limit is not None or threading.current_thread() is threading.main_thread()
        if is_watched:
            PULSE.add(place)
        try:
            with CtrlC():
                status = self._loop(self._workspace, is_new, *rows, values, job.cells, job.done, job.stop)
        finally:
            if is_watched:
                PULSE.remove(place)
        if instance.intermediate_update is not None and instance.intermediate_update.failure is not None:
            raise instance.intermediate_update.failure
        if job.preparation.texts is not None:
            job.preparation.texts.check()
        if status in _GOOD or place[FUNCTION] != RESET:
            return status
        # Leftovers of an earlier run caused the failure, not the run itself.
        run = int(place[RUN])
        self._abandon(is_lost=status == FATAL)
        return self._go_on(run, last, values)

    def failure(self, status: int) -> tuple[int, FmuRunError]:
        """Index and error of the run that failed with this status; prepares the runner for the next run."""
        instance, place, preparation = self._instance, self._workspace.place, self._job.preparation
        run, reached = int(place[RUN]), float(preparation.program.times[place[POINT]])
        if status == LATE:
            reason = f"the run took longer than the time limit of {self._job.time_limit:g} s"
            messages = tuple(instance.log.messages())
            error: FmuRunError = FmuTimeLimitError(reached, reason, instance.description.path, messages)
        else:
            error = failure(instance, self._workspace, preparation.interface, status, reached)
        if isinstance(error, FmuEndedError):
            error.samples = self._samples_until(error.time)
        instance.log.clear()
        self._abandon(is_lost=status == FATAL)
        return run, error

    def _samples_until(self, end: float) -> Samples:
        """The recorded samples, plus one at the end if none was taken there."""
        program, place = self._job.preparation.program, self._workspace.place
        instants = program.times[program.recorded][: place[SAMPLES]].tolist()
        if not instants or instants[-1] < end:
            row = self._workspace.raw_address + len(instants) * program.outputs_stride
            if transfer(program, self._workspace, program.outputs, row) in (OK, WARNING):
                instants.append(end)
        numbers = np.full((len(instants), max(program.columns, default=-1) + 1), np.nan)
        decode(program.outputs, program.columns, self._workspace.raw, program.outputs_stride, numbers)
        return Samples(np.array(instants), numbers, self.recorded(len(instants)))

    def recorded(self, count: int | None = None) -> NDArray[np.void]:
        """The first `count` samples of the last run as the FMU stores them, by variable, shape (samples,).

        Texts are Python strings. Of a run that ended early, the other samples have none: no address to read.
        """
        raw: NDArray[np.void] = self._workspace.raw.view(self._job.preparation.outputs.dtype)
        return self._job.preparation.outputs.readable(raw[:count].copy())

    def _take(self, run: int = 0) -> None:
        if self._pool.place is not None:
            self._pool.place[RUN] = run  # to blame this run if instantiation crashes
        self._instance = self._pool.take()
        self._has_instance = True
        self._instance.log.attach()
        self._instance.log.clear()
        size = self._job.instants.size * self._job.preparation.program.outputs_stride
        self._workspace = self._instance.workspace(size)
        if self._instance.intermediate_update is not None:
            self._instance.intermediate_update.drive = self._job.preparation.drive
            self._instance.intermediate_update.place = self._workspace.place
            self._instance.intermediate_update.failure = None

    def _abandon(self, *, is_lost: bool) -> None:
        self._instance.is_broken, self._instance.is_lost = True, is_lost
        self._give_back()

    def _give_back(self) -> None:
        self._workspace.place[POINT] = BETWEEN_RUNS
        self._has_instance = False
        self._pool.give_back(self._instance)
