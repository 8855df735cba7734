"""What a Dask worker does: it is sent the FMU once, and carries out chunks of runs on it."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from distributed import Worker, WorkerPlugin, get_worker
from numpy.typing import NDArray

from pyjoystick._types import FloatArray
from pyjoystick.fmu import Fmu, Inputs, Plan, Reduction
from pyjoystick.fmu.values import Value
from pyjoystick.sweeps.sweep import Part, part_of
from pyjoystick.versions import version_of


@dataclass(frozen=True, slots=True)
class Task:
    """What all chunks of a sweep share; see `Fmu.plan`."""

    time: FloatArray
    varied: tuple[str, ...]
    parameters: Mapping[str, Value]
    inputs: Inputs
    outputs: Sequence[str]
    tolerance: float
    results: tuple[Reduction, ...]


class FmuPlugin(WorkerPlugin):
    """Carries an FMU to each worker, and keeps it open there until the sweep ends.

    Every thread of the worker works on an open FMU of its own, which it takes from those that are idle.
    """

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
        """Unpack on the worker; called by Dask on every worker, those that join later included."""
        self._stack = ExitStack()
        self._lock = threading.Lock()
        self._idle: list[Plan] = []
        self._path = Path(worker.local_directory) / f"{self.name}.fmu"
        self._path.write_bytes(self._content)
        self._stack.callback(self._path.unlink, missing_ok=True)

    def teardown(self, worker: Worker) -> None:
        """Close the FMUs and delete the file."""
        self._stack.close()

    def run(self, runs: NDArray[np.int64], table: pd.DataFrame) -> tuple[Part, float]:
        """Carry out the runs of a table on one thread; also the time it took (s)."""
        here = version_of("pyjoystick")
        if here != self._version:
            raise RuntimeError(f"a worker has pyjoystick {here}, not {self._version}")
        begin = time.perf_counter()
        with self._plan() as plan:
            result = plan.run_batch(table, threads=1, reductions=self._task.results)
        return part_of(result, runs), time.perf_counter() - begin

    @contextmanager
    def _plan(self) -> Iterator[Plan]:
        with self._lock:
            plan = self._idle.pop() if self._idle else None
        if plan is None:
            plan = self._opened()
        yield plan
        with self._lock:
            self._idle.append(plan)

    def _opened(self) -> Plan:
        task = self._task
        fmu = Fmu(self._path)
        with self._lock:
            self._stack.callback(fmu.close)
        return fmu.plan(
            task.time,
            varied=task.varied,
            parameters=task.parameters,
            inputs=task.inputs,
            outputs=task.outputs,
            tolerance=task.tolerance,
        )


def run_chunk(name: str, runs: NDArray[np.int64], table: pd.DataFrame) -> tuple[Part, float]:
    """The task of Dask: a chunk of runs on the plugin with this name."""
    plugin = get_worker().plugins[name]
    assert isinstance(plugin, FmuPlugin)
    return plugin.run(runs, table)
