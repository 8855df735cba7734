"""Modifiers that rumoca applies to a sibling of the component for which they are meant, too or instead.

With ``Gain gain; Inner inside(gain(k = 3));`` in a class C, ``C c(gain(k = 7))`` also gives 7 to
``c.inside.gain.k``: rumoca merges what is given to ``gain`` into every modifier of that name in C. An array
for a name, as in ``S k[2](p = {5, 7})``, takes what the class around it is given for its own ``p``.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from typing import Final, NamedTuple

from fmu_build.codegen.modelica_source.clauses import component_clauses
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, extensions, modified_classes
from fmu_build.codegen.modelica_source.modifiers import Path, closing, values

_ATTRIBUTES: Final = frozenset(
    {"start", "fixed", "min", "max", "nominal", "unit", "displayUnit", "stateSelect"}
)
_REDECLARED = re.compile(r"\bredeclare\s+(?:replaceable\s+)?[\w.]+\s+(?P<name>\w+)\s*\(")


def leaking_modifiers(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the clause for each modifier that would leak."""
    inheritance = Inheritance(text)
    siblings = _Siblings(text, inheritance)
    for name, modifiers, clause in modified_classes(text):
        # In an extends clause or a short class, only what is given to parts of components leaks.
        is_base = re.match(r"extends\b|\w+\s+\w+\s*=", clause.plain) is not None
        given = {**values(modifiers), **dict(_redeclared(modifiers))}
        for path, value in sorted(given.items()):
            for depth in range(1 if is_base else 0, len(path) - 1):
                for owner in sorted(inheritance.owners(name, path[:depth])):
                    for sibling in siblings.of(owner, path[depth:], value):
                        if (*path[:depth], sibling, *path[depth:]) not in given:
                            yield _explanation(path, depth, owner, sibling), clause


def _explanation(path: Path, depth: int, owner: str, sibling: str) -> str:
    inner, rest = path[depth], ".".join(path[depth:])
    return (
        f"what is given to {'.'.join(path)} would also be given to {sibling}.{rest}, because {owner} has a "
        f"modifier of {sibling}.{inner}; give it in a class of its own, model Own = {owner}({inner}(...))"
    )


def _redeclared(modifiers: str) -> Iterator[tuple[Path, str]]:
    """Yield the paths that the modifiers of redeclared components set, and the values."""
    for found in _REDECLARED.finditer(modifiers):
        inner = modifiers[found.end() : closing(modifiers, found.end() - 1) - 1]
        yield from (((found["name"], *path), value) for path, value in values(inner).items())


def arrays_over_names(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield classes in which parts are given an array for a name that the class has itself.

    In ``model B extends A; S k[2](p = {5, 7}); end B;`` with a ``p`` in A, rumoca loses what a component of a
    class that extends B is given for its ``p``; with ``extends A(k(p = {5, 7}))``, of B itself.
    """
    inheritance = Inheritance(text)
    extended = {base for bases in inheritance.bases.values() for base, _ in bases}
    for name, _, plain in text.named():
        simple = name.rpartition(".")[2]
        given = [
            (base, path[-1])
            for base, modifiers in extensions(plain, short_classes=False)
            for path, value in values(modifiers).items()
            if len(path) > 1 and not _is_one(value) and any(inheritance.components(simple, path[-1]))
        ]
        bases = inheritance.bases[simple] if simple in extended else ()
        given += [
            (component.name, path[0])
            for component in (component_clauses(plain) if bases else ())
            for path, value in values(component.modifiers).items()
            if component.is_array and len(path) == 1 and not _is_one(value)
            if any(any(inheritance.components(base, path[0])) for base, _ in bases)
        ]
        for owner, part in given:
            what = (
                f"what a component of the class {simple}, or of one that extends it, is given for {part} may "
                f"be lost, because {owner} is given an array for its own {part}; give it an array parameter"
            )
            yield from ((what, found) for found in text.headers(simple))


def _is_one(value: str) -> bool:
    return re.fullmatch(r"[-+\w.\s*/]*", value) is not None


class _Siblings:
    """By class and name of one of its elements, components whose modifiers name something inside that name.

    The element itself may be one: ``S s(s(k = 3))``. Classes of the same simple name count as one only after
    this, as many do not have such an element.
    """

    def __init__(self, text: ModelText, inheritance: Inheritance) -> None:
        self._inheritance = inheritance
        self._found: defaultdict[str, set[_Sibling]] = defaultdict(set)
        own: defaultdict[str, set[_Sibling]] = defaultdict(set)
        classes = list(text.named())
        for name, _, plain in classes:
            own[name.rpartition(".")[2]] |= set(_modified(plain))
        for name, _, plain in classes:
            bases = {one for base, _ in extensions(plain) for one in inheritance.ancestry(base)}
            elements = {component.name for component in component_clauses(plain)}
            for sibling in {*_modified(plain), *(one for base in bases for one in own[base])}:
                element = sibling.path[0]
                inherited = any(any(inheritance.own_components(base, element)) for base in bases)
                if element in elements or inherited:
                    self._found[name.rpartition(".")[2]].add(sibling)

    def of(self, name: str, path: Path, value: str) -> list[str]:
        """The components of a class that what is given to this path leaks into and changes."""
        found = [one for one in self._found[name] if one.path[0] == path[0]]
        return sorted(
            component
            for component in {one.component for one in found}
            if self._has(name, component, path)
            and {one.value for one in found if (one.component, one.path) == (component, path)} != {value}
        )

    def _has(self, name: str, component: str, path: Path) -> bool:
        inside = self._inheritance.owners(name, (component, path[0]))
        return path[1] in _ATTRIBUTES or any(
            any(self._inheritance.components(one, path[1])) for one in inside
        )


class _Sibling(NamedTuple):
    """A component, a path that its modifiers set, and the value; empty unless it means the same elsewhere."""

    component: str
    path: Path
    value: str


def _modified(plain: str) -> Iterator[_Sibling]:
    """Yield what is named with something inside it in the modifiers of components."""
    for component in component_clauses(plain):
        for path, value in values(component.modifiers).items():
            if len(path) > 1:
                yield _Sibling(component.name, path, value if _is_literal(value) else "")
    for _, modifiers in extensions(plain):
        for path, value in values(modifiers).items():
            if len(path) > 2:
                yield _Sibling(path[0], path[1:], value if _is_literal(value) else "")


def _is_literal(value: str) -> bool:
    return re.fullmatch(r"true|false|[-+]?[\d.]+([eE][-+]?\d+)?", value) is not None
