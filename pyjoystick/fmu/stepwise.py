"""An FMU stepped call by call, in this process or another."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.own_process.pool import ProcessPool, new_pool
from pyjoystick.fmu.own_process.process import OwnProcess


@contextmanager
def stepped(description: FmuDescription) -> Iterator[Instance | RemoteInstance]:
    """Make a Co-Simulation instance, in a separate process if `Fmu` would use one.

    Raises:
        UnsupportedFmuError, FmuFileError: as in `Fmu`
    """
    pool = new_pool(description, None, None)
    try:
        if isinstance(pool, InstancePool):
            with pool.lent() as instance:
                yield instance
        else:
            with pool.lent() as process:
                yield RemoteInstance(pool, process)
    finally:
        pool.close()


class RemoteInstance:
    """Like `Instance`, in a separate process; missing attributes are forwarded to it."""

    def __init__(self, pool: ProcessPool, process: OwnProcess) -> None:
        self._pool = pool
        self._process = process
        self._time = 0.0
        pool.ask(process, self._time, "instantiate")

    @contextmanager
    def reporting(self, time: float) -> Iterator[None]:
        """Context for calls at `time` (s); raises as `Instance.reporting`."""
        self._time = time
        yield

    def forget(self, state: int) -> None:
        """See `Instance.forget`; states are lost together with the process."""
        if self._process.is_alive:
            self._call("forget", state)

    def __getattr__(self, name: str) -> Any:
        return partial(self._call, name)

    def _call(self, name: str, *arguments: Any) -> Any:
        return self._pool.ask(self._process, self._time, "call", name, self._time, arguments)
