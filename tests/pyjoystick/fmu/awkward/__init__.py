"""FMUs of FMI 2.0 and 3.0 that misbehave on request, compiled from the C files in this folder."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from enum import IntEnum
from pathlib import Path

import fmpy

FOLDER = Path(__file__).parent
_HEADERS = Path(fmpy.__file__).parent / "c-code"


class Trouble(IntEnum):
    """What the FMU does in the first step from the time `when` on, see model.h."""

    NONE = 0
    ERROR = 1
    DISCARD = 2
    FATAL = 3
    NO_STATUS = 4
    FOREVER = 5
    REFUSED_START = 6
    WARNINGS = 7
    NO_RESET = 8
    FATAL_RESET = 9
    ENDS = 10
    COMES_BACK_EARLY = 11
    EXITS = 12
    ABORTS = 13
    CRASHES = 14
    PRINTS = 15
    KEEPS_STATE = 16
    STOPS_SHORT = 17
    ABORTS_AFTERWARDS = 18
    CLOSES_STREAMS = 19


def compile_library(version: int, folder: Path) -> Path:
    """The shared library; functions of FMI that the model has no use for are there and fail."""
    source = FOLDER / f"fmi{version}.c"
    header = (_HEADERS / f"fmi{version}Functions.h").read_text()
    names = re.findall(rf"FMI{version}_Export\s+\w+TYPE\s+(\w+);", header)
    stubs = folder / "stubs.c"
    stubs.write_text(
        "".join(f"int {name}(void) {{ return 3; }}\n" for name in names if f" {name}(" not in _text(source))
    )
    library = folder / f"awkward{fmpy.sharedLibraryExtension}"
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-O1"]
    sources = [str(source), str(stubs)]
    subprocess.run(
        [*command, "-shared", "-fPIC", "-isystem", str(_HEADERS), "-o", str(library), *sources], check=True
    )
    return library


def _text(source: Path) -> str:
    return re.sub(r"GETTER\((\w+),", r" fmi3Get\1(", source.read_text())


#: What ends the process that the FMU runs in, never comes back, prints, or closes streams.
ROUGH = (
    Trouble.FOREVER,
    Trouble.EXITS,
    Trouble.ABORTS,
    Trouble.CRASHES,
    Trouble.PRINTS,
    Trouble.ABORTS_AFTERWARDS,
    Trouble.CLOSES_STREAMS,
)


def build(
    version: int,
    target: Path,
    library: Path,
    *,
    guid: str = "awkward",
    attributes: str = "",
    tool: str = "",
) -> Path:
    """An FMU at `target`.

    Args:
        version: of FMI, 2 or 3
        target: the file
        library: as compiled
        guid: ``only-one`` makes the FMU refuse a second instance, ``exits`` end the process at the first
        attributes: more attributes of the element CoSimulation
        tool: what is said to have made it
    """
    platform = fmpy.platform if version == 2 else fmpy.platform_tuple
    text = (FOLDER / f"fmi{version}.xml").read_text()
    with zipfile.ZipFile(target, "w") as archive:
        archive.writestr("modelDescription.xml", text.format(guid=guid, attributes=attributes, tool=tool))
        archive.write(library, f"binaries/{platform}/{library.name}")
    return target
