"""Systems as SSP archives (System Structure and Parameterization 1.0 and 2.0, Modelica Association)."""

from __future__ import annotations

import zipfile
from os import PathLike
from pathlib import Path
from typing import Final
from xml.etree import ElementTree

from pyjoystick.fmu import find_fmu
from pyjoystick.runs.coupling.structure import SspVersion, structure_xml, system_of
from pyjoystick.runs.coupling.system import CoupledSystem
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import InputFileError, replacing

_STRUCTURE: Final = "SystemStructure.ssd"
#: The least date that a ZIP archive can hold: equal systems give equal bytes.
_NO_DATE: Final = (1980, 1, 1, 0, 0, 0)


def write_ssp(system: CoupledSystem, path: str | PathLike[str], *, version: SspVersion = "2.0") -> None:
    """Write a system with its FMUs into one SSP archive, whole or not at all.

    Args:
        system: what to write
        path: the .ssp file
        version: of the SSP standard; tools that know 1.0 only refuse the other by its number

    Raises:
        CouplingError, FmuNotFoundError, FmuFileError, ParameterError, UnknownParameterError: as
            `CoupledSystem.describe`, or two different FMUs have the same file name
        OutputFileError: the file cannot be written
    """
    files: dict[str, Path] = {}
    for component in system.components:
        file = find_fmu(component.fmu)
        if not files.setdefault(file.name, file).samefile(file):
            reason = f"another FMU of the system is called {file.name} too; rename one of the files"
            raise CouplingError(system.name, component.name, reason)
    content = structure_xml(system, version)
    with replacing(Path(path)) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        _add(archive, _STRUCTURE, content)
        for name, fmu in files.items():
            _add(archive, f"resources/{name}", fmu.read_bytes())


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    entry = zipfile.ZipInfo(name, _NO_DATE)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    archive.writestr(entry, content)


def read_ssp(path: str | PathLike[str], folder: str | PathLike[str]) -> CoupledSystem:
    """Read an SSP archive whose components are FMUs, connected output to input, in one system.

    Args:
        path: the .ssp file
        folder: receives the FMUs; made where it is missing

    Raises:
        InputFileError: the file is no SSP archive, or holds what this reader does not understand (systems
            within systems, other components than FMUs, parameter files, unit conversions): it is named
    """
    path, folder = Path(path), Path(folder)
    try:
        with zipfile.ZipFile(path) as archive:
            system = system_of(path, ElementTree.fromstring(archive.read(_STRUCTURE)), folder)
            for component in system.components:
                archive.extract(Path(component.fmu).relative_to(folder).as_posix(), folder)
    except KeyError as error:
        raise InputFileError(path, f"not a whole SSP archive: {error.args[0]}") from error
    except (zipfile.BadZipFile, OSError) as error:
        raise InputFileError(path, f"not an SSP archive: {error}") from error
    except ElementTree.ParseError as error:
        raise InputFileError(path, f"{_STRUCTURE} cannot be read: {error}") from error
    return system
