"""The sources/ folder of an FMU: the runtime, the generated model, the FMI headers and the content token."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path

from fmu_build.errors import BuildError

MODEL_FILE = "model.c"
TOKEN_FILE = "token.h"
RUNTIME = Path(str(resources.files("fmu_build"))) / "runtime"
FMI_HEADERS = ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h")


def collect_sources(c_source: str) -> dict[str, bytes]:
    """File name -> content of everything but the token, in the order of the names.

    Raises `BuildError` where the runtime or FMPy's copy of the FMI headers is missing.
    """
    files = {path.name: path.read_bytes() for path in RUNTIME.glob("*.[ch]")}
    if not any(name.endswith(".c") for name in files):
        raise BuildError(f"the C runtime is missing: no C file in {RUNTIME}")
    files |= {name: _fmi_header(name) for name in FMI_HEADERS}
    files[MODEL_FILE] = c_source.encode()
    return dict(sorted(files.items()))


def c_files(names: Mapping[str, bytes]) -> list[str]:
    """The files that are compiled."""
    return sorted(name for name in names if name.endswith(".c"))


def content_guid(model_description: bytes, sources: Mapping[str, bytes], flags: tuple[str, ...]) -> str:
    """A GUID that is the same for the same content, and another for any other."""
    digest = hashlib.sha256()
    parts = [model_description, *(flag.encode() for flag in flags)]
    for name in sorted(sources):
        parts += [name.encode(), sources[name]]
    for part in parts:
        digest.update(len(part).to_bytes(8, "big") + part)
    text = digest.hexdigest()
    return f"{{{text[:8]}-{text[8:12]}-{text[12:16]}-{text[16:20]}-{text[20:32]}}}"


def token_header(guid: str) -> bytes:
    """token.h, through which the C code knows the GUID that importers must present."""
    return f'/* token.h - made from the content of this FMU. */\n#define MODEL_TOKEN "{guid}"\n'.encode()


def fmi_license() -> str:
    """Copyright and licence of the FMI headers, as they state it themselves."""
    text = _fmi_header(FMI_HEADERS[0]).decode()
    match = re.search(r"^ *Copyright \(C\).*?-{20,}.*?-{20,}", text, re.DOTALL | re.MULTILINE)
    if match is None:
        raise BuildError(f"no licence text found in the FMI header {FMI_HEADERS[0]} that FMPy brings")
    return "\n".join(line.removeprefix("   ").rstrip() for line in match[0].splitlines())


def _fmi_header(name: str) -> bytes:
    try:
        return (resources.files("fmpy") / "c-code" / name).read_bytes()
    except (ModuleNotFoundError, FileNotFoundError) as error:
        raise BuildError(f"the FMI header {name} is missing; it comes with FMPy: pip install fmpy") from error
