"""Scan Modelica source text for facts that the compiler does not pass on."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

STRING = r'"(?:[^"\\]|\\.)*"'
REDECLARE = r"\bredeclare\s+(?:(?:each|final|inner|outer|replaceable)\s+)*"
"""A pattern of what stands before a redeclared class or component."""

_SKIPPED = re.compile(rf"('(?:[^'\\\n]|\\.)*')|{STRING}|//[^\n]*|/\*.*?\*/", re.DOTALL)
_TOKEN = re.compile(r"'(?:[^'\\\n]|\\.)*'|[A-Za-z_][A-Za-z0-9_]*|[=;.]")
_OPENING = re.compile(r"\s*\(")
_KINDS = frozenset(
    {"model", "block", "class", "package", "function", "record", "connector", "type", "operator"}
)


@dataclass(frozen=True, slots=True)
class Declaration:
    """A class declared in a file: its qualified name and its restriction ("model", "partial model", ...).

    `start` and `end` are offsets into the text; `in_modifier` is true for ``(redeclare model A = B)``.
    """

    name: str
    kind: str
    start: int
    end: int
    in_modifier: bool


@lru_cache(maxsize=1024)  # used by every query about a source
def blanked(text: str) -> str:
    """Return the text with comments and strings replaced by spaces; offsets and lines are unchanged."""
    return _SKIPPED.sub(lambda match: match[1] or re.sub(r"[^\n]", " ", match.group()), text)


def declarations(text: str) -> Iterator[Declaration]:
    """Yield the classes that a file declares, inner ones first, from its tokens alone.

    Parsing is lenient: a class that is never closed extends to the end of the text.
    """
    plain = blanked(text)
    tokens = list(_TOKEN.finditer(plain))
    words = [token.group() for token in tokens]
    prefix = _within(words)
    scope: list[tuple[str, str, int]] = []

    def closed(end: int) -> Declaration:
        name = ".".join((*prefix, *(name for name, _, _ in scope)))
        _, kind, start = scope.pop()
        return Declaration(name, kind, start, end, in_modifier=False)

    for position, word in enumerate(words):
        previous = words[position - 1] if position else ";"
        if previous == "end" and scope and word == scope[-1][0]:
            yield closed(tokens[position].end())
        elif word in _KINDS and previous not in ("end", "."):
            name, following = (*words[position + 1 : position + 3], "", "")[:2]
            if not name or name in _KINDS or not (name[0].isalpha() or name[0] in "_'"):
                continue
            if name == "extends":
                name, following = following, ""
            elif following == "." or _OPENING.match(plain, tokens[position + 1].end()):
                continue  # a function as an argument: function Library.f(a = 2)
            kind = f"partial {word}" if previous == "partial" else word
            start = tokens[position].start()
            if following == "=":
                qualified = ".".join((*prefix, *(outer for outer, _, _ in scope), name))
                semicolon = plain.find(";", start)
                end = semicolon if semicolon >= 0 else len(plain)
                yield Declaration(qualified, kind, start, end, inside_parentheses(plain, start))
            else:
                scope.append((name, kind, start))
    while scope:
        yield closed(len(plain))


def inside_parentheses(text: str, position: int) -> bool:
    """Return whether a position is inside parentheses, and so in a modifier; `text` is blanked."""
    statement = text[text.rfind(";", 0, position) + 1 : position]
    return statement.count("(") > statement.count(")")


def _within(words: list[str]) -> list[str]:
    if words[:1] != ["within"]:
        return []
    return [word for word in words[1 : words.index(";")] if word != "."] if ";" in words else []
