"""An FMU unpacked and loaded, ready to be instantiated, and everything put away again."""

from __future__ import annotations

import copy
import os
import tempfile
import zipfile
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
            self.folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="pyjoystick-")))
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
    except (zipfile.BadZipFile, OSError, EOFError, ValueError) as error:
        raise FmuFileError(description.path, f"cannot be unpacked: {error}") from error
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
