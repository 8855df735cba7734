"""The messages of FMUs, collected instance by instance.

FMI 2 loggers take printf arguments, which Python cannot read. FMPy's native proxy formats them, and has room
for one Python function in the whole process. So there is one function here, never garbage-collected, that
tells the instances apart by the environment pointer each was given.
"""

from __future__ import annotations

import itertools
from collections import deque
from ctypes import byref
from typing import Any

from fmpy import calloc, free
from fmpy.fmi1 import printLogMessage
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

#: So many messages of an instance are kept, the newest.
_KEPT = 200

_logs: dict[int, FmuLog] = {}
_environments = itertools.count(1)


class FmuLog:
    """The messages of one instance of an FMU.

    Attributes:
        callbacks: what the instance is to be made with
        messages: texts, oldest first
    """

    def __init__(self) -> None:
        self.messages: deque[str] = deque(maxlen=_KEPT)
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

    def close(self) -> None:
        """Forget the instance; what it still says is printed."""
        _logs.pop(self._environment, None)


def _receive(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    log = _logs.get(environment or 0)
    if log is None:
        printLogMessage(environment, instance, status, category, message)
    else:
        # "##" stands for one "#", which else begins a reference to a variable.
        log.messages.append(message.decode("utf-8", errors="replace").replace("##", "#"))


_receive_function = fmi2CallbackLoggerTYPE(_receive)
_allocate = fmi2CallbackAllocateMemoryTYPE(calloc)
_free = fmi2CallbackFreeMemoryTYPE(free)
