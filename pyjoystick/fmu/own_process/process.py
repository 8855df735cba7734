"""A separate process for an FMU."""

from __future__ import annotations

import logging
import math
import mmap
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time as clock
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.stepping.program import BETWEEN_RUNS, PLACE_SIZE, POINT, RUN, SAMPLES
from pyjoystick.support import PyJoystickError

_LOG = logging.getLogger(__name__)

#: Interval for checking the time limit and stop requests (s).
_INTERVAL: Final = 0.05
#: Time that a process has to answer after a stop request (s).
_GRACE: Final = 0.3
#: Size of the kept part of the FMU's output, at its end (bytes).
_KEPT: Final = 2000
#: The child prints this before each request, which separates the output of the FMU's runs.
NEW_REQUEST: Final = b"\0request\0"
_CODE: Final = "import sys; sys.path[:] = {path!r}; from {module} import main; main({place!r})"
#: Named, not imported, because the module loads what the parent does not need.
_CHILD: Final = "pyjoystick.fmu.own_process.child"


class ProcessEndedError(PyJoystickError):
    """The process crashed or was killed, as the message explains.

    Attributes:
        run: index of the run in progress
        point: communication point that it had reached, negative if none
        samples: number of samples that it had taken
        is_late: whether the reason was the time limit
    """

    def __init__(self, reason: str, place: NDArray[np.intp], *, is_late: bool) -> None:
        super().__init__(reason)
        self.run, self.point, self.samples, self.is_late = *map(int, place[[RUN, POINT, SAMPLES]]), is_late


class OwnProcess:
    """A child process and its state.

    Attributes:
        plan: key of the plan that it has received
        runs: number of runs that it has executed
        is_alive: whether it accepts requests
    """

    def __init__(self, folder: Path) -> None:
        """Start the process.

        Args:
            folder: its temporary folder, which the caller deletes
        """
        self.plan: object = None
        self.runs = 0
        self.is_alive = True
        handle, place_file = tempfile.mkstemp(prefix="place-", dir=folder)
        with os.fdopen(handle, "r+b") as file:
            file.truncate(PLACE_SIZE * np.dtype(np.intp).itemsize)
            self._place = np.frombuffer(mmap.mmap(file.fileno(), 0), np.intp, PLACE_SIZE)
        code = _CODE.format(path=sys.path, module=_CHILD, place=place_file)
        self._process = subprocess.Popen(
            [sys.executable, "-c", code],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            # Shield it from Ctrl-C, and this process from signals that the FMU sends to its group.
            start_new_session=True,
        )
        _LOG.debug("started process %d", self._process.pid)
        self._answers: SimpleQueue[tuple[bool, Any] | None] = SimpleQueue()
        self._printed = b""
        self._readers = [threading.Thread(target=read, daemon=True) for read in (self._read, self._listen)]
        for reader in self._readers:
            reader.start()

    def ask(
        self,
        name: str,
        *arguments: Any,
        time_limit: float = math.inf,
        is_stopped: Callable[[], bool] = lambda: False,
    ) -> Any:
        """Make it execute a method of `service.Service`.

        Args:
            name: name of the method
            arguments: arguments of the method
            time_limit: limit for the request, or for each of several runs (s)
            is_stopped: polled; returns whether the answer is no longer wanted

        Raises:
            ProcessEndedError: it crashed, took too long, or was killed because the answer is no longer wanted
            Exception: any exception that the method raises
        """
        self._place[[RUN, SAMPLES]], self._place[POINT] = 0, BETWEEN_RUNS
        try:
            self._send((name, arguments))
            answer = self._wait(time_limit, is_stopped)
        except BaseException:
            self.close()
            raise
        is_good, value = answer
        if not is_good:
            raise value
        return value

    def close(self) -> None:
        """End the process; may be called more than once."""
        if self.is_alive:
            self.is_alive = False
            self._kill()
            self._process.wait()
            _LOG.debug("ended process %d after %d runs", self._process.pid, self.runs)
            self._place = self._place.copy()  # the file will be deleted
            pipes = self._process.stdout, self._process.stderr
            for pipe, reader in zip(pipes, self._readers, strict=True):
                reader.join(_GRACE)
                if pipe is not None and not reader.is_alive():
                    pipe.close()
            with suppress(OSError):  # unsent data are no longer needed
                assert self._process.stdin is not None
                self._process.stdin.close()

    def _kill(self) -> None:
        """Kill it and all processes that the FMU has started."""
        with suppress(ProcessLookupError, PermissionError):
            if hasattr(os, "killpg"):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()

    def _send(self, request: tuple[str, tuple[Any, ...]]) -> None:
        content = pickle.dumps(request, pickle.HIGHEST_PROTOCOL)
        assert self._process.stdin is not None
        with suppress(OSError):  # it has exited, as the reader of its answers will notice
            self._process.stdin.write(content)
            self._process.stdin.flush()

    def _wait(self, limit: float, is_stopped: Callable[[], bool]) -> tuple[bool, Any]:
        begin, run, asked = clock.monotonic(), 0, 0.0
        while True:
            try:
                answer = self._answers.get(timeout=_INTERVAL)
            except Empty:
                now = clock.monotonic()
                if self._place[RUN] != run:
                    begin, run = now, int(self._place[RUN])
                if now - begin > limit:
                    reason = f"it took longer than the time limit of {limit:g} s and was ended"
                    raise ProcessEndedError(reason, self._place, is_late=True) from None
                if is_stopped():
                    asked = asked or now
                    if now - asked > _GRACE:
                        raise ProcessEndedError("it was stopped", self._place, is_late=False) from None
                continue
            if answer is None:
                raise ProcessEndedError(self._why_it_ended(), self._place, is_late=False)
            return answer

    def _why_it_ended(self) -> str:
        try:
            code = self._process.wait(timeout=5.0)
        except subprocess.TimeoutExpired:
            reason = "its process closed the connection to this one"
        else:
            names = {-one.value: one.name for one in signal.Signals}
            by = f"was ended by {names[code]}" if code in names else f"ended with exit code {code}"
            reason = f"its process {by}"
        self._readers[1].join(_GRACE)
        printed = self._printed.rpartition(NEW_REQUEST)[2].decode(errors="replace").strip()
        return f"{reason}; it printed last: {printed}" if printed else reason

    def _read(self) -> None:
        """Collect the answers; None marks the end."""
        assert self._process.stdout is not None
        try:
            while True:
                self._answers.put(pickle.load(self._process.stdout))
        except Exception:  # end of the stream, or garbage from a crashing process or its FMU
            self._answers.put(None)

    def _listen(self) -> None:
        """Keep the end of the FMU's output."""
        assert self._process.stderr is not None
        while octets := os.read(self._process.stderr.fileno(), 65536):
            self._printed = (self._printed + octets)[-_KEPT:]
