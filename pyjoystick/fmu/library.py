"""An unpacked and loaded FMU, with its pool of instances and its cleanup."""

from __future__ import annotations

import copy
import os
import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from numpy.typing import NDArray

from pyjoystick.fmu.declared_starts import contradiction
from pyjoystick.fmu.description import FmuDescription, Interface, Variable
from pyjoystick.fmu.drive import IntermediateUpdate, inputs_asked_for
from pyjoystick.fmu.errors import FmuFileError, UnsupportedFmuError
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.log import FmuLog
from pyjoystick.fmu.pool import Pool
from pyjoystick.support import ARCHIVE_ERRORS, PyJoystickError, archive_problem, temporary_folder

#: FMPy's classes by interface and major FMI version: what can be run.
_CLASSES: Final[dict[tuple[Interface, str], Any]] = {
    ("CoSimulation", "2"): FMU2Slave,
    ("CoSimulation", "3"): FMU3Slave,
    ("ModelExchange", "2"): FMU2Model,
    ("ModelExchange", "3"): FMU3Model,
}


def require_runnable(description: FmuDescription, interface: Interface) -> None:
    """Raise `UnsupportedFmuError` unless this machine can run the FMU with `interface`."""
    path, version = description.path, description.fmi_version
    if interface not in description.interfaces:
        has = " and ".join(description.interfaces) or "neither"
        raise UnsupportedFmuError(path, f"has no {interface} interface (it has {has})")
    if (interface, version[0]) not in _CLASSES:
        raise UnsupportedFmuError(path, f"is an FMU of FMI {version}, whose {interface} cannot be run here")
    platform, identifier = _platform(description), description.interfaces[interface]
    wanted = f"{identifier}{fmpy.sharedLibraryExtension}"
    found = [file.partition("/")[2] for file in description.binaries if file.startswith(f"{platform}/")]
    if not found:
        has = ", ".join(description.platforms) or "none"
        raise UnsupportedFmuError(path, f"has no binary for {platform} (it has {has})")
    if wanted not in found:
        reason = f"its modelIdentifier {identifier!r} asks for {wanted} in binaries/{platform}"
        reason += f", which has only {', '.join(found)}"
        raise FmuFileError(path, reason)


class FmuLibrary:
    """The binary of an FMU, loaded once for any number of instances.

    Attributes:
        description: the FMU
        folder: folder where it is unpacked
        fmi: FMPy's object, which itself is never instantiated
    """

    def __init__(self, description: FmuDescription, interface: Interface, folder: Path | None = None) -> None:
        """Unpack the FMU and load it.

        Args:
            description: the FMU
            interface: the interface to use
            folder: folder where it is already unpacked; if None, it is unpacked to a temporary folder

        Raises:
            UnsupportedFmuError: as `require_runnable`
            FmuFileError: the archive or the binary is broken, or the start values of an FMU of this project
                were edited in its modelDescription.xml alone
        """
        require_runnable(description, interface)
        self.description = description
        with ExitStack() as stack:
            self.folder = stack.enter_context(unpacked(description)) if folder is None else folder
            self.fmi: Any = _load(description, interface, self.folder)
            stack.callback(self.fmi.freeLibrary)
            if description.is_ours:
                self._require_declared_starts()
            self._stack = stack.pop_all()

    def _require_declared_starts(self) -> None:
        instance = self.instantiate()
        try:
            wrong = contradiction(instance)
        finally:
            instance.free()
        if wrong:
            advice = "set parameters when you run it, or export it with other values"
            raise FmuFileError(self.description.path, f"{wrong}: {advice}")

    def instantiate(self, place: NDArray[np.intp] | None = None, *, asks: bool = False) -> Instance:
        """Make an instance; free it before `close`.

        Args:
            place: progress array of the instance, as in `FmuLog`
            asks: request inputs within steps, if the FMU supports it

        Raises:
            FmuFileError: the FMU cannot be instantiated
        """
        fmi = copy.copy(self.fmi)
        log = FmuLog(place)
        asked = inputs_asked_for(self.description) if asks else []
        intermediate_update = IntermediateUpdate(fmi) if asked else None
        try:
            if self.description.fmi_version.startswith("2"):
                fmi.instantiate(callbacks=log.callbacks, loggingOn=False)
            else:
                categories = self.description.log_categories
                _instantiate_with_log(fmi, log, categories, intermediate_update, asked)
        except Exception as error:  # FMPy raises plain exceptions
            log.close()
            said = "; ".join(log.messages()) or "no message"
            raise FmuFileError(self.description.path, f"cannot be instantiated: {said}") from error
        return Instance(self.description, fmi, log, intermediate_update=intermediate_update)

    def close(self) -> None:
        """Unload the binary and delete the unpacked files."""
        self._stack.close()


