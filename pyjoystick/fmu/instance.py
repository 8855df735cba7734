"""An FMU unpacked, loaded and instantiated, and everything put away again."""

from __future__ import annotations

import os
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave

from pyjoystick.fmu.description import FmuDescription, Interface
from pyjoystick.fmu.errors import FmuFileError, FmuRunError, UnsupportedFmuError
from pyjoystick.fmu.log import FmuLog

_CLASSES: Final = {"CoSimulation": FMU2Slave, "ModelExchange": FMU2Model}
_FATAL: Final = 4


@dataclass(slots=True)
class Instance:
    """One instance of an FMU.

    Attributes:
        description: the FMU
        folder: where it is unpacked
        fmi: FMPy's object, one method an FMI function
        log: what the instance says
        time: the last communication point (s)
    """

    description: FmuDescription
    folder: Path
    fmi: Any
    log: FmuLog
    time: float = 0.0
    fatal: bool = False

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """Turn a failing FMI call into an `FmuRunError` that carries the FMU's messages."""
        self.log.attach()
        self.log.messages.clear()
        try:
            yield
        except fmpy.fmi1.FMICallException as error:
            self.fatal = self.fatal or error.status == _FATAL
            reason = str(error).rstrip(".")
            raise FmuRunError(self.description.path, self.time, reason, self.log.messages) from error


def require_runnable(description: FmuDescription, interface: Interface) -> None:
    """Raise `UnsupportedFmuError` unless this machine can run the FMU through `interface` of FMI 2.0."""
    path = description.path
    if description.fmi_version != "2.0":
        raise UnsupportedFmuError(path, f"is an FMU of FMI {description.fmi_version}; FMI 2.0 can be run")
    if interface not in description.interfaces:
        has = " and ".join(description.interfaces) or "neither"
        raise UnsupportedFmuError(path, f"has no {interface} interface (it has {has})")
    library = f"{fmpy.platform}/{description.interfaces[interface]}{fmpy.sharedLibraryExtension}"
    if library not in description.binaries:
        has = ", ".join(description.platforms) or "none"
        raise UnsupportedFmuError(path, f"has no binary for {fmpy.platform} (it has {has})")


@contextmanager
def instantiated(description: FmuDescription, interface: Interface) -> Iterator[Instance]:
    """Unpack the FMU into a temporary folder, load it and make one instance; all is undone on leaving.

    Raises:
        UnsupportedFmuError: as `require_runnable`
        FmuFileError: the archive or the binary is broken, or instantiation fails
    """
    require_runnable(description, interface)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="pyjoystick-")))
        _unpack(description.path, folder)
        fmi = _load(description, interface, folder)
        stack.callback(fmi.freeLibrary)
        log = FmuLog()
        stack.callback(log.close)
        try:
            fmi.instantiate(callbacks=log.callbacks, loggingOn=False)
        except Exception as error:  # FMPy has no type of its own for it
            said = "; ".join(log.messages) or "no message"
            raise FmuFileError(description.path, f"cannot be instantiated: {said}") from error
        instance = Instance(description, folder, fmi, log)
        stack.callback(_free, instance)
        yield instance


def _free(instance: Instance) -> None:
    # After a fatal error the standard forbids every call.
    if not instance.fatal:
        instance.fmi.fmi2FreeInstance(instance.fmi.component)


def _unpack(path: Path, folder: Path) -> None:
    wanted = (f"binaries/{fmpy.platform}/", "resources/", "modelDescription.xml")
    try:
        fmpy.extract(str(path), str(folder), include=lambda name: name.startswith(wanted))
    except (zipfile.BadZipFile, OSError, EOFError, ValueError) as error:
        raise FmuFileError(path, f"cannot be unpacked: {error}") from error
    (folder / "resources").mkdir(exist_ok=True)


def _load(description: FmuDescription, interface: Interface, folder: Path) -> Any:
    before = Path.cwd()
    try:
        return _CLASSES[interface](
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
