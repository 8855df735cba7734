"""Modifiers that rumoca loses without a word.

Where a class is extended, only the outermost modifiers are merged: ``extends B(a(s(k = 9)))`` replaces the
whole modifier ``s(...)`` that B gives to a, although Modelica merges the two (Modelica 3.6, section 7.2.3).
Modifiers of redeclared and constraining classes can be lost, too, and so can those with dotted names; see
also `redeclared_modifiers` and `changed_constants`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

from fmu_build.codegen.changed_constants import changed_constants
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.redeclared_modifiers import changed_modifiers
from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.modelica_source.modifiers import Path as NamePath, assigned, closing, dotted
from fmu_build.modelica_source.places import located
from fmu_build.modelica_source.text import inside_parentheses
from fmu_build.support.errors import UnsupportedModelError

_KINDS = r"(?:model|block|record|type|package|class)"
_REDECLARED_CLASS = (
    rf"(?<=[(,])\s*\bredeclare\s+(?:replaceable\s+)?{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\(",
    "the modifiers of a class that is redeclared inside a modifier are lost; "
    "give the class with its modifiers a name of its own",
)
_CONSTRAINING_CLASS = (
    r"\bconstrainedby\s+[\w.]+\s*\(",
    "the modifiers of a constraining class are lost; put them on the component",
)
_KEYWORD = (
    r"(?:algorithm|and|annotation|assert|connect|else|elseif|elsewhen|equation|for|if|in|initial|input|loop|not|or|"
    r"output|return|then|when|while)\b"
)
_COMPONENT = rf"(?<![\w.])(?!{_KEYWORD})[\w.]+\s+(?!{_KEYWORD})\w+\s*(?:\[[^\]]*\]\s*)?\("
_EXTENSION = r"\bextends\s+[\w.]+\s*\("
_SHORT_CLASS = rf"\b{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\("
_BASE = re.compile(r"(?:\bextends\s+|=\s*)([\w.]+)\s*(\()?")
_REDECLARED_COMPONENT = re.compile(rf"\bredeclare\s+(?:replaceable\s+)?(?!{_KINDS}\b)[\w.]+\s+(\w+)")


def reject_lost_modifiers(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first modifier in the model's classes that would be lost."""
    texts = {Path(path): content for _, path, content in model.source_files}
    text = ModelText(model.name, texts, around=False)
    for pattern, why in (_REDECLARED_CLASS, _CONSTRAINING_CLASS):
        for construct in text.find([pattern]):
            raise _rejection(model, why, construct)
    for why, construct in chain(changed_modifiers(text), changed_constants(text)):
        raise _rejection(model, why, construct)
    for modified in text.find([_COMPONENT, _EXTENSION, _SHORT_CLASS]):
        inside = modified.plain[modified.plain.index("(") + 1 : -1]
        for name in dotted(inside):
            nested = name.replace(".", "(") + " ..." + ")" * name.count(".")
            raise _rejection(model, f"the modifier of {name} is lost; write {nested}", modified)
    for extension in (*text.find([_EXTENSION]), *text.find([_SHORT_CLASS])):
        for why in _faults(text, extension.plain):
            raise _rejection(model, why, extension)


def _faults(text: ModelText, extension: str) -> Iterator[str]:
    found = _BASE.search(extension)
    assert found is not None  # by the patterns above
    base = found[1].rpartition(".")[2]
    for component in _REDECLARED_COMPONENT.findall(extension):
        if text.mentions(base, rf"\breplaceable\b[^;]*\b{component}\b") is False:
            yield (
                f"the redeclaration of {component} is lost, because {base} inherits it; "
                "extend the class that declares it"
            )
    deep = {path for path in assigned(extension[found.end() : -1]) if len(path) > 2}
    for component, member in sorted({path[:2] for path in deep}):
        lost = sorted(
            ".".join(path)
            for path in _given(text, base, component, set()) - deep
            if path[:2] == (component, member)
        )
        if lost:
            yield (
                f"what {base} or a base class of it gives to {', '.join(lost)} is lost, because this "
                f"modifies other names of {component}.{member}; repeat it here"
            )


def _given(text: ModelText, base: str, component: str, seen: set[str]) -> set[NamePath]:
    """What the class and those that it extends set inside a component."""
    if base in seen:
        return set()
    seen.add(base)
    given: set[NamePath] = set()
    for plain in text.of(base):
        for declared in re.finditer(rf"\b{component}\s*(?:\[[^\]]*\]\s*)?\(", plain):
            if not inside_parentheses(plain, declared.start()):
                inner = plain[declared.end() : closing(plain, declared.end() - 1) - 1]
                given |= {(component, *path) for path in assigned(inner)}
        for extended in _BASE.finditer(plain):
            if extended[2]:
                inner = plain[extended.end() : closing(plain, extended.end() - 1) - 1]
                given |= {path for path in assigned(inner) if path[0] == component}
            given |= _given(text, extended[1].rpartition(".")[2], component, seen)
    return given


def _rejection(model: LoweredModel, why: str, construct: Construct) -> UnsupportedModelError:
    return UnsupportedModelError(located(why, [construct.place], model.name, construct.place.file))
