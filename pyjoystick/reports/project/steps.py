"""Steps of a project, each of which makes files from files and settings."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from pyjoystick import laboratory, model
from pyjoystick.support import PyJoystickError, write_text

#: Folder of results, relative to the project.
RESULTS: Final = "results"

#: Returns the file of an FMU for its name or path.
Find = Callable[[str], Path]
#: Called with a text that describes what a step is doing.
Tell = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """Outcome of a step.

    Attributes:
        files: files that it wrote, relative to the project
        remark: its result in a few words
        notes: doubts about the result, one sentence each
    """

    files: tuple[str, ...]
    remark: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """A step of a project.

    Attributes:
        name: unique in the project
        inputs: files that it reads, relative to the project
        outputs: files that it writes and other steps read
        settings: everything else that its result depends on, as JSON types
        work: function that executes it
    """

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    work: Callable[[Tell], Done]
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Missing:
    """A step that cannot be executed because something is missing.

    Attributes:
        name: name of the step
        reason: what is missing
        named: whether laboratory.toml asks for it
    """

    name: str
    reason: str
    named: bool = False


def write_values(path: Path, found: laboratory.MeasuredValues) -> None:
    """Write measured values as JSON; raises OutputFileError."""
    content = {name: dict(getattr(found, name)) for name in ("values", "uncertainties", "sources")}
    write_text(path, json.dumps(content, indent=2, ensure_ascii=False) + "\n")


def read_values(path: Path) -> laboratory.MeasuredValues:
    """Read a file written by `write_values`."""
    return laboratory.MeasuredValues(**json.loads(path.read_text(encoding="utf-8")))


def digest(path: Path) -> str:
    """Return the SHA-256 digest of a file's content."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def content_of(name: str, find: Find) -> str:
    """Return the digest of an FMU's file; empty if there is none, or none yet."""
    try:
        return digest(find(name))
    except (PyJoystickError, OSError):  # the step that runs it reports the error
        return ""


def with_error(value: float, error: float) -> str:
    """Format a value with its standard uncertainty, rounded to the significant digits."""
    return (
        f"{model.rounded(value, error):.9g} +- {model.rounded_error(error):g}"
        if error > 0.0
        else f"{value:.9g}"
    )
