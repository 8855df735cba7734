"""Runs of a sweep on the workers of a Dask cluster."""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import time
import uuid
import warnings
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager, suppress
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.runs.errors import ClusterError
from pyjoystick.runs.sweeps.chunks import Chunks
from pyjoystick.runs.sweeps.sweep import Part, Sweep
from pyjoystick.support import MissingPackageError, PyJoystickError

try:
    from dask import config as dask_config
    from distributed import Client, Future, wait
    from distributed.comm.addressing import get_address_host_port
    from distributed.comm.core import CommClosedError
    from distributed.scheduler import KilledWorker

    from pyjoystick.runs.sweeps.worker import FmuPlugin, check_workers, run_chunk
except ImportError as error:
    raise MissingPackageError("sweeps on a cluster", "cluster") from error

#: Target duration of a chunk (s); at most this much work is lost with a worker.
_CHUNK: Final = 1.0
#: Number of chunks sent per thread of a worker, so that threads need not wait for the next one.
_AHEAD: Final = 2
#: Time to reach the scheduler (s).
_TIMEOUT: Final = 5.0
#: Number of attempts to call all workers if some are lost meanwhile, and pause between attempts (s).
_ATTEMPTS: Final = 5
_PAUSE: Final = 0.5

_LOST: Final = "the connection was lost; what was finished is kept"

OnNote = Callable[[str], None]


def run_on_cluster(
    sweep: Sweep,
    pending: NDArray[np.int64],
    address: str,
    on_progress: Callable[[int], None],
    on_note: OnNote,
) -> Generator[Part]:
    """Execute the runs with the given numbers; chunks of lost workers are given to others.

    Args:
        sweep: the sweep
        pending: numbers of the runs
        address: address of the scheduler, such as ``tcp://10.0.0.1:8786``
        on_progress: called with the number of finished runs
        on_note: called with notes on differing versions and on a cluster without workers

    Raises:
        ClusterError: the scheduler cannot be reached or has no workers, the versions do not match, the
            connection is lost, or a chunk crashes worker after worker
        FmuFileError, UnsupportedFmuError, ParameterError: the workers cannot run the FMU with these settings
    """
    content = sweep.settings.fmu.path.read_bytes()
    try:
        with _connected(address, on_note) as client:
            _despite_lost_workers(lambda: check_workers(client, address, on_note))
            with _shipped(client, sweep, content) as name:
                yield from _carry_out(_Work(client, address, sweep, name, pending), on_progress, on_note)
    except (OSError, asyncio.CancelledError) as error:
        raise ClusterError(address, f"{_LOST} ({error})" if str(error) else _LOST) from error


def _carry_out(work: _Work, on_progress: Callable[[int], None], on_note: OnNote) -> Generator[Part]:
    done = 0
    try:
        while work.proceed(on_note):
            for part in work.finished():
                yield part
                done += int(part.runs.size)
                on_progress(done)
    except KeyboardInterrupt:
        yield from work.finished()
        raise
    finally:
        work.cancel()


class _Work:
    """The chunks in progress."""

    def __init__(
        self, client: Client, address: str, sweep: Sweep, name: str, pending: NDArray[np.int64]
    ) -> None:
        self._client = client
        self._address = address
        self._design = sweep.design
        self._name = name
        self._chunks = Chunks(pending, seconds=_CHUNK, slots=1)
        self._futures: dict[Future[Any], NDArray[np.int64]] = {}

    def proceed(self, on_note: OnNote) -> bool:
        """Send chunks to workers with free slots and wait briefly; False when everything is done."""
        slots = sum(self._client.nthreads().values())
        self._chunks.slots = max(slots, 1)
        while len(self._futures) < _AHEAD * self._chunks.slots and (runs := self._chunks.take()).size:
            future = self._client.submit(
                run_chunk, self._name, runs, self._design.iloc[runs], pure=False, retries=0
            )
            self._futures[future] = runs
        if not self._futures:
            return False
        if not slots:
            on_note("the cluster has no workers; waiting for one (Ctrl-C keeps what is done)")
        # A lost connection cancels the futures; `finished` then reports it.
        with self._client.as_current(), suppress(TimeoutError, concurrent.futures.CancelledError):
            wait(list(self._futures), timeout=1.0, return_when="FIRST_COMPLETED")
        return True

    def finished(self) -> Iterator[Part]:
        """Chunks that have returned since the last call."""
        for future in [one for one in self._futures if one.done()]:
            part, seconds = self._result(future)
            del self._futures[future]
            self._chunks.timed(int(part.runs.size), seconds)
            yield part

    def cancel(self) -> None:
        """Cancel the work in progress."""
        if self._futures and self._client.status == "running":
            self._client.cancel(list(self._futures))
        self._futures.clear()

    def _result(self, future: Future[Any]) -> tuple[Part, float]:
        if future.cancelled():
            raise ClusterError(self._address, _LOST)
        try:
            result: tuple[Part, float] = future.result()
        except KilledWorker as error:
            runs = self._futures[future]
            reason = (
                f"runs {runs[0]} to {runs[-1]} were lost with one worker after another; "
                "the FMU may crash in one of them"
            )
            raise ClusterError(self._address, reason) from error
        except PyJoystickError:
            raise
        except (CommClosedError, concurrent.futures.CancelledError) as error:
            # Lost after the check of `cancelled`.
            raise ClusterError(self._address, _LOST) from error
        except Exception as error:  # any failure on a worker
            raise ClusterError(self._address, f"a worker failed: {type(error).__name__}: {error}") from error
        return result


@contextmanager
def _connected(address: str, on_note: OnNote) -> Iterator[Client]:
    """Connect a client to the scheduler."""
    log = logging.getLogger("distributed.client")
    level = log.level
    # Its log messages are already in the errors that it raises.
    log.setLevel(logging.CRITICAL)
    try:
        client = _client(address, on_note)
        try:
            yield client
        finally:
            client.close(timeout=_TIMEOUT)
    finally:
        log.setLevel(level)


def _client(address: str, on_note: OnNote) -> Client:
    try:
        # A client with an invalid address would hang during garbage collection.
        get_address_host_port(address)
    except ValueError as error:
        raise ClusterError(address, f"is not an address like tcp://HOST:PORT: {error}") from error
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            with dask_config.set({"distributed.comm.timeouts.connect": _TIMEOUT}):
                client = Client(address, timeout=_TIMEOUT, set_as_default=False)
        except (OSError, ValueError, ImportError) as error:
            raise ClusterError(address, f"cannot be reached: {error}") from error
    for warning in said:
        on_note(str(warning.message))
    return client


@contextmanager
def _shipped(client: Client, sweep: Sweep, content: bytes) -> Iterator[str]:
    """Send the FMU to every worker; returns the name of the plugin that provides it."""
    name = f"pyjoystick-{uuid.uuid4().hex}"
    plugin = FmuPlugin(name, content, sweep.task)
    try:
        _despite_lost_workers(lambda: client.register_plugin(plugin, name=name))
        yield name
    finally:
        if client.status == "running":
            # A worker lost now loses its FMU too; one that was never reached has none.
            with suppress(OSError, ValueError):
                client.unregister_worker_plugin(name)


def _despite_lost_workers(speak: Callable[[], object]) -> None:
    """Call all workers; repeat the call if one is lost before it answers."""
    for _ in range(_ATTEMPTS - 1):
        with suppress(CommClosedError):
            speak()
            return
        time.sleep(_PAUSE)
    speak()
