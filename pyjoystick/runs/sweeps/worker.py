"""Workers of a Dask cluster: their tasks, and a check of their installation."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
from distributed import Worker, WorkerPlugin, get_worker
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu, Plan
from pyjoystick.runs.errors import ClusterError
from pyjoystick.runs.sweeps.sweep import Part, Task, part_of
from pyjoystick.support import version_of

#: Packages whose versions may affect the last digits of results.
_NUMERICAL: Final = ("Python", "numpy", "scipy")


class FmuPlugin(WorkerPlugin):
    """Sends an FMU to each worker and keeps it open there until the sweep ends."""

    def __init__(self, name: str, content: bytes, task: Task) -> None:
        """Prepare the plugin.

        Args:
            name: name by which chunks find it
            content: bytes of the .fmu file
            task: the plan
        """
        self.name = name
        self._content = content
        self._task = task
        self._version = version_of("pyjoystick")

    def setup(self, worker: Worker) -> None:
        """Write the FMU's file; called by Dask on every worker, including those that join later."""
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
        """Execute the runs of a table; also returns the time it took (s).

        It uses one thread: Dask gives each of the worker's threads its own chunk.
        """
        here = version_of("pyjoystick")
        if here != self._version:
            raise RuntimeError(f"a worker has pyjoystick {here}, not {self._version}")
        plan = self._opened()
        begin = time.perf_counter()
        result = plan.run_batch(table, threads=1, reductions=self._task.results)
        return part_of(result, runs), time.perf_counter() - begin

    def _opened(self) -> Plan:
        """The plan that all threads share; the first of them opens the FMU."""
        with self._lock:
            if self._plan is None:
                self._fmu = self._task.open(self._path)
                self._plan = self._task.plan(self._fmu)
            return self._plan


def run_chunk(name: str, runs: NDArray[np.int64], table: pd.DataFrame) -> tuple[Part, float]:
    """Dask task: a chunk of runs on the plugin with this name."""
    plugin = get_worker().plugins[name]
    assert isinstance(plugin, FmuPlugin)
    return plugin.run(runs, table)


def check_workers(client: Any, address: str, on_note: Callable[[str], None]) -> None:
    """Compare the versions on every worker with those here.

    Args:
        client: a connected ``distributed.Client``
        address: address of its scheduler, for messages
        on_note: called with a note on each difference that is not fatal

    Raises:
        ClusterError: there are no workers, or one lacks pyjoystick or has another version of it
    """
    here = _versions_function()()
    found: dict[str, dict[str, str]] = client.run(_versions_function())
    if not found:
        raise ClusterError(address, "has no workers; start some with `dask worker ADDRESS`")
    for worker, there in found.items():
        if there["pyjoystick"] != here["pyjoystick"]:
            reason = f"worker {worker} has pyjoystick {there['pyjoystick']}, here is {here['pyjoystick']}"
            raise ClusterError(address, f"{reason}; the same version must be installed on all")
        differing = [name for name in _NUMERICAL if there[name] != here[name]]
        if differing:
            pairs = ", ".join(f"{name} {there[name]} (here {here[name]})" for name in differing)
            on_note(f"worker {worker} has {pairs}: its results may differ in the last digits")
        if there["numba"] == "not installed":
            on_note(f"worker {worker} has no numba and is slow: pip install 'pyjoystick[fast]' there")


def _versions_function() -> Any:
    # A nested function is sent as code, so that it runs where pyjoystick is not installed.
    def versions() -> dict[str, str]:
        import platform
        from importlib import metadata
        from importlib.util import find_spec

        def version(package: str) -> str:
            try:
                return metadata.version(package)
            except metadata.PackageNotFoundError:
                return "not installed"

        packages = ("numpy", "scipy", "numba")
        found = {name: version(name) for name in packages} | {"Python": platform.python_version()}
        # In a bare checkout it can be imported without being installed.
        is_there = find_spec("pyjoystick") is not None
        found["pyjoystick"] = version("pyjoystick") if is_there else "not installed at all"
        return found

    return versions
