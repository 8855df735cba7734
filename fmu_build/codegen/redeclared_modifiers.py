"""Modifiers of replaceable declarations that rumoca applies to redeclarations differently from Modelica.

In Modelica, a redeclaration keeps the modifiers of the replaced declaration unless that names a constraining
class (Modelica 3.6, section 7.3.2). rumoca keeps them, in both cases, only for components that are redeclared
in a modifier, and otherwise drops them.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.modifiers import Path, assigned, closing
from fmu_build.codegen.modelica_source.text import REDECLARE

_KIND = r"(?:model|block|record|type|package|class|function|connector)"
_ARRAY = r"(?:\[[^\]]*\]\s*)?"
_CLASS = rf"{_KIND}\s+(?P<class>\w+)\s*=\s*[\w.]+\s*{_ARRAY}\(?"
PREFIXES = r"(?:(?:final|inner|outer|parameter|constant|discrete|input|output|flow|stream)\s+)*"
_NAMED = rf"{PREFIXES}(?!{_KIND}\b|replaceable\b)[\w.]+\s+(?P<component>\w+)\s*{_ARRAY}"
_COMPONENT = rf"{_NAMED}\(?"
_REDECLARATION = rf"{REDECLARE}(?:{_CLASS}|{_COMPONENT})"
_DECLARATION = rf"(?:redeclare\s+)?(?:replaceable\s+)?(?:{_CLASS}|{_COMPONENT})"
_ARGUMENT = r"(?<=[(,])\s*(?:(?:each|final)\s+)*"
_IN_A_MODIFIER = rf"{_ARGUMENT}{_REDECLARATION}"
#: The modifiers may be nested once.
_VALUE = rf"{_ARGUMENT}{REDECLARE}{_NAMED}(?:\((?:[^()]|\([^()]*\))*\)\s*)?=(?!=)"
_AS_AN_ELEMENT = rf"(?<![(,\s])(?<!\beach)(?<!\bfinal)\s+{_REDECLARATION}"


def changed_modifiers(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the clause of each affected redeclaration of a component or short class."""
    for construct in text.find([_VALUE]):
        yield (
            "the value of a component that is redeclared inside a modifier is lost; "
            "redeclare it in a class that extends the component's, or modify it without a redeclaration",
            construct,
        )
    redeclarations = [
        (construct, in_a_modifier)
        for pattern, in_a_modifier in ((_IN_A_MODIFIER, True), (_AS_AN_ELEMENT, False))
        for construct in text.find([pattern])
    ]
    declared = _declarations(text) if redeclarations else {}
    for redeclaration, in_a_modifier in redeclarations:
        found = re.search(_REDECLARATION, redeclaration.plain)
        assert found is not None  # by the pattern
        is_kept = in_a_modifier and found["component"] is not None
        now = _modifiers(redeclaration.plain[found.start() :])
        for declaration in declared.get((found["class"], found["component"]), ()):
            given = sorted(".".join(path) for path in _modifiers(declaration) - now)
            is_constrained = re.search(r"\bconstrainedby\b", declaration) is not None
            if given and is_kept == is_constrained:
                yield _explanation(given, is_kept=is_kept), redeclaration


def _explanation(given: list[str], *, is_kept: bool) -> str:
    names = ", ".join(given)
    if is_kept:
        return (
            f"what the declaration gives to {names} would be kept, although it names a constraining class; "
            "give it a value in the redeclaration"
        )
    return f"what the declaration gives to {names} would be lost; repeat it in the redeclaration"


def _declarations(text: ModelText) -> dict[tuple[str | None, str | None], list[str]]:
    """Return the replaceable declarations up to their semicolons, by class name or component name."""
    declared = defaultdict(list)
    for construct in text.find([r"(?<!redeclare )\breplaceable\b[^;]*"]):
        found = re.match(_DECLARATION, construct.plain)
        if found is not None:
            declared[found["class"], found["component"]].append(construct.plain)
    return declared


def _modifiers(declaration: str) -> set[Path]:
    """Return the names that the modifiers of a declaration set."""
    found = re.match(_DECLARATION, declaration)
    if found is None or not found[0].endswith("("):
        return set()
    return assigned(declaration[found.end() : closing(declaration, found.end() - 1) - 1])
