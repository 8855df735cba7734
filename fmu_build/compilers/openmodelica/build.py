"""Write the statements that build an FMU, and evaluate the answers to them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.compilers.openmodelica.finding import plain_version
from fmu_build.compilers.openmodelica.messages import Answer, Message, errors, quoted
from fmu_build.support.request import BuildRequest

_TYPES = {("cs",): "cs", ("cs", "me"): "me_cs", ("me",): "me"}
_VERSION, _SOLVER, _LOAD = "version", "solver", "load"


def identifier(model: str) -> str:
    """Return the base name of the FMU: the last part of the class name, as a C identifier."""
    return re.sub(r"\W", "_", model.rpartition(".")[2])


def build_call(request: BuildRequest) -> str:
    """Return the call of ``buildModelFMU``; its named arguments have been the same since version 1.14."""
    types = _TYPES[tuple(sorted(set(request.fmi_types)))]
    return (
        f"buildModelFMU({request.model}, version={quoted(request.fmi_version)}, fmuType={quoted(types)}, "
        f'fileNamePrefix={quoted(identifier(request.model))}, platforms={{"static"}})'
    )


def solver_call(solver: str) -> str:
    """Return the call that selects an integrator for co-simulation, an option since version 1.16."""
    return f"setCommandLineOptions({quoted(f'--fmiFlags=s:{solver}')})"


def statements(request: BuildRequest, files: Sequence[Path], folder: Path, solver: str) -> Mapping[str, str]:
    """Return the statements of a build in order, each with a name for its answer.

    `files` are the libraries' entry files; the FMU is built in `folder`.
    """
    return {
        _VERSION: "getVersion()",
        "folder": f"cd({quoted(str(folder))})",
        **({_SOLVER: solver_call(solver)} if "cs" in request.fmi_types else {}),
        **{f"{_LOAD} {file}": f"loadFile({quoted(str(file))})" for file in files},
        "build": build_call(request),
    }


@dataclass(frozen=True, slots=True)
class Attempt:
    """The outcome of a build."""

    version: str
    load_errors: tuple[Message, ...]
    messages: tuple[Message, ...]
    """Messages of all statements except the one for the solver, whose rejection is not a failure."""
    solver_offered: bool


def read_attempt(answers: Mapping[str, Answer]) -> Attempt:
    """Evaluate the answers to the statements of a build; the last ones may be missing."""
    loading = [answer for name, answer in answers.items() if name.startswith(_LOAD)]
    return Attempt(
        version=plain_version(answers[_VERSION].text),
        load_errors=tuple(error for answer in loading for error in errors(answer.messages)),
        messages=tuple(m for name, answer in answers.items() if name != _SOLVER for m in answer.messages),
        solver_offered=_SOLVER in answers and answers[_SOLVER].succeeded,
    )
