"""An FMU unpacked and loaded, its instances made when needed and kept, and everything put away again."""

from __future__ import annotations

import copy
import os
import threading
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any, Final

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

from pyjoystick.fmu.description import FmuDescription, Interface
from pyjoystick.fmu.errors import FmuFileError, UnsupportedFmuError
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.log import FmuLog
from pyjoystick.support import ARCHIVE_ERRORS, PyJoystickError, archive_problem, temporary_folder

#: FMPy's classes by interface and first digit of the version of FMI: what can be run.
_CLASSES: Final[dict[tuple[Interface, str], Any]] = {
    ("CoSimulation", "2"): FMU2Slave,
    ("CoSimulation", "3"): FMU3Slave,
    ("ModelExchange", "2"): FMU2Model,
    ("ModelExchange", "3"): FMU3Model,
}


def require_runnable(description: FmuDescription, interface: Interface) -> None:
    """Raise `UnsupportedFmuError` unless this machine can run the FMU through `interface`."""
    path, version = description.path, description.fmi_version
    if interface not in description.interfaces:
        has = " and ".join(description.interfaces) or "neither"
        raise UnsupportedFmuError(path, f"has no {interface} interface (it has {has})")
    if (interface, version[0]) not in _CLASSES:
        raise UnsupportedFmuError(path, f"is an FMU of FMI {version}, whose {interface} cannot be run here")
    platform = _platform(description)
    library = f"{platform}/{description.interfaces[interface]}{fmpy.sharedLibraryExtension}"
    if library not in description.binaries:
        has = ", ".join(description.platforms) or "none"
        raise UnsupportedFmuError(path, f"has no binary for {platform} (it has {has})")


class FmuLibrary:
    """The binary of an FMU, loaded once for any number of instances.

    Attributes:
        description: the FMU
        folder: where it is unpacked
        fmi: FMPy's object, which itself is never instantiated
    """

    def __init__(self, description: FmuDescription, interface: Interface) -> None:
        """Unpack the FMU into a temporary folder and load it.

        Raises:
            UnsupportedFmuError: as `require_runnable`
            FmuFileError: the archive or the binary is broken
        """
        require_runnable(description, interface)
        self.description = description
        with ExitStack() as stack:
            self.folder = stack.enter_context(temporary_folder())
            _unpack(description, self.folder)
            self.fmi: Any = _load(description, interface, self.folder)
            stack.callback(self.fmi.freeLibrary)
            self._stack = stack.pop_all()

    def instantiate(self) -> Instance:
        """A new instance; free it before `close`.

        Raises:
            FmuFileError: the FMU refuses
        """
        fmi = copy.copy(self.fmi)
        log = FmuLog()
        try:
            if self.description.fmi_version.startswith("2"):
                fmi.instantiate(callbacks=log.callbacks, loggingOn=False)
            else:
                _instantiate_with_log(fmi, log, self.description.log_categories)
        except Exception as error:  # FMPy has no type of its own for it
            log.close()
            said = "; ".join(log.messages()) or "no message"
            raise FmuFileError(self.description.path, f"cannot be instantiated: {said}") from error
        return Instance(self.description, fmi, log)

    def close(self) -> None:
        """Unload the binary and delete what was unpacked."""
        self._stack.close()


def _instantiate_with_log(fmi: Any, log: FmuLog, categories: tuple[str, ...]) -> None:
    """Of FMI 3: logging is on, which else would be off, but for problems alone where they have categories."""

    def receive(_environment: object, _status: int, _category: bytes, text: bytes) -> None:
        log.add(text.replace(b"##", b"#"))

    fmi.instantiate(logMessage=receive, loggingOn=True)
    problems = [category for category in categories if category.startswith("logStatus")]
    if problems:
        fmi.fmi3SetDebugLogging(fmi.component, False, 0, None)
        fmi.setDebugLogging(True, problems)


def _platform(description: FmuDescription) -> str:
    """The folder of the binaries for this machine."""
    name: str = fmpy.platform if description.fmi_version.startswith("2") else fmpy.platform_tuple
    return name


def _unpack(description: FmuDescription, folder: Path) -> None:
    wanted = (f"binaries/{_platform(description)}/", "resources/", "modelDescription.xml")
    try:
        fmpy.extract(str(description.path), str(folder), include=lambda name: name.startswith(wanted))
    except ARCHIVE_ERRORS as error:
        raise FmuFileError(description.path, f"cannot be unpacked: {archive_problem(error)}") from error
    (folder / "resources").mkdir(exist_ok=True)


def _load(description: FmuDescription, interface: Interface, folder: Path) -> Any:
    before = Path.cwd()
    try:
        return _CLASSES[interface, description.fmi_version[0]](
            guid=description.guid,
            modelIdentifier=description.interfaces[interface],
            unzipDirectory=str(folder),
            instanceName=description.interfaces[interface],
        )
    except Exception as error:  # FMPy raises plain exceptions
        reason = str(error).replace(f"{folder}{os.sep}", "")
        raise FmuFileError(description.path, f"its binary cannot be loaded: {reason}") from error
    finally:
        # FMPy changes the working directory while loading, and stays there when that fails.
        with suppress(FileNotFoundError):
            os.chdir(before)


class InstancePool:
    """Instances of an FMU, and its library.

    Attributes:
        library: unpacked and loaded
    """

    #: What a run may take (s).
    time_limit: float | None = None

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
