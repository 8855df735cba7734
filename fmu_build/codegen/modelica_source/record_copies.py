"""Rewrite records assigned as a whole, ``C c(data = d)``, into a form that rumoca accepts.

rumoca copies the nearest literal in a modifier of ``d`` to each member of ``c.data``, instead of binding it
to the member of ``d``: values in outer modifiers are lost, and members do not follow values set at run time.
In parentheses, ``C c(data = (d))``, the name is an ordinary expression, to whose members rumoca binds.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.clauses import NAME, SUBSCRIPTS, component_clauses
from fmu_build.codegen.modelica_source.modifiers import closing
from fmu_build.codegen.modelica_source.text import blanked, declarations

_ELEMENT = rf"{NAME}(?:\s*\[[^\[\]:{{}}]*\])?"
_REFERENCE = rf"\.?{_ELEMENT}(?:\.{_ELEMENT})*"
_VALUE = re.compile(
    rf"\s*=(?!=)\s*(?P<reference>{_REFERENCE})(?=\s*(?:[,;)]|\bannotation\b|\bconstrainedby\b|\bif\b))"
)
_ARRAY_VALUE = re.compile(r"\s*=(?!=)\s*(?:fill\s*(?=\()|(?=\{))")
#: A component whose elements get their records from an array: rumoca binds these correctly.
_ARRAY = re.compile(rf"{NAME}\s*\[[^\[\]]*\]\s*\(")
#: The name of a class or of an import, which is given a class and not a record.
_CLASS_NAME = re.compile(
    rf"\b(?:import|package|model|block|class|record|type|connector|function)\s+{NAME}(?=\s*=(?!=))"
)
_SECTION = re.compile(r"\b(equation|algorithm|public|protected)\b")
_ALIAS = rf"\bimport\s+(?P<name>{NAME})\s*=\s*(?:{NAME}\s*\.\s*)*(?:CLASSES)\s*;"


def with_records_in_parentheses(texts: Mapping[Path, str]) -> dict[Path, str]:
    """Return the texts of all files, with parentheses around names that are assigned as whole records.

    A name of any component of a record class counts as such a component everywhere.
    """
    classes = _record_classes(texts.values())
    components = {
        one.name for text in texts.values() for one in component_clauses(blanked(text)) if one.type in classes
    }
    if not components:
        return dict(texts)
    names = "|".join(map(re.escape, sorted(components)))
    given = re.compile(rf"(?<![\w.])(?:{names}){SUBSCRIPTS}\s*")
    named = re.compile(rf"(?<![\w.])(?:{NAME}{SUBSCRIPTS}\s*\.\s*)*(?:{names}){SUBSCRIPTS}(?!\w|\s*[.(=\[])")
    return {file: _in_parentheses(text, given, named) for file, text in texts.items()}


def _record_classes(texts: Iterable[str]) -> set[str]:
    """Return the simple names of all record classes, including imported ones."""
    found = {
        declared.name.rpartition(".")[2]
        for text in texts
        for declared in declarations(text)
        if declared.kind.endswith("record")
    }
    if found:
        alias = re.compile(_ALIAS.replace("CLASSES", "|".join(map(re.escape, sorted(found)))))
        found |= {one["name"] for text in texts for one in alias.finditer(blanked(text))}
    return found


def _in_parentheses(text: str, given: re.Pattern[str], named: re.Pattern[str]) -> str:
    plain = _CLASS_NAME.sub(lambda found: " " * len(found[0]), blanked(text))
    places = {
        place
        for first, last in _declaring(text, plain)
        for end in _given(plain, given, first, last)
        for place in _references(plain, named, end, last)
    }
    for start, end in sorted(places, reverse=True):
        text = f"{text[:start]}({text[start:end]}){text[end:]}"
    return text


def _given(plain: str, given: re.Pattern[str], first: int, last: int) -> Iterator[int]:
    """Yield the positions where the values, if any, of components with these names begin."""
    arrays = [(one.end(), closing(plain, one.end() - 1)) for one in _ARRAY.finditer(plain, first, last)]
    for found in given.finditer(plain, first, last):
        end = found.end()
        if plain[end : end + 1] == "(":
            end = closing(plain, end)
        around = [start for start, close in arrays if start <= found.start() < close]
        if _ARRAY_VALUE.match(plain, end) or all(_is_each(plain[one : found.start()]) for one in around):
            yield end


def _is_each(before: str) -> bool:
    """Return whether the text before a value, or an enclosing modifier, gives it with "each"."""
    depth, is_inside = 0, True
    for place in range(len(before) - 1, -2, -1):
        character = before[place] if place >= 0 else "("
        depth += {")": 1, "]": 1, "}": 1, "(": -1, "[": -1, "{": -1}.get(character, 0)
        if is_inside and (depth < 0 or (depth == 0 and character == ",")):
            if re.match(r"\s*each\b", before[place + 1 :]):
                return True
            is_inside = False
        if depth < 0:
            depth, is_inside = 0, True
    return False


def _references(plain: str, named: re.Pattern[str], start: int, last: int) -> Iterator[tuple[int, int]]:
    """Yield the positions of the references in a value: the value itself, or the elements of an array."""
    if (value := _VALUE.match(plain, start, last)) is not None:
        yield value.span("reference")
    elif (array := _ARRAY_VALUE.match(plain, start, last)) is not None:
        end = closing(plain.replace("{", "(").replace("}", ")"), array.end())
        yield from (found.span() for found in named.finditer(plain, array.end(), end))


def _declaring(text: str, plain: str) -> Iterator[tuple[int, int]]:
    """Yield the parts of a text that are not equations or algorithms."""
    classes = [one for one in declarations(text) if not one.in_modifier]
    places = {one.start: "class" for one in classes} | {one.end: "end" for one in classes}
    places |= {found.start(): found[1] for found in _SECTION.finditer(plain)}
    sections = [""]
    start = 0
    for place, what in sorted(places.items()):
        if sections[-1] not in ("equation", "algorithm"):
            yield start, place
        start = place
        if what == "class":
            sections.append("")
        elif what == "end":
            sections.pop()
        else:
            sections[-1] = what
    yield start, len(plain)
