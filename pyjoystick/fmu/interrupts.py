"""Ctrl-C while native code runs.

Python handles a signal at its next instruction. While an FMU runs, that is the first instruction of a
function that the FMU calls, such as its logger. No exception can pass through the FMU: ctypes discards it and
calls ``sys.unraisablehook``, and Ctrl-C would have no effect.
"""

from __future__ import annotations

import sys
import threading
from types import TracebackType
from typing import Any


class CtrlC:
    """Context that raises a Ctrl-C which arrived in a function called by native code, when that returns.

    Raises:
        KeyboardInterrupt: on leaving, unless another exception is on its way
    """

    __slots__ = ("_arrived", "_others")

    def __enter__(self) -> None:
        self._arrived = False
        self._others: Any = None
        # Only the main thread receives Ctrl-C.
        if threading.current_thread() is threading.main_thread():
            self._others, sys.unraisablehook = sys.unraisablehook, self._keep

    def __exit__(
        self, kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        if self._others is not None:
            sys.unraisablehook = self._others
        if self._arrived and kind is None:
            raise KeyboardInterrupt

    def _keep(self, unraisable: sys.UnraisableHookArgs, /) -> None:
        if issubclass(unraisable.exc_type, KeyboardInterrupt):
            self._arrived = True
        else:
            self._others(unraisable)
