"""Modifiers in Modelica source: the names of nested components that they set."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

Path = tuple[str, ...]

_ARGUMENT = re.compile(
    r"\s*(?:(?:each|final|replaceable)\s+)*(?P<name>[\w.']+)\s*(?:\[[^\]]*\]\s*)?(?P<rest>[(=].*|)$",
    re.DOTALL,
)


def closing(text: str, opening: int) -> int:
    """Return the position after the ``)`` that closes the ``(`` at `opening`, or the end of the text."""
    depth = 0
    for position in range(opening, len(text)):
        depth += {"(": 1, ")": -1}.get(text[position], 0)
        if depth == 0:
            return position + 1
    return len(text)


def assigned(arguments: str) -> set[Path]:
    """Return the dotted paths that a modifier sets.

    Args:
        arguments: text between the parentheses, without comments and strings: ``a(s(k = 9)), b = 1`` sets
            ``("a", "s", "k")`` and ``("b",)``. Redeclarations are skipped.
    """
    return set(values(arguments))


def values(arguments: str) -> dict[Path, str]:
    """Return the values that a modifier, given as for `assigned`, gives to the paths that it sets."""
    return dict(given for argument in _split(arguments) for given in _given(argument))


def repeated(arguments: str) -> set[Path]:
    """Return the paths that a modifier, given as for `assigned`, gives a value more than once."""
    paths = Counter(path for argument in _split(arguments) for path, _ in _given(argument))
    return {path for path, times in paths.items() if times > 1}


def _given(argument: str) -> Iterator[tuple[Path, str]]:
    found = _ARGUMENT.match(argument)
    if found is None or found["name"] == "redeclare":
        return
    name, rest = tuple(found["name"].split(".")), found["rest"]
    if rest.startswith("("):
        end = closing(rest, 0)
        yield from ((name + path, value) for path, value in values(rest[1 : end - 1]).items())
        rest = rest[end:]
    if rest.lstrip().startswith("="):
        yield name, rest.lstrip()[1:].strip()


def dotted(arguments: str) -> Iterator[str]:
    """Yield the dotted names that a modifier, given as for `assigned`, uses to set something."""
    for argument in _split(arguments):
        found = _ARGUMENT.match(argument)
        if found is None or not assigned(argument):
            continue
        if "." in found["name"]:
            yield found["name"]
        if found["rest"].startswith("("):
            yield from dotted(found["rest"][1 : closing(found["rest"], 0) - 1])


def _split(arguments: str) -> Iterator[str]:
    """Split arguments at the commas outside all brackets."""
    depth, start = 0, 0
    for position, character in enumerate(arguments):
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(character, 0)
        if character == "," and depth == 0:
            yield arguments[start:position]
            start = position + 1
    yield arguments[start:]
