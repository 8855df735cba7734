"""A thread that makes running loops return to Python periodically, to check for Ctrl-C and time limits.

The loop checks a flag after each communication step, which is cheaper than reading the clock.
"""

from __future__ import annotations

import os
import threading
import time as clock
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.stepping.program import PAUSE

#: Interval between two pulses (s).
INTERVAL: Final = 0.1


class Pulse:
    """The thread, started on first use, also in a forked process; it sleeps while nothing runs."""

    def __init__(self) -> None:
        self._places: dict[int, NDArray[np.intp]] = {}
        self._process = 0
        self._wanted = threading.Event()

    def add(self, place: NDArray[np.intp]) -> None:
        """Set the flag in a workspace's place at each pulse from now on."""
        self._places[id(place)] = place
        if self._process != os.getpid():
            self._process, self._wanted = os.getpid(), threading.Event()
            threading.Thread(target=self._beat, args=(self._wanted,), daemon=True).start()
        if not self._wanted.is_set():
            self._wanted.set()

    def remove(self, place: NDArray[np.intp]) -> None:
        """Stop setting the flag."""
        del self._places[id(place)]

    def _beat(self, wanted: threading.Event) -> None:
        while True:
            if not self._places:
                wanted.clear()
                if not self._places:  # check again: `add` may have been called in between
                    wanted.wait()
            clock.sleep(INTERVAL)
            for place in list(self._places.values()):
                place[PAUSE] = 1


#: Shared by all runs in this process.
PULSE: Final = Pulse()
