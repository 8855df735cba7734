"""The messages of FMUs, collected instance by instance.

FMI 2 loggers take printf arguments, which Python cannot read. FMPy's native proxy formats them (on the stack
of its caller, so that threads do not meet there), and has room for one Python function in the whole process.
So there is one function here, never garbage-collected, that tells the instances apart by the environment
pointer each was given. FMI 3 loggers take finished texts and are one function an instance.
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

#: So many messages of an instance are kept, the newest.
_KEPT = 200

_logs: dict[int, FmuLog] = {}
_environments = itertools.count(1)


class FmuLog:
    """The messages of one instance of an FMU.

    Attributes:
        callbacks: what an instance of FMI 2 is to be made with
        place: where the instance is, kept up to date by the loop that drives it
        interrupted: Ctrl-C fell into the receiving of a message, out of which no exception finds its way
    """

    def __init__(self, place: NDArray[np.intp] | None = None) -> None:
        self.place: NDArray[np.intp] = np.zeros(PLACE_SIZE, np.intp) if place is None else place
        self.interrupted = False
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
        """Have the native proxy call this module; another user of FMPy may have taken it over since."""
        self.callbacks.logger = _receive_function
        addLoggerProxy(byref(self.callbacks))

    def add(self, text: bytes) -> None:
        """Keep a message of the run that is under way."""
        try:
            self._messages.append((int(self.place[RUN]), text.decode("utf-8", errors="replace")))
        except KeyboardInterrupt:
            self.interrupted = True

    def messages(self) -> list[str]:
        """Texts of the run that is under way, oldest first."""
        run = int(self.place[RUN])
        return [text for its_run, text in self._messages if its_run == run]

    def clear(self) -> None:
        """Forget the messages."""
        self._messages.clear()

    def close(self) -> None:
        """Forget the instance; what it still says is printed."""
        _logs.pop(self._environment, None)


def _receive(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    log = _logs.get(environment or 0)
    if log is None:
        printLogMessage(environment, instance, status, category, message)
    else:
        # "##" stands for one "#", which else begins a reference to a variable.
        log.add(message.replace(b"##", b"#"))


_receive_function = fmi2CallbackLoggerTYPE(_receive)
_allocate = fmi2CallbackAllocateMemoryTYPE(calloc)
_free = fmi2CallbackFreeMemoryTYPE(free)
