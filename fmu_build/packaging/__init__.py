"""Package a generated model as an .fmu file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from pathlib import Path

from fmu_build.packaging import fmi2_xml, fmi3_xml
from fmu_build.packaging.archive import archive_bytes, check_output_folder, replacing
from fmu_build.packaging.binaries import COMPILER_FLAGS, LINKER_FLAGS, binary_entries, compile_library
from fmu_build.packaging.check import check_fmu
from fmu_build.packaging.consistency import check_description
from fmu_build.packaging.default_run import DefaultRun, Snapshot, run_default_experiment
from fmu_build.packaging.documentation import FIGURE, index_html
from fmu_build.packaging.elements import generation_time
from fmu_build.packaging.figures import ICONS, default_run_svg, model_png
from fmu_build.packaging.fmi3_xml import TERMINALS, terminals_and_icons_xml
from fmu_build.packaging.licenses_text import license_text
from fmu_build.packaging.module import compile_module, module_name, wasm_module
from fmu_build.packaging.platforms import WASM32, Platform, host_platform, select_platforms, wants_module
from fmu_build.packaging.reference_results import reference_files
from fmu_build.packaging.sources import (
    BUILD_DESCRIPTION,
    FMI_HEADERS,
    TOKEN_FILE,
    build_description_xml,
    c_files,
    collect_sources,
    content_guid,
    token_header,
)
from fmu_build.support.description import GeneratedModel, ModelDescription
from fmu_build.support.errors import BuildError
from fmu_build.support.request import BuildRequest, check_fmi

__all__ = ["PackagedFmu", "check_request", "package_fmu", "wasm_module"]


@dataclass(frozen=True, slots=True)
class PackagedFmu:
    """The path of the FMU, and the output of the C compiler and the checks."""

    path: Path
    log: str


def check_request(request: BuildRequest) -> None:
    """Raise `BuildError` for a request that cannot be fulfilled, before any work is done."""
    check_fmi(request)
    select_platforms(request.platforms)
    if wants_module(request.platforms) and request.fmi_version != "2.0":
        raise BuildError(f"platform 'wasm32' needs FMI 2.0, not {request.fmi_version}")
    generation_time()
    check_output_folder(request.output)


def package_fmu(
    model: GeneratedModel,
    request: BuildRequest,
    check_results: Callable[[Sequence[Snapshot]], None] = lambda _: None,
) -> PackagedFmu:
    """Compile the model with the runtime and write ``<identifier>.fmu`` to the output folder.

    The same model gives the same bytes. The file appears only after it has passed all checks; a `BuildError`,
    also of `check_results`, leaves all files unchanged.
    """
    check_request(request)
    check_description(model.description)
    identifier, version = model.description.identifier, request.fmi_version
    platforms, host = select_platforms(request.platforms), host_platform()
    token, xml, sources = _description_and_sources(model, request)
    # Importers of FMI 3 provide the headers of the standard (3.0.2, section 2.5.1.4).
    left_out = FMI_HEADERS[version] if version == "3.0" else ()
    entries = {f"sources/{name}": content for name, content in sources.items() if name not in left_out}
    entries["modelDescription.xml"] = xml
    if version == "3.0":
        entries[TERMINALS] = terminals_and_icons_xml(model.description)
    # The default run needs the library for this machine too.
    libraries, log = _compiled(sources, identifier, (*platforms, *([host] if host else [])), request.on_stage)
    entries |= binary_entries({p: libraries[p] for p in platforms}, identifier, version)
    modules = (WASM32,) if wants_module(request.platforms) else ()
    for module in modules:
        request.on_stage(f"compiling the C code for {module.name}")
        entries[module_name(identifier)], output = compile_module(sources, identifier)
        log += output
    request.on_stage("running the default experiment")
    run: DefaultRun | str = "it was not run, because this machine is not a known platform"
    if host is not None:
        run = run_default_experiment(libraries[host], host, model.description, token, version)
    if isinstance(run, str):
        log += f"default experiment: {run}\nThe results were not compared with the source.\n"
    else:
        check_results(run.snapshots)
        run = run if run.outputs else "it has no outputs"
    entries |= _documents(model.description, run)
    entries["documentation/licenses/license.txt"] = license_text(version, (*platforms, *modules)).encode()
    entries[ICONS[version]] = model_png(model.description)
    request.on_stage("packing and checking the FMU")
    target = request.output / f"{identifier}.fmu"
    with replacing(target, archive_bytes(entries)) as new:
        log += check_fmu(new, fmi_types=request.fmi_types, load=host in platforms)
    return PackagedFmu(target, log)


def _compiled(
    sources: Mapping[str, bytes],
    identifier: str,
    platforms: Iterable[Platform],
    on_stage: Callable[[str], None],
) -> tuple[dict[Platform, bytes], str]:
    """Return the library for each platform, and the compiler's output."""
    libraries, log = {}, ""
    for platform in dict.fromkeys(platforms):
        on_stage(f"compiling the C code for {platform.name}")
        libraries[platform], output = compile_library(sources, identifier, platform)
        log += output
    return libraries, log


def _description_and_sources(
    model: GeneratedModel, request: BuildRequest
) -> tuple[str, bytes, dict[str, bytes]]:
    """Return the GUID, modelDescription.xml and sources/; the GUID is a hash of the other two.

    The hash excludes the generation date, which is not content.
    """
    sources = collect_sources(model.c_source, request.fmi_version)

    def description(guid: str, time: str | None) -> bytes:
        write = fmi3_xml.model_description_xml
        if request.fmi_version == "2.0":
            write = partial(fmi2_xml.model_description_xml, source_files=c_files(sources))
        return write(
            model.description,
            guid=guid,
            fmi_types=request.fmi_types,
            generation_tool=_generation_tool(),
            generation_time=time,
        )

    guid = content_guid(description("", None), sources, COMPILER_FLAGS + LINKER_FLAGS)
    sources[TOKEN_FILE] = token_header(guid)
    if request.fmi_version == "3.0":
        identifier = model.description.identifier
        sources[BUILD_DESCRIPTION] = build_description_xml(identifier, c_files(sources))
    return guid, description(guid, generation_time()), dict(sorted(sources.items()))


def _documents(description: ModelDescription, run: DefaultRun | str) -> dict[str, bytes]:
    """Return archive name -> content of the documents about the model and its default experiment."""
    documents = {"documentation/index.html": index_html(description, run, _generation_tool())}
    if not isinstance(run, str):
        documents[f"documentation/{FIGURE}"] = default_run_svg(run, description)
        documents |= reference_files(run, description.identifier)
    return documents


def _generation_tool() -> str:
    try:
        return f"pyjoystick {metadata.version('pyjoystick')}"
    except metadata.PackageNotFoundError:
        return "pyjoystick"
