"""Positions in Modelica source, and messages that begin with one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_MOST_NAMED = 5
"""Longer lists of candidate positions are omitted, because they would not help."""


@dataclass(frozen=True, slots=True)
class Place:
    """A file, line and column (both one-based), printed as compilers and editors do."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


def place_at(file: str | Path, text: str, offset: int) -> Place:
    """Return the position of the character at an offset in a file's text."""
    line = text.count("\n", 0, offset) + 1
    return Place(str(file), line, offset - text.rfind("\n", 0, offset))


def located(what: str, places: Sequence[Place], model: str, file: str | Path) -> str:
    """Return a message that begins with its position, if exactly one is known.

    Otherwise it begins with the file of the model, names the model, and lists a few candidate positions.
    """
    distinct = list(dict.fromkeys(places))
    if len(distinct) == 1:
        return f"{distinct[0]}: {what}"
    candidates = f"; see {', '.join(map(str, distinct))}" if 1 < len(distinct) <= _MOST_NAMED else ""
    return f"{file}: {what} (model {model}{candidates})"
