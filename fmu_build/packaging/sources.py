"""The sources/ folder of an FMU: the runtime, the generated model, the FMI headers and the content token.

The runtime has a folder for each layer, but its files include each other by bare name and are stored side by
side in an FMU, where any importer finds them without an include directory.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path

from lxml import etree

from fmu_build.support.errors import BuildError
from fmu_build.support.request import FmiVersion

MODEL_FILE = "model.c"
TOKEN_FILE = "token.h"
RUNTIME = Path(str(resources.files("fmu_build"))) / "runtime"
MODULE_FACE = "wasm"  # the runtime folder for WebAssembly modules only
FMI_HEADERS: Mapping[FmiVersion, tuple[str, ...]] = {
    "2.0": ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h"),
    "3.0": ("fmi3FunctionTypes.h", "fmi3Functions.h", "fmi3PlatformTypes.h"),
}


def runtime_files(fmi_version: FmiVersion) -> list[Path]:
    """Return the runtime's files for one FMI version; raises `BuildError` if they are missing."""
    others = {MODULE_FACE} | {f"fmi{version[0]}" for version in FMI_HEADERS if version != fmi_version}
    files = sorted(path for path in RUNTIME.glob("*/*.[ch]") if path.parent.name not in others)
    if not any(path.suffix == ".c" for path in files):
        raise BuildError(f"the C runtime is missing: no C file in {RUNTIME}")
    return files


def module_face() -> dict[str, bytes]:
    """Return file name -> content of the additional sources of a WebAssembly module (FMI 2)."""
    return {path.name: path.read_bytes() for path in sorted((RUNTIME / MODULE_FACE).glob("*.[ch]"))}


def include_arguments() -> list[str]:
    """Return the compiler arguments that let a C file elsewhere include the runtime's headers."""
    return [f"-I{folder}" for folder in sorted({path.parent for path in RUNTIME.glob("*/*.h")})]


def collect_sources(c_source: str, fmi_version: FmiVersion) -> dict[str, bytes]:
    """Return file name -> content of everything except the token, sorted by name.

    Raises `BuildError` if the runtime or FMPy's copy of the FMI headers is missing.
    """
    files = {path.name: path.read_bytes() for path in runtime_files(fmi_version)}
    files |= {name: fmi_header(name) for name in FMI_HEADERS[fmi_version]}
    files[MODEL_FILE] = c_source.encode()
    return dict(sorted(files.items()))


def c_files(names: Mapping[str, bytes]) -> list[str]:
    """Return the names of the C files to compile."""
    return sorted(name for name in names if name.endswith(".c"))


def content_guid(model_description: bytes, sources: Mapping[str, bytes], flags: tuple[str, ...]) -> str:
    """Return a GUID derived from a hash of the content."""
    digest = hashlib.sha256()
    parts = [model_description, *(flag.encode() for flag in flags)]
    for name in sorted(sources):
        parts += [name.encode(), sources[name]]
    for part in parts:
        digest.update(len(part).to_bytes(8, "big") + part)
    text = digest.hexdigest()
    return f"{{{text[:8]}-{text[8:12]}-{text[12:16]}-{text[16:20]}-{text[20:32]}}}"


def token_header(guid: str) -> bytes:
    """Return token.h, which defines the GUID that importers must present."""
    return f'/* token.h - made from the content of this FMU. */\n#define MODEL_TOKEN "{guid}"\n'.encode()


def fmi_header(name: str) -> bytes:
    """Return FMPy's copy of a header of the standard; raises `BuildError` if it is missing."""
    try:
        return (resources.files("fmpy") / "c-code" / name).read_bytes()
    except (ModuleNotFoundError, FileNotFoundError) as error:
        raise BuildError(f"the FMI header {name} is missing; FMPy provides it: pip install fmpy") from error


BUILD_DESCRIPTION = "buildDescription.xml"


def build_description_xml(identifier: str, c_files: Sequence[str]) -> bytes:
    """Return the file's content: one library from all C files, linked with libm."""
    root = etree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = etree.SubElement(configuration, "SourceFileSet", language="C11")
    for name in c_files:
        etree.SubElement(files, "SourceFile", name=name)
    etree.SubElement(configuration, "Library", name="m", external="true", description="C library, libm")
    content: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return content
