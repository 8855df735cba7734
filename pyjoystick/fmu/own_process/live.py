"""A live instance in a separate process."""

from __future__ import annotations

import os
from functools import partial
from typing import Any

from pyjoystick.fmu.own_process.pool import ProcessPool


class RemoteLiveInstance:
    """Like `pyjoystick.fmu.live.LiveInstance`; other attributes are forwarded to the process."""

    def __init__(self, pool: ProcessPool, time: float, *settings: Any) -> None:
        self._pool = pool
        self._user = os.getpid()
        self._process = pool.take()
        try:
            pool.ask(self._process, time, "start", time, *settings)
        except BaseException:
            self.abandon()
            raise

    def stop(self, time: float = 0.0) -> None:
        """See `LiveInstance`; in a forked process, the parent's process is left alone."""
        if os.getpid() == self._user:
            try:
                self._call("stop", time)
            finally:
                self._pool.give_back(self._process)

    def abandon(self) -> None:
        """End the process; in a forked process, the parent's process is left alone."""
        if os.getpid() == self._user:
            self._process.close()
            self._pool.give_back(self._process)

    def __getattr__(self, name: str) -> Any:
        return partial(self._call, name)

    def _call(self, name: str, time: float, *arguments: Any) -> Any:
        return self._pool.ask(self._process, time, "live", name, time, *arguments)
