"""Places in Modelica source, and messages that begin with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_MOST_NAMED = 5
"""With more places than this none of them helps to find the one that is meant."""


@dataclass(frozen=True, slots=True)
class Place:
    """A line and a column (both from 1) of a file; printed as compilers and editors do."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


def place_at(file: str | Path, text: str, offset: int) -> Place:
    """The place of a character of a file's text."""
    line = text.count("\n", 0, offset) + 1
    return Place(str(file), line, offset - text.rfind("\n", 0, offset))


def located(what: str, places: Sequence[Place], model: str, file: str | Path) -> str:
    """A message with its place, where exactly one is known.

    Otherwise it begins with the file of the model, names the model, and lists the places that come into
    question.
    """
    distinct = list(dict.fromkeys(places))
    if len(distinct) == 1:
        return f"{distinct[0]}: {what}"
    candidates = f"; see {', '.join(map(str, distinct))}" if 1 < len(distinct) <= _MOST_NAMED else ""
    return f"{file}: {what} (model {model}{candidates})"
