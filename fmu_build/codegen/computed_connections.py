"""Connections with subscripts or conditions that rumoca does not evaluate: it connects all there are.

It evaluates whole numbers, Integers and Booleans of the class itself, iterators, and plain arithmetic with
them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from typing import Final

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.equations import IfEquation, equations
from fmu_build.codegen.modelica_source.inheritance import Inheritance
from fmu_build.codegen.modelica_source.modifiers import closing

_CONNECT: Final = r"\bconnect\s*\("
_SUBSCRIPTS: Final = re.compile(r"\[((?:[^\[\]]|\[[^\[\]]*\])*)\]")
_ITERATOR: Final = re.compile(r"(?:\bfor|,)\s+(\w+)\s+in\b")
_NUMBER: Final = re.compile(r"(?<![\w.])\d+(?![\w.])")
_WORDS: Final = frozenset(("and", "or", "not", "true", "false"))
_HEADS: Final = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
#: What may stand in a subscript besides numbers and names, and in a condition.
_IN_SUBSCRIPT: Final = re.compile(r"[-+*:()\s,]*")
_IN_CONDITION: Final = re.compile(r"[-+*()\s<>=]*")
_OF_COMPONENT: Final = re.compile(r"\bif\b((?:(?!\bthen\b)[^;,])*)(?=[;,])")
_QUALIFIED: Final = re.compile(r"(?:\w+\s*\.\s*)+(\w+)")


def computed_connections(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield what is not evaluated, and the place."""
    inheritance = Inheritance(text)
    for name, _, own in text.named():
        declared = {
            one.name: one.type
            for base in inheritance.ancestry(name.rpartition(".")[2])
            for one in inheritance.all_components(base)
        }
        whole = {one for one, kind in declared.items() if kind in ("Integer", "Boolean")}
        whole |= set(_ITERATOR.findall(own))
        for call in re.finditer(_CONNECT, own):
            ends = own[call.end() : closing(own, call.end() - 1) - 1]
            for subscripts in _SUBSCRIPTS.findall(ends):
                if not _is_plain_subscript(subscripts, whole, declared.keys()):
                    yield from _found(text, _CONNECT, ends, f"the subscript [{subscripts}] in connect()")
        for condition in _conditions(own):
            if not _is_plain(condition, whole, _IN_CONDITION):
                what = f"the condition {' '.join(condition.split())} of a connection"
                yield from _found(text, r"\bif\b[^;]*?\bthen\b", condition, what)
        yield from _conditions_of_components(text, own, declared.keys())


def _found(text: ModelText, pattern: str, part: str, what: str) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the constructs that contain a part of the source."""
    why = f"{what} would be ignored, because the compiler cannot evaluate it; use a parameter of the class"
    for construct in text.find([pattern]):
        if " ".join(part.split()) in construct.plain:
            yield why, construct


def _is_plain(given: str, names: Set[str], signs: re.Pattern[str]) -> bool:
    """Return whether an expression has only numbers, these names and these signs, and no calls."""
    if re.search(r"\w\s*[(\[.]", re.sub(r"\b(?:and|or|not)\b", "+", given)):
        return False
    rest = _NUMBER.sub("", given)
    return set(_HEADS.findall(rest)) <= names | _WORDS and signs.fullmatch(_HEADS.sub("", rest)) is not None


def _is_plain_subscript(subscripts: str, whole: Set[str], declared: Set[str]) -> bool:
    plain = re.sub(r"\bdiv\s*(?=\()", "", subscripts)
    # Integers of components are evaluated, those of packages are not.
    plain = re.sub(
        r"(?<![\w.])([A-Za-z_]\w*)(?:\s*\.\s*\w+)+",
        lambda found: "1" if found[1] in declared else found[0],
        plain,
    )
    return _is_plain(plain, whole, _IN_SUBSCRIPT)


def _conditions(own: str) -> Iterator[str]:
    """Yield the conditions of if-equations with connections."""
    for one in equations(own):
        if isinstance(one, IfEquation) and re.search(_CONNECT, own[one.start : one.end]):
            yield from _of_branches(own, one)


def _of_branches(own: str, one: IfEquation) -> Iterator[str]:
    yield from (branch.condition for branch in one.branches if branch.condition)
    for branch in one.branches:
        for inner in branch.inner:
            if re.search(_CONNECT, own[inner.start : inner.end]):
                yield from _of_branches(own, inner)


def _conditions_of_components(
    text: ModelText, own: str, declared: Set[str]
) -> Iterator[tuple[str, Construct]]:
    """Yield conditions of components with a name of another class that is also one of this class."""
    declarations = re.split(r"\b(?:equation|algorithm)\b", own)[0]
    for condition in _OF_COMPONENT.findall(declarations):
        for last in _QUALIFIED.findall(condition):
            if last in declared:
                why = f"{last} in the condition{condition.rstrip()} would be that of the class; rename it"
                for construct in text.find([r"\bif\b[^;]*"]):
                    if " ".join(condition.split()) in construct.plain:
                        yield why, construct
