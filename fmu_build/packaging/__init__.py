"""From a generated model to an .fmu file."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from fmu_build.description import GeneratedModel
from fmu_build.errors import BuildError
from fmu_build.packaging.archive import archive_bytes, check_output_folder, replacing
from fmu_build.packaging.binaries import COMPILER_FLAGS, LINKER_FLAGS, binary_entries, compile_library
from fmu_build.packaging.check import check_fmu
from fmu_build.packaging.consistency import check_description
from fmu_build.packaging.documentation import index_html, license_text
from fmu_build.packaging.fmi2_xml import generation_time, model_description_xml
from fmu_build.packaging.icon import model_png
from fmu_build.packaging.platforms import host_platform, select_platforms
from fmu_build.packaging.sources import TOKEN_FILE, c_files, collect_sources, content_guid, token_header
from fmu_build.request import BuildRequest

__all__ = ["PackagedFmu", "check_request", "package_fmu"]


@dataclass(frozen=True, slots=True)
class PackagedFmu:
    """Where the FMU is, and what the C compiler and the checks printed."""

    path: Path
    log: str


def check_request(request: BuildRequest) -> None:
    """Refuses what cannot be packaged before any work is done; raises `BuildError`."""
    if request.fmi_version != "2.0":
        raise BuildError(f"FMI version {request.fmi_version!r} is not supported; supported is '2.0'")
    if not request.fmi_types or not set(request.fmi_types) <= {"me", "cs"}:
        raise BuildError(f"FMI types {list(request.fmi_types)!r}: allowed are 'me', 'cs' or both")
    select_platforms(request.platforms)
    generation_time()
    check_output_folder(request.output)


def package_fmu(model: GeneratedModel, request: BuildRequest) -> PackagedFmu:
    """Compiles the model with the runtime and writes ``<identifier>.fmu`` into the output folder.

    The same model gives the same bytes. The file appears only when it has passed all checks; on a
    `BuildError` nothing has changed.
    """
    check_request(request)
    check_description(model.description)
    platforms = select_platforms(request.platforms)
    description, sources = _description_and_sources(model, request)
    entries = {f"sources/{name}": content for name, content in sources.items()}
    entries["modelDescription.xml"] = description
    log = ""
    libraries = {}
    for platform in platforms:
        request.on_stage(f"compiling the C code for {platform.name}")
        libraries[platform], output = compile_library(sources, model.description.identifier, platform)
        log += output
    entries |= binary_entries(libraries, model.description.identifier, request.fmi_version)
    request.on_stage("packing and checking the FMU")
    entries["documentation/index.html"] = index_html(model.description, _generation_tool())
    entries["documentation/licenses/license.txt"] = license_text(request.fmi_version).encode()
    entries["model.png"] = model_png(model.description)
    target = request.output / f"{model.description.identifier}.fmu"
    with replacing(target, archive_bytes(entries)) as new:
        log += check_fmu(new, fmi_types=request.fmi_types, load=host_platform() in platforms)
    return PackagedFmu(target, log)


def _description_and_sources(model: GeneratedModel, request: BuildRequest) -> tuple[bytes, dict[str, bytes]]:
    """modelDescription.xml and sources/, tied together by a GUID made from both.

    The date is no part of the GUID: it is not content.
    """
    sources = collect_sources(model.c_source, request.fmi_version)

    def description(guid: str, time: str | None) -> bytes:
        return model_description_xml(
            model.description,
            guid=guid,
            fmi_types=request.fmi_types,
            source_files=c_files(sources),
            generation_tool=_generation_tool(),
            generation_time=time,
        )

    guid = content_guid(description("", None), sources, COMPILER_FLAGS + LINKER_FLAGS)
    sources[TOKEN_FILE] = token_header(guid)
    return description(guid, generation_time()), dict(sorted(sources.items()))


def _generation_tool() -> str:
    try:
        return f"pyjoystick {metadata.version('pyjoystick')}"
    except metadata.PackageNotFoundError:
        return "pyjoystick"
