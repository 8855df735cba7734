"""The default backend: rumoca lowers the Modelica model, this project generates C and builds the FMU."""

from __future__ import annotations

import time
import traceback
from collections.abc import Mapping
from dataclasses import replace
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_build.compilers.input_steps import input_steps_file, read_input_steps
from fmu_build.compilers.library import (
    DEFAULT_LIBRARY,
    MODEL_KINDS,
    ModelicaClass,
    default_library,
    entry_file,
    mentions,
    not_found,
    read_classes,
    readable_files,
    source_files,
)
from fmu_build.compilers.rumoca_errors import native_stderr, syntax_errors, translated_errors
from fmu_build.packaging import check_request, package_fmu
from fmu_build.support.description import GeneratedModel
from fmu_build.support.errors import ToolchainError
from fmu_build.support.request import BuildRequest, BuildResult

if TYPE_CHECKING:
    import rumoca


class RumocaCompiler:
    """Implements `fmu_build.compilers.base.Compiler`."""

    name = "rumoca"
    options: Mapping[str, str] = {}
    computes_sensitivities = True

    def version(self) -> str:
        """Return the installed version; raises `ToolchainError` if rumoca is not installed."""
        try:
            return metadata.version("rumoca")
        except metadata.PackageNotFoundError as error:
            raise ToolchainError(
                "the Modelica compiler is missing: pip install 'pyjoystick[build]' (rumoca)"
            ) from error

    def build(self, request: BuildRequest) -> BuildResult:
        """Build the FMU; on failure, raise a `BuildError` and leave every file as it was."""
        start = time.perf_counter()
        version = self.version()
        check_request(request)
        request.on_stage(f"compiling Modelica with rumoca {version}")
        generated, log = generate_model(request)
        packaged = package_fmu(generated, request)
        seconds = time.perf_counter() - start
        return BuildResult(packaged.path, self.name, version, log + packaged.log, seconds)


def generate_model(request: BuildRequest) -> tuple[GeneratedModel, str]:
    """Return the C model and rumoca's log; raises as `RumocaCompiler.build` does."""
    try:
        return _generated(request)
    except BaseException as error:
        _release_sessions(error)
        raise


def _generated(request: BuildRequest) -> tuple[GeneratedModel, str]:
    from fmu_build.codegen import ModelSource, generate

    library = request.library or default_library()
    entry = entry_file(library)
    classes = read_classes(library)
    known = classes.get(request.model)
    if known is None or known.kind not in MODEL_KINDS:
        raise not_found(request.model, library, classes, syntax_errors(source_files(library)))
    files = readable_files(library)
    with native_stderr() as loading, translated_errors(request.model, known.file, files):
        session = _session(library, classes)
        model = session.load(str(entry), model=request.model)
    request.on_stage("generating C")
    with native_stderr() as generating, translated_errors(request.model, known.file, files):
        generated = generate(ModelSource(session, model), request.sensitivity)
    return _with_input_steps(generated, library), loading() + generating() + generated.notes


def _release_sessions(error: BaseException | None) -> None:
    """Let go of the sessions that the frames of an error and of its causes still hold.

    A session of rumoca must be freed by the thread that made it. An error that is kept in a reference cycle
    would leave that to the garbage collector, which runs in any thread.
    """
    while error is not None:
        traceback.clear_frames(error.__traceback__)
        error = error.__cause__ or error.__context__


def _with_input_steps(model: GeneratedModel, library: Path) -> GeneratedModel:
    """Add the input steps of the default experiment to the model."""
    description = model.description
    inputs = [v.name for v in description.variables if v.causality == "input" and v.type == "Real"]
    steps = read_input_steps(input_steps_file(library, description.model_name), inputs)
    experiment = replace(description.default_experiment, input_steps=steps)
    return replace(model, description=replace(description, default_experiment=experiment))


def _session(library: Path, classes: dict[str, ModelicaClass]) -> rumoca.Session:
    """Return a session, with this project's library if the user's library mentions it."""
    import rumoca

    roots = []
    if DEFAULT_LIBRARY not in classes and mentions(library, DEFAULT_LIBRARY):
        roots = [str(default_library())]
    session = rumoca.Session(roots=roots)
    if roots:
        # rumoca reads a root only if the text that it is given mentions it, and package.mo of a package does
        # not mention what its models use.
        session.loads(f"model Import import {DEFAULT_LIBRARY}; end Import;", model="Import")
    return session