def _instantiate_with_log(
    fmi: Any,
    log: FmuLog,
    categories: tuple[str, ...],
    intermediate_update: IntermediateUpdate | None,
    asked: Sequence[Variable],
) -> None:
    """FMI 3: enable logging, off by default; only of problems if there are categories for them."""

    def receive(_environment: object, _status: int, _category: bytes, text: bytes) -> None:
        log.add(text.replace(b"##", b"#"))

    settings: dict[str, Any] = {}
    if intermediate_update is not None:
        references = [one.value_reference for one in asked]
        settings = {
            "intermediateUpdate": intermediate_update.answer,
            "requiredIntermediateVariables": references,
        }
    fmi.instantiate(logMessage=receive, loggingOn=True, **settings)
    problems = [category for category in categories if category.startswith("logStatus")]
    if problems:
        fmi.fmi3SetDebugLogging(fmi.component, False, 0, None)
        fmi.setDebugLogging(True, problems)


def _platform(description: FmuDescription) -> str:
    """Folder of the binaries for this machine.

    FMI 2 has names for x86 and refers to those of FMI 3 for the rest, but FMPy takes linux64 for any Linux.
    On macOS, darwin64 serves both processors.
    """
    named_by_fmi_2 = description.fmi_version.startswith("2") and fmpy.platform_tuple != "aarch64-linux"
    name: str = fmpy.platform if named_by_fmi_2 else fmpy.platform_tuple
    return name


@contextmanager
def unpacked(description: FmuDescription) -> Iterator[Path]:
    """Unpack what this machine needs to a temporary folder; raises FmuFileError if the FMU is damaged."""
    wanted = (f"binaries/{_platform(description)}/", "resources/", "modelDescription.xml")
    with temporary_folder() as folder:
        try:
            fmpy.extract(str(description.path), str(folder), include=lambda name: name.startswith(wanted))
        except ARCHIVE_ERRORS as error:
            raise FmuFileError(description.path, f"cannot be unpacked: {archive_problem(error)}") from error
        (folder / "resources").mkdir(exist_ok=True)
        yield folder


def _load(description: FmuDescription, interface: Interface, folder: Path) -> Any:
    before = Path.cwd()
    identifier = description.interfaces[interface]
    library = folder / "binaries" / _platform(description) / f"{identifier}{fmpy.sharedLibraryExtension}"
    try:
        return _CLASSES[interface, description.fmi_version[0]](
            guid=description.guid,
            modelIdentifier=identifier,
            unzipDirectory=str(folder),
            libraryPath=str(library),
            instanceName=identifier,
        )
    except Exception as error:  # FMPy raises plain exceptions
        reason = str(error).replace(f"{folder}{os.sep}", "")
        raise FmuFileError(description.path, f"its binary cannot be loaded: {reason}") from error
    finally:
        # FMPy changes the working directory while loading, and does not restore it on failure.
        with suppress(FileNotFoundError):
            os.chdir(before)


class InstancePool(Pool[Instance]):
    """Instances of an FMU in this process, and its library.

    Attributes:
        library: unpacked and loaded
        resets: instances are reset between runs and reused; otherwise each run gets a new one
    """

    def __init__(
        self,
        description: FmuDescription,
        folder: Path | None = None,
        place: NDArray[np.intp] | None = None,
        time_limit: float | None = None,
        first: InstancePool | None = None,
    ) -> None:
        """Load the FMU and make the first instance, to verify that it can be run.

        Args:
            description: the FMU
            folder: as in `FmuLibrary`
            place: progress array of its instances, see `FmuLog`; if None, each has its own
            time_limit: time limit of a run (s); None for no limit
            first: pool whose library this one shares, for instances that request inputs

        Raises:
            UnsupportedFmuError, FmuFileError: as `FmuLibrary`, or the FMU cannot be instantiated
        """
        self._first = first
        self._second: InstancePool | None = None
        self.library: FmuLibrary = (
            FmuLibrary(description, "CoSimulation", folder) if first is None else first.library
        )
        self._asks = first is not None or description.one_instance
        self.resets = description.is_ours
        self.has_one = description.one_instance
        self.place = place
        self.time_limit = time_limit
        # FMUs may require that one thread makes and frees all instances.
        self._lock: threading.Lock = threading.Lock() if first is None else first._lock
        super().__init__(description)

    def updating(self) -> InstancePool:
        """A separate pool of instances that request inputs within their steps, which takes time."""
        if self._asks:
            return self
        with self._state:
            if self._closed:
                raise PyJoystickError(f"{self.description.path} has been closed")
            if self._second is None:
                self._taken += 1  # the library must outlive the second pool
                self._second = InstancePool(
                    self.description, place=self.place, time_limit=self.time_limit, first=self
                )
            return self._second

    def close(self) -> None:
        """See `Pool`."""
        with self._state:
            second = self._second
        if second is not None:
            second.close()
        super().close()

    def _make(self) -> Instance:
        with self._lock:
            return self.library.instantiate(self.place, asks=self._asks)

    def is_reusable(self, one: Instance) -> bool:
        """See `Pool`."""
        return not one.is_broken and (self.resets or one.is_new)

    def _free(self, one: Instance) -> None:
        with self._lock:
            one.free()

    def _put_away(self) -> None:
        if self._first is None:
            self.library.close()
        else:
            self._first._return(None)
