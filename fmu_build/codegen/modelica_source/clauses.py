"""Component clauses in Modelica source: the type, name and modifiers of each component."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from fmu_build.codegen.modelica_source.modifiers import closing

NAME = r"(?:[A-Za-z_]\w*|'(?:[^'\\\n]|\\.)*')"
SUBSCRIPTS = r"(?:\s*\[[^\[\]]*\])?"

COMPONENT_CLAUSE = rf"(?<![\w.])[\w.']+\s+{NAME}\s*(?:\[[^\]]*\]\s*)?[(=,][^;]*"
"""A component clause with a modifier, a value or several names; `component_clauses` skips false matches."""
EXTENSION_CLAUSE = (
    r"\b(?:extends\s+|(?:model|block|record|package|class)\s+\w+\s*=\s*)(?:[\w']+\.)*(?P<base>[\w']+)\s*"
    r"(?:\[[^\]]*\]\s*)?(?P<open>(?=\())?"
)
"""An ``extends`` clause or a short class, up to its modifiers."""

_KINDS = r"(?:model|block|record|type|package|class|function|connector|operator)"
_HEADER = re.compile(
    rf"(?:(?:encapsulated|partial|expandable|pure|impure|operator)\s+)*{_KINDS}\s+(?:extends\s+)?{NAME}\s"
)
_PREFIXES = re.compile(
    r"\s*(?:(?:public|protected|final|inner|outer|redeclare|replaceable|flow|stream|discrete|parameter|constant|"
    r"input|output|each)\s+)*"
)
_NO_TYPE = (
    r"(?:algorithm|annotation|connect|else|elseif|elsewhen|encapsulated|end|equation|extends|external|for|if|"
    rf"import|initial|partial|return|when|while|within|{_KINDS})\b"
)
_CLAUSE = re.compile(rf"(?!{_NO_TYPE})(?P<type>\.?{NAME}(?:\s*\.\s*{NAME})*){SUBSCRIPTS}\s+(?={NAME})")
_COMPONENT = re.compile(rf"\s*(?P<name>{NAME}){SUBSCRIPTS}\s*")


@dataclass(frozen=True, slots=True)
class Component:
    """A component as declared.

    Attributes:
        type: simple name of its class
        name: its own name
        modifiers: text between the parentheses after its name
        value: text after its equals sign; empty if it gets no value as a whole
        is_array: whether it has subscripts, or its type has
    """

    type: str
    name: str
    modifiers: str
    value: str
    is_array: bool


def component_clauses(plain: str) -> Iterator[Component]:
    """Yield the components declared in a text without comments and strings."""
    for statement in plain.split(";"):
        header = _HEADER.match(statement.lstrip())
        text = statement.lstrip()[header.end() :] if header else statement
        start = _PREFIXES.match(text)
        clause = _CLAUSE.match(text, start.end() if start else 0)
        if clause is not None:
            simple = clause["type"].rpartition(".")[2].strip()
            yield from _components(simple, text, clause.end(), all_arrays=clause[0].rstrip().endswith("]"))


def _components(simple: str, text: str, start: int, *, all_arrays: bool) -> Iterator[Component]:
    """Yield the components between commas, from the one whose name begins at `start`."""
    while (found := _COMPONENT.match(text, start)) is not None:
        place, modifiers = found.end(), ""
        if text[place : place + 1] == "(":
            end = closing(text, place)
            modifiers, place = text[place + 1 : end - 1], end
        end = _end(text, place)
        value = re.match(r"\s*=(?!=)", text[place:end])
        given = text[place + value.end() : end].strip() if value else ""
        is_array = all_arrays or found[0].rstrip().endswith("]")
        yield Component(simple, found["name"], modifiers, given, is_array)
        start = end + 1


def components(plain: str, start: int) -> list[str]:
    """Return the components of the clause that begins at `start`, each with its modifiers and annotation.

    The first still has the clause's type before its name.
    """
    found = []
    while True:
        end = _end(plain, start)
        found.append(plain[start:end])
        if plain[end : end + 1] != ",":
            return found
        start = end + 1


def _end(text: str, start: int) -> int:
    """Return the position of the comma or semicolon that ends a component, or the end of the text."""
    depth = 0
    for place in range(start, len(text)):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(text[place], 0)
        if depth == 0 and text[place] in ",;":
            return place
    return len(text)
