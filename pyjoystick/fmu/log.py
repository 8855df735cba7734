"""Messages of FMUs, collected per instance.

FMI 2 loggers take printf arguments, which Python cannot read. FMPy's native proxy formats them (on the
caller's stack, so that threads do not interfere) and passes them to a single Python function per process.
That function is defined here, is never garbage-collected, and distinguishes instances by their environment
pointers. FMI 3 loggers take finished text and are one function per instance.
"""

from __future__ import annotations

import itertools
from collections import deque
from ctypes import byref
from typing import Any

import numpy as np
from fmpy import calloc, free
from fmpy.fmi1 import printLogMessage
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy
from numpy.typing import NDArray

from pyjoystick.fmu.stepping.program import PLACE_SIZE, RUN

#: Number of messages kept per instance, the newest ones.
_KEPT = 200

_logs: dict[int, FmuLog] = {}
_environments = itertools.count(1)


class FmuLog:
    """Messages of one instance of an FMU.

    Attributes:
        callbacks: callbacks for creating an FMI 2 instance
        place: progress of the instance, kept up to date by the loop that drives it
    """

    def __init__(self, place: NDArray[np.intp] | None = None) -> None:
        self.place: NDArray[np.intp] = np.zeros(PLACE_SIZE, np.intp) if place is None else place
        self._messages: deque[tuple[int, str]] = deque(maxlen=_KEPT)
        self._environment = next(_environments)
        _logs[self._environment] = self
        self.callbacks: Any = fmi2CallbackFunctions(
            logger=_receive_function,
            allocateMemory=_allocate,
            freeMemory=_free,
            componentEnvironment=self._environment,
        )
        self.attach()

    def attach(self) -> None:
        """Make the native proxy call this module; another user of FMPy may have replaced its target."""
        self.callbacks.logger = _receive_function
        addLoggerProxy(byref(self.callbacks))

    def add(self, text: bytes) -> None:
        """Store a message of the current run."""
        self._messages.append((int(self.place[RUN]), text.decode("utf-8", errors="replace")))

    def messages(self) -> list[str]:
        """Texts of the current run, oldest first."""
        run = int(self.place[RUN])
        return [text for its_run, text in self._messages if its_run == run]

    def clear(self) -> None:
        """Clear the messages."""
        self._messages.clear()

    def close(self) -> None:
        """Unregister the instance; later messages are printed."""
        _logs.pop(self._environment, None)


def _receive(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    log = _logs.get(environment or 0)
    if log is None:
        printLogMessage(environment, instance, status, category, message)
    else:
        # "##" is an escaped "#", which otherwise starts a reference to a variable.
        log.add(message.replace(b"##", b"#"))


_receive_function = fmi2CallbackLoggerTYPE(_receive)
_allocate = fmi2CallbackAllocateMemoryTYPE(calloc)
_free = fmi2CallbackFreeMemoryTYPE(free)
