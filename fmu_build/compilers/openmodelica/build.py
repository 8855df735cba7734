"""The statements that make an FMU, and what the answers to them say."""

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
    """The name of the FMU's files: the last part of the class name, with ``_`` for what C does not take."""
    return re.sub(r"\W", "_", model.rpartition(".")[2])


def build_call(request: BuildRequest) -> str:
    """The call of ``buildModelFMU``; its named arguments are the same from version 1.14 to the newest."""
    types = _TYPES[tuple(sorted(set(request.fmi_types)))]
    return (
        f"buildModelFMU({request.model}, version={quoted(request.fmi_version)}, fmuType={quoted(types)}, "
        f'fileNamePrefix={quoted(identifier(request.model))}, platforms={{"static"}})'
    )


def solver_call(solver: str) -> str:
    """Asks for an integrator in the co-simulation; versions before 1.16 do not know the option."""
    return f"setCommandLineOptions({quoted(f'--fmiFlags=s:{solver}')})"


def statements(request: BuildRequest, files: Sequence[Path], folder: Path, solver: str) -> Mapping[str, str]:
    """The statements of a build, in their order, each by a name for its answer.

    `files` are the libraries' entry files; the FMU is made in `folder`.
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
    """What has come of a build."""

    version: str
    load_errors: tuple[Message, ...]
    messages: tuple[Message, ...]
    """Of all statements but that for the solver, whose refusal is no failure."""
    solver_offered: bool


def read_attempt(answers: Mapping[str, Answer]) -> Attempt:
    """What the answers to the statements of a build say; the last ones may be missing."""
    loading = [answer for name, answer in answers.items() if name.startswith(_LOAD)]
    return Attempt(
        version=plain_version(answers[_VERSION].text),
        load_errors=tuple(error for answer in loading for error in errors(answer.messages)),
        messages=tuple(m for name, answer in answers.items() if name != _SOLVER for m in answer.messages),
        solver_offered=_SOLVER in answers and answers[_SOLVER].succeeded,
    )
