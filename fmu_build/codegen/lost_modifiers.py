"""Modifiers that rumoca silently drops.

When a class is extended, only the outermost modifiers are merged: ``extends B(a(s(k = 9)))`` replaces the
whole modifier ``s(...)`` that B gives to a, although Modelica merges the two (Modelica 3.6, section 7.2.3).
Modifiers of redeclared, constraining and inner classes can be lost, too, and so can those with dotted names;
see also `redeclared_modifiers`, `record_values`, `changed_constants` and `contradicted_constants`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain

from fmu_build.codegen.changed_constants import changed_constants
from fmu_build.codegen.comprehensions import miscounted_comprehensions
from fmu_build.codegen.contradicted_constants import contradicted_constants
from fmu_build.codegen.leaking_modifiers import arrays_over_names, leaking_modifiers
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, modified_classes
from fmu_build.codegen.modelica_source.modifiers import Path as NamePath, assigned, closing, dotted, repeated
from fmu_build.codegen.modelica_source.text import REDECLARE, inside_parentheses
from fmu_build.codegen.record_values import values_over_members
from fmu_build.codegen.redeclared_modifiers import PREFIXES, changed_modifiers

_KINDS = r"(?:model|block|record|type|package|class)"
_ALL_KINDS = rf"(?:{_KINDS}|connector|function)"
_REDECLARED_CLASS = (
    rf"(?<=[(,])\s*{REDECLARE}{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\(",
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
_REDECLARED = re.compile(rf"{REDECLARE}(?:{_ALL_KINDS}\s+(\w+)|{PREFIXES}[\w.]+\s+(\w+))")
_REDECLARED_COMPONENT = re.compile(rf"{REDECLARE}{PREFIXES}(?!{_ALL_KINDS}\b)[\w.]+\s+(\w+)")


def reject_lost_modifiers(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first modifier in the model's classes that would be lost."""
    text = model.classes
    for pattern, why in (_REDECLARED_CLASS, _CONSTRAINING_CLASS):
        for construct in text.find([pattern]):
            raise model.unsupported_at(why, construct)
    found = (
        _repeated_modifiers,
        _contradicted_bases,
        arrays_over_names,
        leaking_modifiers,
        _nested_redeclarations,
        _modifiers_of_classes,
        values_over_members,
        _modifiers_of_base_functions,
        changed_modifiers,
        changed_constants,
        contradicted_constants,
        miscounted_comprehensions,
    )
    for why, construct in chain.from_iterable(find(text) for find in found):
        raise model.unsupported_at(why, construct)
    for modified in text.find([f"{_COMPONENT}|{_EXTENSION}|{_SHORT_CLASS}"]):
        inside = modified.plain[modified.plain.index("(") + 1 : -1]
        for name in dotted(inside):
            nested = name.replace(".", "(") + " ..." + ")" * name.count(".")
            raise model.unsupported_at(f"the modifier of {name} is lost; write {nested}", modified)
    for extension in (*text.find([_EXTENSION]), *text.find([_SHORT_CLASS])):
        for why in _faults(text, extension.plain):
            raise model.unsupported_at(why, extension)


def _repeated_modifiers(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield clauses that give one thing two values, which is invalid (Modelica 3.6, section 7.2)."""
    for _, modifiers, clause in modified_classes(text):
        for path in sorted(repeated(modifiers)):
            yield f"{'.'.join(path)} is given two values", clause


def _contradicted_bases(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield classes that inherit one base twice, with different values (Modelica 3.6, section 7.1)."""
    inheritance = Inheritance(text)
    for name, _, _ in text.named():
        simple = name.rpartition(".")[2]
        if len(text.of(simple)) > 1:
            continue
        for base, path in inheritance.contradictions(simple):
            if len(text.of(base)) == 1:
                what = f"{simple} inherits {base} twice, with different values of {'.'.join(path)}"
                yield from ((what, found) for found in text.headers(simple))


def _nested_redeclarations(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield redeclarations in nested modifiers, which rumoca ignores."""
    for modified in text.find([rf"{_COMPONENT}|{_EXTENSION}|{_SHORT_CLASS}"]):
        opening = modified.plain.index("(")
        for found in _REDECLARED.finditer(modified.plain):
            before = modified.plain[opening : found.start()]
            if before.count("(") - before.count(")") > 1:
                yield (
                    f"the redeclaration of {found[1] or found[2]} in the modifier of another component is "
                    "lost; make it in a class that extends that of the component",
                    modified,
                )


def _modifiers_of_classes(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield clauses that modify inner classes, as in ``extends B(T(start = 1))`` with a type T of B."""
    inheritance = Inheritance(text)
    for name, modifiers, clause in modified_classes(text):
        for path in assigned(modifiers):
            for depth, part in enumerate(path[:-1]):
                if any(
                    inheritance.has_class(owner, part) and not any(inheritance.components(owner, part))
                    for owner in inheritance.owners(name, path[:depth])
                ):
                    yield f"what is given to the class {part} is lost; modify its components", clause


def _modifiers_of_base_functions(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield clauses by which functions with algorithms of their own modify inherited variables."""
    clauses = {
        "".join(own[found.start() : closing(own, found.end() - 1)].split())
        for _, kind, own in text.named()
        if kind.endswith("function") and re.search(r"\balgorithm\b", own)
        for found in re.finditer(_EXTENSION, own)
    }
    for clause in text.find([_EXTENSION]):
        given = assigned(clause.plain[clause.plain.index("(") + 1 : -1])
        if given and "".join(clause.plain.split()) in clauses:
            names = ", ".join(sorted(".".join(path) for path in given))
            yield (
                f"what the function gives to {names} of its base class is lost; write the function without "
                "the base class",
                clause,
            )


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
    """Return the names inside a component that the class and its base classes set."""
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
