"""A Dask scheduler and workers as local processes that listen on 127.0.0.1 only."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from benchmarks.errors import BenchmarkError

_LOOPBACK: Final = ("--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0")
_PATIENCE: Final = 120.0  # s, enough for a busy machine


@dataclass
class DaskProcesses:
    """One scheduler and its workers, with one thread each.

    Attributes:
        folder: for their files and logs
        address: of the scheduler, once it has started
        scheduler: its process
        workers: their processes
    """

    folder: Path
    address: str = ""
    scheduler: subprocess.Popen[bytes] | None = None
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def start(self, workers: int) -> None:
        """Start all; it may take a moment until the workers have registered with the scheduler.

        Raises:
            BenchmarkError: the scheduler does not start
        """
        file = self.folder / "scheduler.json"
        self.scheduler = self._run("dask_scheduler", "--port", "0", "--scheduler-file", str(file))
        end = time.monotonic() + _PATIENCE
        while not self.address:
            if self.scheduler.poll() is not None or time.monotonic() > end:
                raise BenchmarkError("the Dask scheduler does not start")
            time.sleep(0.05)
            if file.exists() and file.stat().st_size:
                self.address = str(json.loads(file.read_text(encoding="utf-8"))["address"])
        self.add(workers)

    def add(self, workers: int) -> None:
        """Start more workers."""
        for _ in range(workers):
            folder = self.folder / f"worker{len(self.workers)}"
            options = ("--nthreads", "1", "--no-nanny", "--local-directory", str(folder))
            self.workers.append(self._run("dask_worker", self.address, *options))

    def stop(self) -> None:
        """Kill all remaining processes; on a polite request, a worker would wait for its scheduler."""
        for process in (*self.workers, *([self.scheduler] if self.scheduler else [])):
            kill(process)

    def _run(self, program: str, *arguments: str) -> subprocess.Popen[bytes]:
        with (self.folder / f"{program}{len(self.workers)}.log").open("wb") as log:
            command = [sys.executable, "-m", f"distributed.cli.{program}", *_LOOPBACK, *arguments]
            return subprocess.Popen(command, stdout=log, stderr=log)


def kill(process: subprocess.Popen[bytes]) -> None:
    """Kill a process at once (SIGKILL)."""
    process.kill()
    process.wait()
