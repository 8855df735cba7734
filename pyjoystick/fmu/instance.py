"""One instance of an FMU, and what its statuses mean."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.errors import FmuRunError
from pyjoystick.fmu.log import FmuLog
from pyjoystick.fmu.stepping.program import BETWEEN_RUNS, FATAL, FLAGS_SIZE, POINT, Workspace


@dataclass(slots=True)
class Instance:
    """One instance of an FMU.

    Attributes:
        description: the FMU
        fmi: FMPy's object, one method an FMI function
        log: what the instance says
        is_new: no run has been begun yet
        is_broken: it can run no more
        is_lost: not even to be freed: the standard forbids every call after a fatal error
    """

    description: FmuDescription
    fmi: Any
    log: FmuLog
    is_new: bool = True
    is_broken: bool = False
    is_lost: bool = False
    _workspace: Workspace | None = field(default=None, init=False)

    def workspace(self, raw_size: int) -> Workspace:
        """Memory for the compiled loop, with room for so many bytes of samples."""
        if self._workspace is None or self._workspace.raw.size != raw_size:
            raw, flags = np.zeros(raw_size, np.uint8), np.zeros(FLAGS_SIZE, np.uint8)
            address = int(self.fmi.component)
            place = self.log.place
            place[POINT] = BETWEEN_RUNS
            self._workspace = Workspace(address, place, raw, raw.ctypes.data, flags, flags.ctypes.data)
        return self._workspace

    @contextmanager
    def reporting(self, time: float) -> Iterator[None]:
        """Turn a failing call of FMPy into an `FmuRunError` at `time` (s) with the messages of the FMU."""
        self.log.attach()
        self.log.clear()
        try:
            yield
        except FMICallException as error:
            self.is_lost = self.is_lost or error.status == FATAL
            reason = str(error).rstrip(".")
            path, messages = self.description.path, tuple(self.log.messages())
            raise FmuRunError(time, reason, path, messages) from error

    def free(self) -> None:
        """Free it for good, unless it is lost."""
        if not self.is_lost:
            free = getattr(self.fmi, f"fmi{self.description.fmi_version[0]}FreeInstance")
            free(self.fmi.component)
        self.log.close()
