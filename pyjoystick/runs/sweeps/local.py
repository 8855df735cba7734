"""Runs of a sweep on the cores of this machine."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Generator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu
from pyjoystick.runs.sweeps.chunks import Chunks
from pyjoystick.runs.sweeps.sweep import Part, Sweep, part_of

#: What a chunk should take (s): so much is lost at most when the process is killed.
_CHUNK: Final = 2.0


def run_locally(
    sweep: Sweep, pending: NDArray[np.int64], threads: int | None, on_progress: Callable[[int], None]
) -> Generator[Part]:
    """Carry out the runs with the given numbers, chunk by chunk.

    Args:
        sweep: the sweep
        pending: numbers of the runs
        threads: number of threads; the cores that this process may use where not given
        on_progress: called with the number of runs done so far

    Raises:
        KeyboardInterrupt: on Ctrl-C, after the runs that were finished have been handed over
        FmuFileError, UnsupportedFmuError: the FMU cannot be run here
        ParameterError: the FMU refuses the settings of every run
    """
    least = threads or os.cpu_count() or 1
    chunks = Chunks(pending, seconds=_CHUNK, slots=1, least=least)
    done = 0
    with Fmu(sweep.settings.fmu.path) as fmu:
        task = sweep.task
        plan = task.plan(fmu)

        def show(finished: int, _: int) -> None:
            on_progress(done + finished)

        while (runs := chunks.take()).size:
            begin = time.perf_counter()
            result = plan.run_batch(
                sweep.design.iloc[runs],
                threads=threads,
                reductions=task.results,
                on_progress=show,
            )
            chunks.timed(runs.size, time.perf_counter() - begin)
            yield part_of(result, runs)
            if result.interrupted:
                raise KeyboardInterrupt
            done += int(runs.size)
            on_progress(done)
