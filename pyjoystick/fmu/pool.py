"""The instances of one FMU: made when needed, used by one thread at a time, kept for the next run."""

from __future__ import annotations

import os
import threading

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.library import FmuLibrary
from pyjoystick.support import PyJoystickError


class InstancePool:
    """Instances of an FMU, and its library.

    Attributes:
        library: unpacked and loaded
    """

    def __init__(self, description: FmuDescription) -> None:
        """Load the FMU and make the first instance, which shows that it can be run.

        Raises:
            UnsupportedFmuError, FmuFileError: as `FmuLibrary`, or the FMU refuses to be instantiated
        """
        self.library = FmuLibrary(description, "CoSimulation")
        self._process = os.getpid()
        self._state = threading.Condition()
        self._taken = 0
        self._closed = False
        try:
            self._idle = [self.library.instantiate()]
        except BaseException:
            self.library.close()
            raise

    def take(self) -> Instance:
        """An instance for the caller alone, until it is given back.

        An FMU that can be instantiated only once is waited for.

        Raises:
            PyJoystickError: the pool has been closed
            FmuFileError: the FMU refuses another instance
        """
        description = self.library.description
        with self._state:
            while description.one_instance and self._taken and not self._closed:
                self._state.wait()
            if self._closed:
                raise PyJoystickError(f"{description.path} has been closed")
            instance = self._idle.pop() if self._idle else self.library.instantiate()
            self._taken += 1
        return instance

    def give_back(self, instance: Instance) -> None:
        """Keep an instance for the next one who asks; free it where it is broken or the pool is closed."""
        with self._state:
            self._taken -= 1
            if self._closed or instance.is_broken:
                instance.free()
            else:
                self._idle.append(instance)
            self._unload_if_unused()
            self._state.notify()

    def close(self) -> None:
        """Free the instances and unload the FMU as soon as all that are taken are back; twice is no harm."""
        if os.getpid() != self._process:
            return  # in a forked process: what was unpacked is the parent's
        with self._state:
            if self._closed:
                return
            self._closed = True
            while self._idle:
                self._idle.pop().free()
            self._unload_if_unused()
            self._state.notify_all()

    def _unload_if_unused(self) -> None:
        if self._closed and not self._taken:
            self.library.close()
