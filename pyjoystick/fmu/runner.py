"""One instance that carries out runs of a plan, and the error of a run that fails."""

from __future__ import annotations

import threading
import time as clock
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import FmuRunError, FmuTimeLimitError
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.preparation import Preparation
from pyjoystick.fmu.pulse import PULSE
from pyjoystick.fmu.stepping.engine import Loop
from pyjoystick.fmu.stepping.program import (
    BETWEEN_RUNS,
    EARLY,
    ENDED,
    FATAL,
    FUNCTION,
    LATE,
    OK,
    POINT,
    RESET,
    RUN,
    STOPPED,
    UNFINISHED,
    WARNING,
)
from pyjoystick.support import FloatArray

_LABELS: Final = ("ok", "warning", "discard", "error", "fatal", "pending")
_GOOD: Final = (OK, WARNING, UNFINISHED, STOPPED)


@dataclass(frozen=True, slots=True)
class Job:
    """What runners work on.

    Attributes:
        loop: from `stepping.engine`
        preparation: what the runs share
        samples: number of samples of a run
        rows: the values that vary, one row a run
        cells: results of reductions, shape (runs, cells)
        done: runs that came to their end, shape (runs,)
        stop: to be set by whoever wants the work to end, shape (1,)
        time_limit: what a run may take (s)
    """

    loop: Loop
    preparation: Preparation
    samples: int
    rows: NDArray[np.void]
    cells: FloatArray
    done: NDArray[np.bool_]
    stop: NDArray[np.bool_]
    time_limit: float | None = None


class Runner:
    """Carries out runs of a job on an instance of its own, which it replaces where it breaks."""

    def __init__(self, pool: InstancePool, job: Job) -> None:
        """Take an instance; raises as `InstancePool.take`."""
        self._pool = pool
        self._job = job
        self._rows_address = job.rows.ctypes.data
        self._has_instance = False
        self._take()

    def close(self) -> None:
        """Give the instance back."""
        if self._has_instance:
            self._instance.log.place[POINT] = BETWEEN_RUNS
            self._give_back()

    def advance(self, first: int, last: int, values: FloatArray) -> int:
        """Carry out the runs `first` to `last` - 1, see `stepping.kernel.run_many`.

        Returns:
            OK, STOPPED, or a status that calls for `failure`

        Raises:
            FmuFileError: another instance is needed, and the FMU refuses it
            KeyboardInterrupt: Ctrl-C, within a moment
        """
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
        """Begin, or go on where the loop has paused."""
        if not self._has_instance:
            self._take()
        job, instance = self._job, self._instance
        is_new, instance.is_new = instance.is_new, False
        rows = self._rows_address, first, last
        place = self._workspace.place
        # Ctrl-C is heard in the main thread alone.
        is_watched = job.time_limit is not None or threading.current_thread() is threading.main_thread()
        if is_watched:
            PULSE.add(place)
        try:
            status = job.loop(self._workspace, is_new, *rows, values, job.cells, job.done, job.stop)
        finally:
            if is_watched:
                PULSE.remove(place)
        if instance.log.interrupted:
            instance.log.interrupted = False
            raise KeyboardInterrupt
        if job.preparation.texts is not None:
            job.preparation.texts.check()
        if status in _GOOD or place[FUNCTION] != RESET:
            return status
        # What was there before the run stands in its way: nothing that the run itself is to be blamed for.
        run = int(place[RUN])
        self._abandon(is_lost=status == FATAL)
        return self._go_on(run, last, values)

    def failure(self, status: int) -> tuple[int, FmuRunError]:
        """The run that failed with this status, and why; the runner is then ready for the next one."""
        instance, place, preparation = self._instance, self._workspace.place, self._job.preparation
        function = preparation.interface.functions[place[FUNCTION]]
        kind = FmuRunError
        if status == ENDED:
            reason = "the FMU ended the run"
        elif status == LATE:
            kind = FmuTimeLimitError
            reason = f"the run took longer than the limit of {self._job.time_limit:g} s"
        elif status == EARLY:
            reason = f"{function} came back before the end of the step"
        else:
            label = _LABELS[status] if 0 <= status < len(_LABELS) else "not a status"
            reason = f"{function} failed with status {status} ({label})"
        reached = preparation.program.times[place[POINT]]
        error = kind(reached, reason, instance.description.path, tuple(instance.log.messages()))
        run = int(place[RUN])
        place[POINT] = BETWEEN_RUNS
        instance.log.clear()
        if status == FATAL:
            self._abandon(is_lost=True)
        return run, error

    def recorded(self) -> NDArray[np.void]:
        """The samples of the last run as the FMU gave them, one field a variable, shape (samples,).

        Texts are Python's.
        """
        raw: NDArray[np.void] = self._workspace.raw.view(self._job.preparation.outputs.dtype)
        return self._job.preparation.outputs.readable(raw.copy())

    def _take(self) -> None:
        self._instance = self._pool.take()
        self._has_instance = True
        self._instance.log.attach()
        self._instance.log.clear()
        size = self._job.samples * self._job.preparation.program.outputs_stride
        self._workspace = self._instance.workspace(size)

    def _abandon(self, *, is_lost: bool) -> None:
        self._instance.is_broken, self._instance.is_lost = True, is_lost
        self._give_back()

    def _give_back(self) -> None:
        self._has_instance = False
        self._pool.give_back(self._instance)
