"""The classes of components, and what declarations give to them, with redeclarations (Modelica 3.6, 7.3).

A redeclaration keeps what the constraining clause of the declaration gives; without one, what the declaration
itself gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from fmu_build.codegen.second_reading.givens import (
    NOWHERE,
    Given,
    Mistake,
    Scope,
    both,
    given_by,
    inner_of,
    joined,
    merged,
    plain,
)
from fmu_build.codegen.second_reading.lookup import Lookup
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Component


@dataclass(frozen=True, slots=True)
class Member:
    """A component of a class, with what it is given.

    Attributes:
        component: its declaration
        around: the class in which this stands
        given: what it is given
        around_given: what this class and its bases are given
    """

    component: Component
    around: Class
    given: Given
    around_given: Mapping[str, Given]


class Redeclarations:
    """Finds the classes of components."""

    def __init__(self, library: Library, lookup: Lookup, mistakes: list[Mistake]) -> None:
        self._library = library
        self._lookup = lookup
        self._mistakes = mistakes

    def kind(self, path: str, member: Member) -> tuple[Class, Given]:
        """Return the class of a component, perhaps a redeclared one, and the modifiers of the latter."""
        component, given = member.component, member.given
        name, scope = component.type, Scope(path, member.around)
        inner: Mapping[str, Given] = {}
        other = member.around_given.get(component.type)
        if given.type:
            if given.type_scope is None:
                raise UnknownError
            name, scope = given.type, given.type_scope
        elif other is not None:
            if other.redeclares:
                raise UnknownError
            inner = other.inner
            if other.type and other.type_scope is not None:
                name, scope = other.type, other.type_scope
                inner = merged("", inner, self._constraint(path, member), self._mistakes)
        else:
            inner = self._of_default(path, member)
        *package, last = name.split(".")
        if package and package != [""]:
            heir = self._lookup.class_in(package, scope)
            self._lookup.heirs[plain(joined(path, component.name))] = heir
        is_modified = other is not None and not given.type and not other.type
        declared = self._library.declaration(member.around, component.type) if is_modified else None
        return declared or self._lookup.class_in([*package, last], scope), Given(inner=inner)

    def around(self, path: str, own: Class, short: Class) -> Scope:
        """Return the scope of what a short class gives: the class around it, perhaps that of a component."""
        around = short.around
        if around is None:
            raise UnknownError
        is_own = any(one is around for one in self._library.lineage(own))
        return Scope(path if is_own else NOWHERE, around)

    def _of_default(self, path: str, member: Member) -> Mapping[str, Given]:
        """Return what the constraining clause of a class that is not redeclared gives, but for its own."""
        declared = self._library.declaration(member.around, member.component.type)
        if declared is None or declared.constraint is None:
            return {}
        own = declared.bases[0][1].inner if declared.is_short else {}
        return {name: one for name, one in self._constraint(path, member).items() if name not in own}

    def _constraint(self, path: str, member: Member) -> Mapping[str, Given]:
        """Return what a class gives to a component whose type it is, if that is redeclared."""
        declared = self._library.declaration(member.around, member.component.type)
        if declared is None:
            raise UnknownError
        if declared.constraint is not None:
            return inner_of(declared.constraint, self.around(path, member.around, declared))
        if not declared.is_short:
            return {}
        return inner_of(declared.bases[0][1], self.around(path, member.around, declared))

    def declared(self, path: str, owner: Class, component: Component, outer: Given | None) -> Given:
        """Return what a declaration gives to its component, which `outer` may redeclare."""
        own = self._declared(path, owner, component, is_redeclared=outer is not None and bool(outer.type))
        if "redeclare" not in component.prefixes:
            return own
        replaced = replace(self._replaced(path, owner, component.name), value=own.value)
        return both(joined(path, component.name), own, replaced, self._mistakes)

    def _declared(self, path: str, owner: Class, component: Component, *, is_redeclared: bool) -> Given:
        """Return what a declaration gives; redeclarations keep its constraining clause."""
        own = given_by(component.modifier, Scope(path, owner))
        if component.constraint is None:
            return own
        constraint = given_by(component.constraint, Scope(path, owner))
        if is_redeclared:
            return constraint
        return both(joined(path, component.name), own, constraint, self._mistakes)

    def _replaced(self, path: str, owner: Class, name: str) -> Given:
        """Return what the declaration of a base gives that a class redeclares as an element."""
        for base in self._library.bases(owner):
            around, component = self._library.components(base).get(name, (None, None))
            if around is not None and component is not None:
                return self._declared(path, around, component, is_redeclared=True)
        raise UnknownError


def redeclared_classes(path: str, owner: Class) -> dict[str, Given]:
    """Return what a class gives to classes of its bases by redeclaring them, as ``redeclare model A = B``."""
    found = {}
    for name, one in owner.classes.items():
        if "redeclare" in one.prefixes and one.is_short:
            base, modifier = one.bases[0]
            scope = Scope(path, owner)
            found[name] = Given(type=base, type_scope=scope, inner=inner_of(modifier, scope))
    return found
