"""Reading the shared libraries in an FMU; no existing tool reads those of all systems."""

from __future__ import annotations

import zipfile
from pathlib import Path

from fmu_build.packaging.platforms import Platform
from fmu_build.support.request import FmiVersion

from .elf import read_elf
from .mach_o import read_mach_o
from .pe import read_pe
from .shared_library import SharedLibrary

READERS = {".so": read_elf, ".dll": read_pe, ".dylib": read_mach_o}


def read_library(data: bytes, platform: Platform) -> SharedLibrary:
    """What the library says of itself."""
    return READERS[platform.extension](data)


def library_in(fmu: Path, platform: Platform, fmi_version: FmiVersion) -> bytes:
    """The file for the platform."""
    with zipfile.ZipFile(fmu) as archive:
        return archive.read(f"binaries/{platform.folder(fmi_version)}/{fmu.stem}{platform.extension}")
