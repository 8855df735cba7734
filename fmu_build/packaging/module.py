"""The WebAssembly module of an FMU: the model and its runtime for web pages and sandboxes.

FMI defines no folder for it yet: the layered standard FMI-LS-WASM is a draft, in which a name such as
``wasm32-wasip2`` means a component instead of a bare module. The module is therefore in the folder below
extra/ that FMI reserves for tool-specific files.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Mapping
from os import PathLike
from pathlib import Path

from lxml import etree

from fmu_build.packaging.binaries import compile_library
from fmu_build.packaging.platforms import WASM32
from fmu_build.packaging.sources import MODEL_FILE, TOKEN_FILE, module_face
from fmu_build.support.errors import BuildError

#: Names allowed as files in the compiler's folder: no paths, and nothing that looks like an option.
_SOURCE = re.compile(r"[A-Za-z_]\w*\.[ch]", re.ASCII)
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_FOLDER = "extra/org.pyjoystick/wasm32"
_SOURCES = "sources/"


def module_name(identifier: str) -> str:
    """Return the module's name in the archive."""
    return f"{_FOLDER}/{identifier}{WASM32.extension}"


def compile_module(sources: Mapping[str, bytes], identifier: str, *, keep: bool = False) -> tuple[bytes, str]:
    """Compile the sources/ of an FMI 2 FMU; return the module, and the compiler's commands and output.

    The module exports the functions of FMI 2.0, those of runtime/wasm/explore.h, malloc, free and its memory,
    and imports nothing. For `keep` and errors see `compile_library`.
    """
    return compile_library({**sources, **module_face()}, identifier, WASM32, keep=keep)


def wasm_module(fmu: str | PathLike[str]) -> bytes:
    """Return the WebAssembly module of an FMU: the one it contains, else one compiled from its sources/.

    Compiled C code can include files of this machine, so compile only FMUs that you trust. The module is
    cached for later pages of the same FMU.

    Raises:
        BuildError: the file is not an FMU, has neither a module nor sources of this project for FMI 2, or
            cannot be compiled (`ToolchainError`)
    """
    path = Path(fmu)
    try:
        with zipfile.ZipFile(path) as archive:
            names = set(archive.namelist())
            identifier = _identifier(archive.read("modelDescription.xml"), path)
            if module_name(identifier) in names:
                return archive.read(module_name(identifier))
            if not {_SOURCES + name for name in (MODEL_FILE, TOKEN_FILE, "fmi2Functions.h")} <= names:
                raise BuildError(
                    f"{path} has neither a WebAssembly module nor the sources to make one: it is no FMU of "
                    "FMI 2.0 that this project built"
                )
            sources = {name: name.removeprefix(_SOURCES) for name in names if name.startswith(_SOURCES)}
            files = {plain: archive.read(name) for name, plain in sources.items() if _SOURCE.fullmatch(plain)}
    except (OSError, KeyError, zipfile.BadZipFile) as error:
        raise BuildError(f"cannot read the FMU {path}: {error}") from error
    return compile_module(files, identifier, keep=True)[0]


def _identifier(description: bytes, path: Path) -> str:
    """Return the model identifier; raises `BuildError` if the description has none."""
    try:
        root = etree.fromstring(description)
    except etree.XMLSyntaxError as error:
        raise BuildError(f"{path} has no readable modelDescription.xml: {error}") from error
    for kind in ("CoSimulation", "ModelExchange"):
        element = root.find(kind)
        if element is not None and element.get("modelIdentifier"):
            identifier = str(element.get("modelIdentifier"))
            if not _IDENTIFIER.fullmatch(identifier):
                raise BuildError(f"{path}: the modelIdentifier {identifier!r} is no identifier of C")
            return identifier
    raise BuildError(f"{path}: modelDescription.xml has no modelIdentifier")
