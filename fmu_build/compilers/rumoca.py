"""The default backend: rumoca lowers the Modelica model; this project generates C and builds the FMU."""

from __future__ import annotations

import os
import time
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_build.codegen.modelica_source.builtins import takes_index, with_known_functions
from fmu_build.codegen.modelica_source.own_bases import with_bases_beside
from fmu_build.codegen.modelica_source.reached import IN_MEMORY, ReachedSource
from fmu_build.codegen.modelica_source.record_copies import with_records_in_parentheses
from fmu_build.codegen.modelica_source.table_files import with_tables_from_files
from fmu_build.codegen.modelica_source.tables import with_own_tables
from fmu_build.compilers.fatal_source import reject_fatal
from fmu_build.compilers.generated_once import generated_once
from fmu_build.compilers.input_steps import input_steps_file, read_input_steps
from fmu_build.compilers.library import (
    DEFAULT_LIBRARY,
    MODEL_KINDS,
    declared_twice,
    default_library,
    entry_file,
    mentions,
    not_found,
    read_classes,
    read_text,
    readable_files,
    source_files,
)
from fmu_build.compilers.library_path import (
    VARIABLE,
    Libraries,
    find_libraries,
    reached_source,
    used_libraries,
)
from fmu_build.compilers.rumoca_errors import native_stderr, syntax_errors, translated_errors
from fmu_build.packaging import check_request, package_fmu
from fmu_build.support.description import GeneratedModel
from fmu_build.support.errors import ToolchainError
from fmu_build.support.request import BuildRequest, BuildResult

if TYPE_CHECKING:
    import rumoca

_NONE = "FmuBuildNone"
"""A class name that does not exist."""


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
        """Build the FMU; on failure, raise a `BuildError` and leave all files unchanged."""
        from fmu_build.codegen import check_results

        start = time.perf_counter()
        version = self.version()
        check_request(request)
        request.on_stage(f"compiling Modelica with rumoca {version}")
        generated, log = generate_model(request)
        packaged = package_fmu(generated, request, partial(check_results, generated))
        seconds = time.perf_counter() - start
        return BuildResult(packaged.path, self.name, version, log + packaged.log, seconds)


def generate_model(request: BuildRequest) -> tuple[GeneratedModel, str]:
    """Return the C model and rumoca's log; raises as `RumocaCompiler.build` does."""
    libraries = find_libraries(request.model, request.libraries)
    try:
        with _without_modelica_path():
            return _generated(request, libraries)
    except BaseException as error:
        _release_sessions(error)
        raise


def _generated(request: BuildRequest, libraries: Libraries) -> tuple[GeneratedModel, str]:
    from fmu_build.codegen import ModelSource, generate

    library = libraries.own
    entry_file(library)
    reached = reached_source(request.model, libraries)
    known = reached.classes.get(request.model)
    if known is None or known.kind not in MODEL_KINDS:
        raise not_found(request.model, library, read_classes(library), syntax_errors(source_files(library)))
    alone = all(_is_read_with(library, used) for used in used_libraries(libraries, reached))
    alone = alone and with_records_in_parentheses(reached.texts) == reached.texts
    alone = alone and not declared_twice(library)
    files = readable_files(library) if alone else list(reached.texts)
    with translated_errors(request.model, known.file, files):
        texts = {file: read_text(file) for file in files} if alone else _texts(reached, libraries)

    reject_fatal(texts, reached.classes)

    def make() -> tuple[GeneratedModel, str]:
        with native_stderr() as loading, translated_errors(request.model, known.file, files):
            made = _loaded(library, request.model) if alone else _loaded_from(texts, request.model)
        request.on_stage("generating C")
        with native_stderr() as generating, translated_errors(request.model, known.file, files):
            generated = generate(ModelSource(*made), request.sensitivity)
        return generated, loading() + generating() + generated.notes

    generated, log = generated_once(texts, request.model, request.sensitivity, make, request.on_stage)
    return _with_input_steps(generated, library), log


def _release_sessions(error: BaseException | None) -> None:
    """Release the rumoca sessions in the frames of an error and of its causes.

    A session must be freed by the thread that created it. In a reference cycle, the error would leave this to
    the garbage collector, which may run in any thread.
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


def _is_read_with(library: Path, other: Path) -> bool:
    """Return whether `_loaded` makes rumoca read the other library as well: it reads neighboring files."""
    beside = library.is_file() and other.is_file() and other.absolute().parent == library.absolute().parent
    return other in (library, default_library()) or beside


def _loaded(library: Path, model: str) -> tuple[rumoca.Session, rumoca.Model]:
    """Compile a model of a library that uses no other library, or only this project's."""
    import rumoca

    roots = []
    if library != default_library() and mentions(library, DEFAULT_LIBRARY):
        roots = [str(default_library())]
    session = rumoca.Session(roots=roots)
    if roots:
        # rumoca reads a source root only if the text passed to it mentions it, and the package.mo of a
        # package does not mention what its models use.
        session.loads(f"model Import import {DEFAULT_LIBRARY}; end Import;", model="Import")
    return session, session.load(str(entry_file(library)), model=model)


def _texts(reached: ReachedSource, libraries: Libraries) -> dict[Path, str]:
    """Return the part of its libraries that a model reaches, as texts for rumoca."""
    folders = {name: path if path.is_dir() else path.parent for name, path in libraries.roots.items()}
    texts = {file: with_tables_from_files(file, text, folders) for file, text in reached.texts.items()}
    index = any(takes_index(text) for text in reached.texts.values())
    texts = with_bases_beside(with_own_tables(with_records_in_parentheses(texts)))
    return {file: with_known_functions(text, index=index) for file, text in texts.items()}


def _loaded_from(texts: Mapping[Path, str], model: str) -> tuple[rumoca.Session, rumoca.Model]:
    """Compile a model from texts."""
    import rumoca

    session = rumoca.Session()
    # Loading a text takes longer the more text is already loaded, so the long ones come last.
    for file, text in sorted(texts.items(), key=lambda one: len(one[1])):
        # Loading fails because the model does not exist, but the session keeps the text.
        with suppress(rumoca.CompileError):
            session.loads(text, model=_NONE, filename=f"{IN_MEMORY}{file}")
    return session, session.loads(f"package {_NONE} end {_NONE};", model=model)


@contextmanager
def _without_modelica_path() -> Iterator[None]:
    """Hide MODELICAPATH from rumoca, which would read everything in it again for every text."""
    value = os.environ.pop(VARIABLE, None)
    try:
        yield
    finally:
        if value is not None:
            os.environ[VARIABLE] = value
