"""Write documentation/licenses/license.txt: the licences of the parts of an FMU."""

from __future__ import annotations

import re
from collections.abc import Collection
from importlib import resources
from importlib.resources.abc import Traversable

from fmu_build.packaging.platforms import WASM32, Platform
from fmu_build.packaging.sources import FMI_HEADERS, fmi_header
from fmu_build.support.errors import BuildError
from fmu_build.support.request import FmiVersion

_RULE = "=" * 78


def license_text(fmi_version: FmiVersion, platforms: Collection[Platform]) -> str:
    """Return the file's content for an FMU with binaries for these platforms, which may include WebAssembly.

    Raises `BuildError` if a package lacks its licence.
    """
    apache = resources.files("fmu_build.packaging") / "licenses" / "Apache-2.0.txt"
    compiler = resources.files("ziglang")
    sections = {
        "Runtime": _read(apache),
        "FMI headers": _fmi_license(fmi_version),
        "Library of the C compiler": _read(compiler / "LICENSE"),
    }
    if any(platform.extension == ".dll" for platform in platforms):
        mingw = compiler / "lib" / "libc" / "mingw" / "COPYING"
        sections["Library of the C compiler for Windows, mingw-w64"] = _read(mingw)
    if WASM32 in platforms:
        for name, place in (("wasi-libc", "wasi/LICENSE"), ("musl", "musl/COPYRIGHT")):
            title = f"Library of the C compiler for WebAssembly, {name}"
            sections[title] = _read(compiler / "lib" / "libc" / place)
    return (
        "This FMU consists of a model and a runtime that executes it.\n\n"
        "The model (modelDescription.xml and sources/model.c) is under the licence of its\n"
        "Modelica source. The runtime (all other files in sources/ except the FMI headers, and its part of\n"
        "the binaries) is under the Apache License 2.0. The FMI headers\n"
        f"({', '.join(FMI_HEADERS[fmi_version])}) are under a BSD license.\n"
        "The binaries may contain small parts of the C compiler's libraries. All licence texts follow.\n"
    ) + "".join(f"\n{_RULE}\n{title}\n{_RULE}\n\n{text.strip()}\n" for title, text in sections.items())


def _read(file: Traversable) -> str:
    try:
        return file.read_text("utf-8")
    except OSError as error:
        raise BuildError(f"the licence {file} is missing: {error.strerror}") from error


def _fmi_license(fmi_version: FmiVersion) -> str:
    """Return copyright and licence of the FMI headers, as stated in the headers."""
    header = FMI_HEADERS[fmi_version][0]
    text = fmi_header(header).decode()
    match = re.search(r"^ *Copyright \(C\).*?-{20,}.*?-{20,}", text, re.DOTALL | re.MULTILINE)
    if match is None:
        raise BuildError(f"FMPy's copy of the FMI header {header} has no licence text")
    return "\n".join(line.removeprefix("   ").rstrip() for line in match[0].splitlines())
