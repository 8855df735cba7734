"""Records assigned as a whole to a component whose declaration, or base class, gives values to members.

In ``C c(r = d)``, where C declares ``R r(a = 3)``, Modelica uses ``d.a`` but rumoca uses 3.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator

from fmu_build.modelica_source.clauses import COMPONENT_CLAUSE, EXTENSION_CLAUSE, Component, component_clauses
from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.modelica_source.modifiers import Path, assigned, closing

_ATTRIBUTES = frozenset(
    {"displayUnit", "fixed", "max", "min", "nominal", "quantity", "start", "stateSelect", "unit"}
)


def values_over_members(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the clause of each whole-record value that rumoca would ignore in part."""
    classes = _Classes(text)
    if not text.records:
        return
    for clause in text.find([COMPONENT_CLAUSE]):
        for component in component_clauses(clause.plain):
            for name, given in classes.overridden(component.type, component.modifiers):
                yield _explanation(name, given), clause
            own = _members(component.modifiers)
            if component.value and own and component.type in text.records:
                yield _explanation(component.name, own), clause
    for clause in text.find([rf"{EXTENSION_CLAUSE}\("]):
        found = re.match(EXTENSION_CLAUSE, clause.plain)
        assert found is not None  # by the pattern
        for name, given in classes.overridden(found["base"], clause.plain[found.end() + 1 : -1]):
            yield _explanation(name, given), clause


def _explanation(name: str, given: set[str]) -> str:
    return (
        f"the declaration of {name} gives a value to {', '.join(sorted(given))}, which would "
        "hold instead of the one in this record; leave it out there, or modify the members here"
    )


class _Classes:
    """What the classes of a model declare and inherit, by their simple names."""

    def __init__(self, text: ModelText) -> None:
        self._records = text.records
        self._own: defaultdict[str, list[Component]] = defaultdict(list)
        self._bases: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
        for name, _, plain in text.named() if text.records else ():
            simple = name.rpartition(".")[2]
            self._own[simple] += component_clauses(plain)
            for found in re.finditer(EXTENSION_CLAUSE, plain):
                end = closing(plain, found.end()) - 1 if found["open"] is not None else found.end()
                self._bases[simple].append((found["base"], plain[found.end() + 1 : end]))

    def overridden(self, name: str, modifiers: str) -> Iterator[tuple[str, set[str]]]:
        """Yield the components to which modifiers of this class assign whole records, and members lost."""
        for path in assigned(modifiers):
            owners = {name}
            for part in path[:-1]:
                owners = {one.type for owner in owners for one in self._declared(owner, part)}
            for owner in owners:
                is_record = any(one.type in self._records for one in self._declared(owner, path[-1]))
                given = set(self._given(owner, path[-1])) if is_record else set()
                if given:
                    yield path[-1], given

    def _declared(self, name: str, component: str) -> Iterator[Component]:
        """Yield the declarations of a component in the classes of this name and their bases."""
        for one in self._inherited(name):
            yield from (own for own in self._own[one] if own.name == component)

    def _given(self, name: str, component: str) -> Iterator[str]:
        """Yield the members to which these declarations, and extends-clauses of the classes, give values."""
        for one in self._inherited(name):
            for own in self._own[one]:
                if own.name == component:
                    yield from _members(own.modifiers)
            for _, modifiers in self._bases[one]:
                found = {path[1:] for path in assigned(modifiers) if path[0] == component and len(path) > 1}
                yield from _values(found)

    def _inherited(self, name: str) -> set[str]:
        """Return the simple names of the classes of this name and of their bases."""
        found: set[str] = set()
        waiting = {name}
        while waiting:
            found |= waiting
            waiting = {base for one in waiting for base, _ in self._bases[one]} - found
        return found


def _members(modifiers: str) -> set[str]:
    return _values(assigned(modifiers))


def _values(paths: Iterable[Path]) -> set[str]:
    """Return the members that get values from these paths, not only attributes."""
    return {path[0] for path in paths if len(path) == 1 or path[-1] not in _ATTRIBUTES}
