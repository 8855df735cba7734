"""The OpenModelica backend: omc builds the whole FMU, in a session through OMPython or from a script."""

from __future__ import annotations

import re
import time
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from fmu_build.compilers.library import MODEL_KINDS, ModelicaClass, needed_files, not_found, read_classes
from fmu_build.compilers.library_path import find_libraries
from fmu_build.compilers.openmodelica.build import Attempt, identifier, read_attempt, statements
from fmu_build.compilers.openmodelica.finding import find_omc, omc_version
from fmu_build.compilers.openmodelica.messages import failure
from fmu_build.compilers.openmodelica.options import OPTIONS, Options, read_options
from fmu_build.compilers.openmodelica.sessions import Opened, open_session
from fmu_build.compilers.openmodelica.shared import left_as_found
from fmu_build.packaging.foreign import check_request, place
from fmu_build.support.errors import BuildError
from fmu_build.support.request import BuildRequest, BuildResult
from fmu_build.support.temporary import temporary_folder

__all__ = ["OpenModelicaCompiler"]

_IDENTIFIER = r"(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+')"
_CLASS_NAME = re.compile(rf"{_IDENTIFIER}(?:\.{_IDENTIFIER})*", re.ASCII)


@dataclass(frozen=True, slots=True)
class _Sources:
    """The library that contains the model, the classes that it declares, and all files to load."""

    library: Path
    classes: dict[str, ModelicaClass]
    files: Sequence[Path]


class OpenModelicaCompiler:
    """Implements `fmu_build.compilers.base.Compiler`."""

    name = "openmodelica"
    options: Mapping[str, str] = OPTIONS
    computes_sensitivities = False

    def version(self) -> str:
        """Return the version of the omc found; raises `ToolchainError` if there is none."""
        return omc_version(find_omc(None))

    def build(self, request: BuildRequest) -> BuildResult:
        """Build the FMU; on failure, raise a `BuildError` and leave all files unchanged."""
        start = time.perf_counter()
        options = read_options(request.options)
        check_request(request, "OpenModelica")
        sources = _sources(request)
        # omc writes dozens of files next to an FMU, and deletes the old FMU before it builds the new one.
        with temporary_folder() as folder:
            request.on_stage("starting OpenModelica")
            with open_session(options, folder, sources.files, request.on_stage) as opened:
                request.on_stage("compiling Modelica and C with OpenModelica")
                attempt = _attempt(opened, request, options, sources, folder)
            made = folder / f"{identifier(request.model)}.fmu"
            if not made.is_file():
                # Only the file counts: omc may return the name of an FMU that it has failed to build.
                raise _reason(attempt, request, sources)
            request.on_stage("checking the FMU")
            path, checks = place(made, request)
        log = _log(opened, attempt, request, options) + checks
        return BuildResult(path, self.name, attempt.version, log, time.perf_counter() - start)


def _sources(request: BuildRequest) -> _Sources:
    library = find_libraries(request.model, request.libraries).own.absolute()
    files, classes = needed_files(library, request.libraries), read_classes(library)
    if not _CLASS_NAME.fullmatch(request.model):  # The name becomes part of a statement.
        raise not_found(request.model, library, classes)
    return _Sources(library, classes, files)


def _attempt(
    opened: Opened, request: BuildRequest, options: Options, sources: _Sources, folder: Path
) -> Attempt:
    asked = statements(request, sources.files, folder, options.cs_solver)
    top_level = {name: file for file in sources.files for name in read_classes(file) if "." not in name}
    with left_as_found(opened.session, folder, top_level) if opened.shared else nullcontext():
        answers = opened.session.run(list(asked.values()))
    return read_attempt(dict(zip(asked, answers, strict=False)))


def _reason(attempt: Attempt, request: BuildRequest, sources: _Sources) -> BuildError:
    """Return the error that explains why the attempt did not produce an FMU."""
    known = sources.classes.get(request.model)
    if known is None or known.kind not in MODEL_KINDS:
        reasons = [str(message) for message in attempt.load_errors]
        return not_found(request.model, sources.library, sources.classes, reasons)
    return failure(attempt.load_errors or attempt.messages, request.model, known.file)


def _log(opened: Opened, attempt: Attempt, request: BuildRequest, options: Options) -> str:
    lines = [f"OpenModelica {attempt.version}: {opened.what}", opened.log().strip()]
    if "cs" in request.fmi_types:
        lines.append(
            f"co-simulation: integrator {options.cs_solver} requested"
            if attempt.solver_offered
            else "co-simulation: integrator explicit Euler, the only one in this OpenModelica"
        )
    lines += map(str, attempt.messages)
    return "".join(f"{line}\n" for line in lines if line)
