"""Sweeps on a local Dask scheduler with worker processes; everything listens on 127.0.0.1 only."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any, cast

import numpy as np
import pandas as pd
import pytest
from distributed import Client, Future
from distributed.scheduler import KilledWorker

from benchmarks.dask_processes import DaskProcesses, kill
from pyjoystick.fmu import FmuFileError
from pyjoystick.runs import ClusterError, Outcome, Sweep, read_settings, run_sweep
from pyjoystick.runs.sweeps import cluster as cluster_module
from pyjoystick.runs.sweeps.worker import FmuPlugin, check_workers
from pyjoystick.support import MissingPackageError
from tests.pyjoystick.runs.sweeps.conftest import LONG, Write

# Without xdist's grouping each of its workers would have a cluster of its own.
pytestmark = pytest.mark.xdist_group("dask")

_PATIENCE = 120.0  # s, for a machine with much else to do


class Cluster:
    """One cluster for all tests; what a test has killed is started anew for the next."""

    def __init__(self, factory: pytest.TempPathFactory) -> None:
        self._factory = factory
        self._dask: DaskProcesses | None = None

    def of(self, workers: int) -> DaskProcesses:
        """A scheduler with so many workers of one thread each, or more."""
        dask = self._dask
        if dask is None or dask.scheduler is None or dask.scheduler.poll() is not None:
            self.stop()
            dask = self._dask = DaskProcesses(self._factory.mktemp("dask"))
            dask.start(0)
        dask.add(max(0, workers - len(_alive(dask))))
        return dask

    def stop(self) -> None:
        if self._dask is not None:
            self._dask.stop()


def _alive(dask: DaskProcesses) -> list[int]:
    """Numbers of the workers that are there."""
    return [i for i, process in enumerate(dask.workers) if process.poll() is None]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    one = Cluster(tmp_path_factory)
    yield one
    one.stop()


def _on(cluster: DaskProcesses, sweep: Sweep, target: Path, on_progress: Callable[[int], None]) -> Outcome:
    """The sweep on the cluster, which may need a moment until its workers are there."""
    end = time.monotonic() + _PATIENCE
    while True:
        try:
            return run_sweep(sweep, target, scheduler=cluster.address, on_progress=on_progress)
        except ClusterError as error:
            if "has no workers" not in error.reason or time.monotonic() > end:
                raise
            time.sleep(0.2)


def test_mistakes_come_back_from_the_workers_as_they_are(
    small_sweep: Sweep, tmp_path: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    dask = cluster.of(1)
    content = small_sweep.settings.fmu.path.read_bytes()
    monkeypatch.setattr(Path, "read_bytes", lambda path: content[: len(content) // 2])
    with pytest.raises(FmuFileError, match="not an FMU"):
        _on(dask, small_sweep, tmp_path / "a.csv", lambda _: None)


def test_a_worker_is_lost_in_mid_run_and_the_numbers_are_the_local_ones(
    written: Write, tmp_path: Path, cluster: Cluster, long_table: pd.DataFrame
) -> None:
    sweep = Sweep(read_settings(written(LONG)))
    dask = cluster.of(2)
    lost, *left = _alive(dask)
    lost_at = []

    def lose_a_worker(done: int) -> None:
        if done and not lost_at:
            lost_at.append(done)
            kill(dask.workers[lost])

    outcome = _on(dask, sweep, tmp_path / "a.parquet", lose_a_worker)
    assert 0 < lost_at[0] < 4096 / 2
    assert (outcome.done, outcome.failed) == (4096, 0)
    assert outcome.table is not None
    pd.testing.assert_frame_equal(outcome.table, long_table, check_exact=True)
    # The FMU has been taken off the workers that are left.
    for number in left:
        assert list((dask.folder / f"worker{number}").rglob("*.fmu")) == []


def test_a_worker_is_lost_while_the_fmu_is_sent(
    small_sweep: Sweep, tmp_path: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    dask = cluster.of(2)
    lost, *_ = (dask.workers[number] for number in _alive(dask))
    sent = []
    register = Client.register_plugin

    def stop_a_worker(client: Client, address: str, on_note: Callable[[str], None]) -> None:
        check_workers(client, address, on_note)
        client.wait_for_workers(2, timeout=_PATIENCE)
        # It stops before it hears of the FMU, and is gone before it can answer.
        os.kill(lost.pid, signal.SIGSTOP)
        threading.Timer(0.5, kill, [lost]).start()

    def counted(client: Client, plugin: FmuPlugin, name: str) -> object:
        sent.append(name)
        return register(client, plugin, name=name)

    monkeypatch.setattr(cluster_module, "check_workers", stop_a_worker)
    monkeypatch.setattr(Client, "register_plugin", counted)
    outcome = _on(dask, small_sweep, tmp_path / "a.csv", lambda _: None)
    assert len(sent) > 1
    assert (outcome.done, outcome.failed) == (12, 0)


@pytest.mark.parametrize("noticed", ["between two results", "by a result"])
def test_ctrl_c_and_a_lost_scheduler_lose_nothing(
    written: Write,
    tmp_path: Path,
    cluster: Cluster,
    long_table: pd.DataFrame,
    monkeypatch: pytest.MonkeyPatch,
    noticed: str,
) -> None:
    sweep = Sweep(read_settings(written(LONG)))
    dask = cluster.of(1)
    target = tmp_path / "a.parquet"

    def ctrl_c(done: int) -> None:
        if done:
            raise KeyboardInterrupt

    stopped = _on(dask, sweep, target, ctrl_c)
    assert stopped.interrupted
    assert 0 < stopped.done < 4096

    reported: list[int] = []
    result = Future.result

    def lose_the_scheduler() -> None:
        assert dask.scheduler is not None
        kill(dask.scheduler)

    def on_progress(done: int) -> None:
        if done > stopped.done:
            reported.append(done)
            if noticed == "between two results":
                lose_the_scheduler()

    def result_that_is_lost(future: Future[Any]) -> object:
        if reported and noticed == "by a result":
            lose_the_scheduler()
            while not future.cancelled():
                time.sleep(0.01)
        return result(future)

    monkeypatch.setattr(Future, "result", result_that_is_lost)

    with pytest.raises(ClusterError, match="the connection was lost; what was finished is kept"):
        run_sweep(sweep, target, scheduler=dask.address, on_progress=on_progress)
    # Begun on a cluster, finished on this machine.
    outcome = run_sweep(sweep, target)
    assert stopped.done < outcome.found < 4096
    assert outcome.table is not None
    pd.testing.assert_frame_equal(outcome.table, long_table, check_exact=True)


def test_a_scheduler_that_is_not_there(
    small_sweep: Sweep, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster_module, "_TIMEOUT", 0.5)
    begin = time.monotonic()
    with pytest.raises(ClusterError, match=r"tcp://127.0.0.1:9: cannot be reached"):
        run_sweep(small_sweep, tmp_path / "a.csv", scheduler="tcp://127.0.0.1:9")
    assert time.monotonic() - begin < _PATIENCE


@pytest.mark.parametrize("address", ["nonsense", "nonsense://x:1", "tcp://127.0.0.1"])
def test_what_is_no_address_is_said_at_once(small_sweep: Sweep, tmp_path: Path, address: str) -> None:
    with pytest.raises(ClusterError, match=f"{address}: is not an address like tcp://HOST:PORT"):
        run_sweep(small_sweep, tmp_path / "a.csv", scheduler=address)


def test_runs_that_crash_worker_after_worker_are_named(
    small_sweep: Sweep, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Lost:
        def cancelled(self) -> bool:
            return False

        def done(self) -> bool:
            return True

        def result(self) -> None:
            raise KilledWorker("run_chunk", "tcp://b", 3)

    class Client:
        def nthreads(self) -> dict[str, int]:
            return {"tcp://b": 1}

        def submit(self, *arguments: object, **options: object) -> Lost:
            return Lost()

        def as_current(self) -> AbstractContextManager[None]:
            return nullcontext()

    work = cluster_module._Work(cast(Any, Client()), "tcp://s", small_sweep, "plugin", np.array([7]))
    monkeypatch.setattr(cluster_module, "wait", lambda *arguments, **options: None)
    assert work.proceed(lambda _: None)
    with pytest.raises(ClusterError, match="runs 7 to 7 were lost with one worker after another"):
        list(work.finished())


class _Workers:
    """What a client with two workers answers."""

    def __init__(self, **versions: str) -> None:
        self._versions = versions

    def run(self, function: Callable[[], dict[str, str]]) -> dict[str, dict[str, str]]:
        here = function()
        return {"tcp://a": here, "tcp://b": here | self._versions}


def test_versions_that_differ_are_told() -> None:
    said: list[str] = []
    check_workers(_Workers(), "tcp://s", said.append)
    assert said == []
    check_workers(_Workers(numpy="1.0", numba="not installed"), "tcp://s", said.append)
    assert len(said) == 2
    assert "tcp://b has numpy 1.0 (here " in said[0]
    assert "tcp://b has no numba and is slow" in said[1]


@pytest.mark.parametrize("version", ["0.0.1", "not installed at all"])
def test_another_pyjoystick_is_refused(version: str) -> None:
    with pytest.raises(ClusterError, match=f"worker tcp://b has pyjoystick {version}, here is"):
        check_workers(_Workers(pyjoystick=version), "tcp://s", lambda _: None)


def test_a_cluster_without_workers_is_an_error() -> None:
    class Nobody:
        def run(self, function: Any) -> dict[str, dict[str, str]]:
            return {}

    with pytest.raises(ClusterError, match="has no workers"):
        check_workers(Nobody(), "tcp://s", lambda _: None)


def test_without_dask_the_message_says_what_to_install(
    small_sweep: Sweep, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    for module in ("cluster", "worker"):
        monkeypatch.delitem(sys.modules, f"pyjoystick.runs.sweeps.{module}", raising=False)
    with pytest.raises(MissingPackageError, match=r"pip install 'pyjoystick\[cluster\]'"):
        run_sweep(small_sweep, tmp_path / "a.csv", scheduler="tcp://127.0.0.1:9")
    assert not (tmp_path / "a.csv").exists()
