"""Equations in Modelica source that are calls alone: ``terminate(...);``, ``f(x);``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from fmu_build.modelica_source.modifiers import closing

_WHEN = re.compile(r"(?<![\w.])when\b.*?\bend\s+when\b", re.DOTALL)
_MATRIX = re.compile(r"\[[^\[\]]*\]")
_SECTION = re.compile(r"(?<![\w.])(?P<name>equation|algorithm)\b")
_CALL = re.compile(
    r"(?P<before>;|\b(?:equation|then|else|loop))\s*(?P<name>[A-Za-z_]\w*(?:\s*\.\s*\w+)*)\s*(?=\()"
)
_BEFORE = re.compile(r"\b(?:equation|loop)\b")
_RELATION = re.compile(r"==|<=|>=|<>")


class Call(NamedTuple):
    """A call and the offsets of its equation."""

    name: str
    start: int
    end: int


def called_equations(plain: str) -> Iterator[Call]:
    """Yield calls outside of when-clauses from a text without comments and strings, but no statements."""
    text = plain
    while (inner := _MATRIX.sub(_blank, text)) != text:  # semicolons separate rows, too
        text = inner
    text = _WHEN.sub(_blank, text)
    sections = [(found.start(), found["name"]) for found in _SECTION.finditer(text)]
    for found in _CALL.finditer(text):
        end = closing(text, found.end())
        before = [name for place, name in sections if place < found.start("name")]
        if before[-1:] == ["equation"] and text[end:].lstrip()[:1] == ";" and not _in_expression(text, found):
            yield Call("".join(found["name"].split()), found.start("name"), end)


def _blank(found: re.Match[str]) -> str:
    return " " * len(found[0])


def _in_expression(text: str, call: re.Match[str]) -> bool:
    """Return whether a call after ``then`` or ``else`` is part of an expression."""
    place = call.start("name")
    before = text[text.rfind(";", 0, place) + 1 : place]
    return "=" in _RELATION.sub("", _BEFORE.split(before)[-1])
