"""Steps of a project, each from files and settings to files."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from pyjoystick import laboratory, model
from pyjoystick.support import PyJoystickError, write_text

#: The folder of results, relative to the project.
RESULTS: Final = "results"

#: From the name of an FMU, or its path, to its file.
Find = Callable[[str], Path]
#: Called with what a step is doing.
Tell = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """What a step has done.

    Attributes:
        files: what it wrote, relative to the project
        remark: its result in a few words
        notes: what is doubtful, a sentence each
    """

    files: tuple[str, ...]
    remark: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """A step.

    Attributes:
        name: unique in the project
        inputs: files that it reads, relative to the project
        outputs: files that other steps read
        settings: what else its result depends on, as JSON has it
        work: does it
    """

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    work: Callable[[Tell], Done]
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Missing:
    """A step that lacks its files.

    Attributes:
        name: of the step
        reason: what is not there
        named: whether laboratory.toml asks for it
    """

    name: str
    reason: str
    named: bool = False


def write_values(path: Path, found: laboratory.MeasuredValues) -> None:
    """Write what a measurement says as JSON; raises OutputFileError."""
    content = {name: dict(getattr(found, name)) for name in ("values", "uncertainties", "sources")}
    write_text(path, json.dumps(content, indent=2, ensure_ascii=False) + "\n")


def read_values(path: Path) -> laboratory.MeasuredValues:
    """What `write_values` wrote."""
    return laboratory.MeasuredValues(**json.loads(path.read_text(encoding="utf-8")))


def digest(path: Path) -> str:
    """The digest of a file's content."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def content_of(name: str, find: Find) -> str:
    """The digest of an FMU's file; empty where there is none, or none yet."""
    try:
        return digest(find(name))
    except (PyJoystickError, OSError):  # the step that runs it will say what is wrong
        return ""


def with_error(value: float, error: float) -> str:
    """A value with its standard uncertainty, to the digits that are known."""
    return (
        f"{model.rounded(value, error):.9g} +- {model.rounded_error(error):g}"
        if error > 0.0
        else f"{value:.9g}"
    )
