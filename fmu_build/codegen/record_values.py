"""Records assigned as a whole to a component whose declaration, or base class, gives values to members.

In ``C c(r = d)``, where C declares ``R r(a = 3)``, Modelica uses ``d.a`` but rumoca uses 3.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from fmu_build.codegen.modelica_source.clauses import COMPONENT_CLAUSE, EXTENSION_CLAUSE, component_clauses
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance
from fmu_build.codegen.modelica_source.modifiers import Path, assigned

_ATTRIBUTES = frozenset(
    {"displayUnit", "fixed", "max", "min", "nominal", "quantity", "start", "stateSelect", "unit"}
)


def values_over_members(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield what is wrong with values of whole records, and the clauses that give them."""
    if not text.records:
        return
    classes = Inheritance(text)
    for clause in text.find([COMPONENT_CLAUSE]):
        for component in component_clauses(clause.plain):
            for name, given in _overridden(text, classes, component.type, component.modifiers):
                yield _explanation(name, given), clause
            own = _members(component.modifiers)
            if component.value and own and component.type in text.records:
                yield _explanation(component.name, own), clause
    for clause in text.find([rf"{EXTENSION_CLAUSE}\("]):
        found = re.match(EXTENSION_CLAUSE, clause.plain)
        assert found is not None  # by the pattern
        for name, given in _overridden(text, classes, found["base"], clause.plain[found.end() + 1 : -1]):
            yield _explanation(name, given), clause


def _explanation(name: str, given: set[str]) -> str:
    return (
        f"the declaration of {name} gives a value to {', '.join(sorted(given))}, which would "
        "hold instead of the one in this record; leave it out there, or modify the members here"
    )


def _overridden(
    text: ModelText, classes: Inheritance, name: str, modifiers: str
) -> Iterator[tuple[str, set[str]]]:
    """Yield the components to which modifiers of a class give whole records, and the members lost."""
    for path in assigned(modifiers):
        for owner in classes.owners(name, path[:-1]):
            is_record = any(one.type in text.records for one in classes.components(owner, path[-1]))
            given = set(_given(classes, owner, path[-1])) if is_record else set()
            if given:
                yield path[-1], given


def _given(classes: Inheritance, name: str, component: str) -> Iterator[str]:
    """Yield the members to which declarations of a component, and clauses that inherit them, give values."""
    for one in classes.ancestry(name):
        for own in classes.own_components(one, component):
            yield from _members(own.modifiers)
        for _, modifiers in classes.bases[one]:
            found = {path[1:] for path in assigned(modifiers) if path[0] == component and len(path) > 1}
            yield from _values(found)


def _members(modifiers: str) -> set[str]:
    return _values(assigned(modifiers))


def _values(paths: Iterable[Path]) -> set[str]:
    """Return the members that get values from these paths, not only attributes."""
    return {path[0] for path in paths if len(path) == 1 or path[-1] not in _ATTRIBUTES}
