"""What a Dask worker does: it is sent the FMU once, and carries out chunks of runs on it."""

from __future__ import annotations

import threading
import time
from pathlib import Path

import numpy as np
import pandas as pd
from distributed import Worker, WorkerPlugin, get_worker
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu, Plan
from pyjoystick.runs.sweeps.sweep import Part, Task, part_of
from pyjoystick.support import version_of


class FmuPlugin(WorkerPlugin):
    """Carries an FMU to each worker, and keeps it open there until the sweep ends."""

    def __init__(self, name: str, content: bytes, task: Task) -> None:
        """Prepare the plugin.

        Args:
            name: by which chunks find it
            content: the bytes of the .fmu file
            task: the plan
        """
        self.name = name
        self._content = content
        self._task = task
        self._version = version_of("pyjoystick")

    def setup(self, worker: Worker) -> None:
        """Write the FMU's file; called by Dask on every worker, those that join later included."""
        self._lock = threading.Lock()
        self._plan: Plan | None = None
        self._fmu: Fmu | None = None
        self._path = Path(worker.local_directory) / f"{self.name}.fmu"
        self._path.write_bytes(self._content)

    def teardown(self, worker: Worker) -> None:
        """Close the FMU and delete its file."""
        if self._fmu is not None:
            self._fmu.close()
        self._path.unlink(missing_ok=True)

    def run(self, runs: NDArray[np.int64], table: pd.DataFrame) -> tuple[Part, float]:
        """Carry out the runs of a table; also the time it took (s).

        It takes one thread: Dask gives each of the worker's threads a chunk of its own.
        """
        here = version_of("pyjoystick")
        if here != self._version:
            raise RuntimeError(f"a worker has pyjoystick {here}, not {self._version}")
        plan = self._opened()
        begin = time.perf_counter()
        result = plan.run_batch(table, threads=1, reductions=self._task.results)
        return part_of(result, runs), time.perf_counter() - begin

    def _opened(self) -> Plan:
        """The plan that all threads share; the FMU is opened by the first of them."""
        with self._lock:
            if self._plan is None:
                self._fmu = Fmu(self._path)
                self._plan = self._task.plan(self._fmu)
            return self._plan


def run_chunk(name: str, runs: NDArray[np.int64], table: pd.DataFrame) -> tuple[Part, float]:
    """The task of Dask: a chunk of runs on the plugin with this name."""
    plugin = get_worker().plugins[name]
    assert isinstance(plugin, FmuPlugin)
    return plugin.run(runs, table)
