"""Declarations and inheritance of classes by simple name; classes of the same name count as one."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping

from fmu_build.codegen.modelica_source.clauses import (
    COMPONENT_CLAUSE,
    EXTENSION_CLAUSE,
    Component,
    component_clauses,
)
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.modifiers import Path, closing, values

_REDECLARED = r"\bredeclare\s+(?:replaceable\s+)?(?:\w+\s*\.\s*)*(?P<type>\w+)\s+\w+\s*\("


def extensions(plain: str, *, short_classes: bool = True) -> Iterator[tuple[str, str]]:
    """Yield the simple name and the modifiers of each base class in the text of a class.

    With `short_classes`, also those of the short classes in it, as in ``package P = Q(c = 2)``.
    """
    for found in re.finditer(EXTENSION_CLAUSE, plain):
        if not short_classes and not found[0].startswith("extends"):
            continue
        end = closing(plain, found.end()) - 1 if found["open"] is not None else found.end()
        yield found["base"], plain[found.end() + 1 : end]


def modified_classes(text: ModelText) -> Iterator[tuple[str, str, Construct]]:
    """Yield the simple name of each class that a clause modifies, with the modifiers and the clause."""
    for clause in text.find([f"{COMPONENT_CLAUSE}|{EXTENSION_CLAUSE}\\("]):
        for one in component_clauses(clause.plain):
            yield one.type, one.modifiers, clause
        for base, modifiers in extensions(clause.plain):
            yield base, modifiers, clause
        for found in re.finditer(_REDECLARED, clause.plain):
            end = closing(clause.plain, found.end() - 1) - 1
            yield found["type"], clause.plain[found.end() : end], clause


class Inheritance:
    """Components, inner classes and base classes of the classes of a model.

    Attributes:
        bases: base classes of each class, with the text of their modifiers
    """

    def __init__(self, text: ModelText) -> None:
        self.bases: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
        self._extended: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
        self._components: defaultdict[str, list[Component]] = defaultdict(list)
        self._classes: defaultdict[str, set[str]] = defaultdict(set)
        for name, _, plain in text.named():
            *around, simple = name.split(".")
            if around:
                self._classes[around[-1]].add(simple)
            self._components[simple] += component_clauses(plain)
            self.bases[simple] += extensions(plain)
            self._extended[simple] += extensions(plain, short_classes=False)

    def own_components(self, name: str, component: str) -> Iterator[Component]:
        """Yield the declarations of a component in the classes of this name themselves."""
        return (own for own in self._components[name] if own.name == component)

    def all_components(self, name: str) -> list[Component]:
        """Return the components that the classes of this name declare themselves."""
        return self._components[name]

    def components(self, name: str, component: str) -> Iterator[Component]:
        """Yield the declarations of a component in the classes of this name and their bases."""
        for one in self.ancestry(name):
            yield from self.own_components(one, component)

    def owners(self, name: str, components: tuple[str, ...]) -> set[str]:
        """Return the classes to which a path of components leads from the classes of this name."""
        found = {name}
        for component in components:
            found = {one.type for owner in found for one in self.components(owner, component)}
        return found

    def contradictions(self, name: str) -> Iterator[tuple[str, Path]]:
        """Yield bases that the classes of this name inherit twice, with what gets different values."""
        routes: defaultdict[str, list[Mapping[Path, str]]] = defaultdict(list)
        for base, given in self._routes(name, {}, frozenset()):
            routes[base].append(given)
        for base, ways in routes.items():
            for path in sorted({path for given in ways for path in given}):
                if len({"".join(given.get(path, "").split()) for given in ways}) > 1:
                    yield base, path

    def _routes(
        self, name: str, outer: Mapping[Path, str], passed: frozenset[str]
    ) -> Iterator[tuple[str, Mapping[Path, str]]]:
        """Yield every way from a class to a base, with the values that this base is given on it."""
        for base, modifiers in self._extended[name]:
            if base not in passed:
                given = {**values(modifiers), **outer}
                yield base, given
                yield from self._routes(base, given, passed | {base})

    def ancestry(self, name: str) -> set[str]:
        """Return the simple names of the classes of this name and of their bases."""
        found: set[str] = set()
        waiting = {name}
        while waiting:
            found |= waiting
            waiting = {base for one in waiting for base, _ in self.bases[one]} - found
        return found
