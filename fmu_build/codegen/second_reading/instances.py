"""The variables of a model with what its source gives to each: merged as in Modelica 3.6 (chapter 7).

What a redeclaration, a condition, an outer component or an unknown size may change is left out.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass
from typing import Final

from fmu_build.codegen.second_reading.arithmetic import UnknownError, Value, value_of
from fmu_build.codegen.second_reading.givens import (
    NOTHING,
    NOWHERE,
    Given,
    Mistake,
    Scope,
    both,
    element,
    given_by,
    inner_of,
    joined,
    merged,
    nowhere,
    plain,
)
from fmu_build.codegen.second_reading.invalid import repeated_classes, repeated_components, unknown_names
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Tokens

#: Prefixes of a component that apply to the variables in it.
_INHERITED: Final = frozenset(("flow", "stream", "parameter", "constant"))
_MOST_ELEMENTS: Final = 1000
_MOST_LEAVES: Final = 20_000
_DEEPEST: Final = 50


@dataclass(frozen=True, slots=True)
class Leaf:
    """A variable of a predefined type."""

    given: Given
    prefixes: frozenset[str]
    has_zero_start: bool
    """Whether its start value is zero unless it is given another one."""
    sizes: tuple[int, ...]

    @property
    def is_constant(self) -> bool:
        """Whether it is a parameter or a constant."""
        return bool(self.prefixes & {"parameter", "constant"})


@dataclass(frozen=True, slots=True)
class Part:
    """The model, or a component of it that is no variable: the classes with its equations, and its kind."""

    classes: tuple[Class, ...]
    kind: str


@dataclass(frozen=True, slots=True)
class _Member:
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


@dataclass(frozen=True, slots=True)
class _Names:
    """What names mean in a scope with iterators."""

    instances: Instances
    scope: Scope
    iterators: Mapping[str, float]

    def value(self, name: str) -> Value:
        return self.iterators[name] if name in self.iterators else self.instances.named(name, self.scope)

    def sizes(self, name: str) -> Sequence[int]:
        if self.scope.path == NOWHERE or not self.instances.means_member(name, self.scope):
            return _shape(self.instances.constant(name, self.scope))
        path = joined(self.scope.path, name)
        if path not in self.instances.sizes:
            raise UnknownError
        return self.instances.sizes[path]

    def is_function(self, name: str) -> bool:
        return self.instances.library.is_class(name, self.scope.around)


class Instances:
    """The variables of a model.

    Attributes:
        leaves: by path, as ``a.b[2].c``; an array of a predefined type is one
        parts: the other components by path, with the subscripts of arrays; the path of the model is empty
        sizes: of all components, by path; the last name has no subscripts
        dimensions: the expressions of all sizes, also of those that are not known, with their scopes
        absent: the paths of components whose conditions are false
        mistakes: what is invalid in the modifiers, each with the name that it is about
    """

    def __init__(self, library: Library, owner: Class, packages: dict[int, Instances] | None = None) -> None:
        """Find the variables of a model, or the constants of a package; `packages` are those already read."""
        self.leaves: dict[str, Leaf] = {}
        self.parts: dict[str, Part] = {}
        self.sizes: dict[str, tuple[int, ...]] = {}
        self.dimensions: dict[str, list[tuple[Tokens, Scope]]] = {}
        self.absent: set[str] = set()
        self.mistakes: list[Mistake] = []
        self.library = library
        self._members: dict[str, set[str]] = {}
        self._classes_given: dict[tuple[str, int], Mapping[str, Given]] = {}
        self._packages = {} if packages is None else packages
        self._evaluating: set[str] = set()
        self._outer: set[str] = set()
        self._nowhere = nowhere(owner)
        self._expand("", owner, {}, frozenset(), 0)

    def members(self, path: str) -> Set[str]:
        """Return the names of the variables and components in a component; none if they are not known."""
        return self._members.get(path, frozenset())

    def is_through_outer(self, path: str) -> bool:
        """Return whether a path without subscripts goes through an outer component."""
        return any(f"{path}.".startswith(f"{outer}.") for outer in self._outer)

    def may_be_outer(self, path: str) -> bool:
        """Return whether an outer component has the name of this one, which may be the inner one."""
        name = plain(path).rpartition(".")[2]
        return any(outer.rpartition(".")[2] == name for outer in self._outer)

    def means_member(self, name: str, scope: Scope) -> bool:
        """Return whether a name means a variable or component of the component in which it stands.

        Raises `UnknownError` if the bases of the class are not known.
        """
        first = name.partition(".")[0].partition("[")[0]
        return first in self.library.components(scope.around) and first in self.members(scope.path)

    def means_literal(self, name: str, scope: Scope) -> bool:
        """Return whether a name means a literal of an enumeration.

        Raises `UnknownError` if its meaning is not known.
        """
        owner, last = self.place_of_constant(name, scope)
        return last in owner.literals

    def value(self, given: Given) -> Value:
        """Return the value that is given; raises `UnknownError` if it is not known."""
        if not given.value:
            raise UnknownError
        found = self.value_of(given.value, given.scope or self._nowhere)
        for place in given.place:
            if isinstance(found, list):
                if place >= len(found):
                    raise UnknownError
                found = found[place]
        return found

    def value_of(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> Value:
        """Return the value of an expression; raises `UnknownError` if it is not known."""
        return value_of(tokens, _Names(self, scope, iterators or {}))

    def number(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> float:
        """Return the value of a scalar; raises `UnknownError` if it is not known."""
        found = self.value_of(tokens, scope, iterators)
        if isinstance(found, list):
            raise UnknownError
        return found

    def named(self, name: str, scope: Scope) -> Value:
        """Return the value of a parameter or constant; raises `UnknownError` if it is not known."""
        if scope.path == NOWHERE or not self.means_member(name, scope):
            return self.constant(name, scope)
        path = joined(scope.path, name)
        leaf = self.leaves.get(path)
        if leaf is None or not leaf.is_constant or path in self._evaluating:
            raise UnknownError
        self._evaluating.add(path)
        try:
            return self.value(leaf.given)
        finally:
            self._evaluating.discard(path)

    def constant(self, name: str, scope: Scope) -> Value:
        """Return the value of a constant of a package that a name means in a scope.

        Raises `UnknownError` if it means something else, or the value is not known.
        """
        owner, last = self.place_of_constant(name, scope)
        if last in owner.literals:
            return float(owner.literals.index(last) + 1)
        if owner.kind != "package":
            raise UnknownError
        if id(owner) not in self._packages:
            self._packages[id(owner)] = self  # until it is read, nothing is known of it
            self._packages[id(owner)] = Instances(self.library, owner, self._packages)
        package = self._packages[id(owner)]
        if package is self:
            raise UnknownError
        return package.named(last, Scope("", owner))

    def place_of_constant(self, name: str, scope: Scope) -> tuple[Class, str]:
        """Return the class in which a constant is, and its name there."""
        *path, last = name.removeprefix(".").split(".")
        if name.startswith("."):
            return self.library.class_of(".".join(path)), last
        if path:
            return self._class_of(path, scope), last
        around: Class | None = scope.around
        while around is not None:
            if last in self.library.components(around):
                self._require_unchanged(around)
                return around, last
            for known, qualified in around.imports:
                if known == last:
                    return self.place_of_constant(f".{qualified}", scope)
                if known == "*" and last in self.library.components(self.library.class_of(qualified)):
                    return self.library.class_of(qualified), last
            if "encapsulated" in around.prefixes:
                break
            around = around.around
        raise UnknownError

    def _class_of(self, names: list[str], scope: Scope) -> Class:
        """Return the class that a qualified name means in a scope, with redeclarations of the component."""
        first, *rest = names
        given = self._classes_given.get((scope.path, id(scope.around)))
        own = self.library.element(scope.around, first) if given is not None else None
        if given is not None and first in given:
            other = given[first]
            if not other.type or other.type_scope is None or other.inner:
                raise UnknownError
            found = self._class_of(other.type.split("."), other.type_scope)
        elif own is not None:
            found = own
        else:
            found = self.library.meaning(first, scope.around)
            if found.around is not None:
                self._require_unchanged(found.around)
        return self.library.within(found, rest)

    def _require_unchanged(self, around: Class) -> None:
        """Raise `UnknownError` for a package whose heirs may have other constants and classes."""
        if id(around) in self.library.changed:
            raise UnknownError

    def _expand(
        self, path: str, owner: Class, given: Mapping[str, Given], prefixes: frozenset[str], depth: int
    ) -> None:
        """Find the variables in a component of a class, to which the prefixes of the component apply."""
        members: list[_Member] = []
        is_known = depth < _DEEPEST
        try:
            members += self._components(path, owner, given)
        except UnknownError:
            is_known = False
        names = {one.component.name for one in members}
        outer = {one.component.name for one in members if "outer" in one.component.prefixes}
        self._members[path] = names - outer if is_known else set()
        self._outer |= {plain(joined(path, name)) for name in outer}
        if not is_known:
            return
        with suppress(UnknownError):
            self.parts[path] = Part(tuple(self.library.lineage(owner)), owner.kind)
        self.mistakes += unknown_names(self.library, path, owner, given, names)
        self.mistakes += repeated_components(path, ((one.component, one.around) for one in members))
        self.mistakes += repeated_classes(self.library, owner)
        # Sizes and conditions depend on other variables, which may be declared later.
        unknown = members
        while unknown:
            before, unknown = unknown, []
            for member in before:
                try:
                    self._component(path, member, prefixes, depth)
                except UnknownError:
                    unknown.append(member)
            if len(unknown) == len(before):
                break

    def _components(self, path: str, owner: Class, given: Mapping[str, Given]) -> Iterator[_Member]:
        """Yield the components of a class, inherited ones first."""
        if not owner.is_certain:
            raise UnknownError
        redeclared = {one.name for one in owner.components if "redeclare" in one.prefixes}
        all_given = given
        for name, modifier in owner.bases:
            base = self.library.base(owner, name)
            if base in PREDEFINED.values():
                raise UnknownError
            inner = inner_of(modifier, Scope(NOWHERE if owner.is_short else path, owner))
            all_given = merged(path, all_given, inner, self.mistakes)
            inherited = list(self._components(path, base, merged(path, given, inner, self.mistakes)))
            names = {one.component.name for one in inherited}
            self.mistakes += unknown_names(self.library, path, base, inner, names)
            yield from (one for one in inherited if one.component.name not in redeclared)
        self._classes_given[path, id(owner)] = all_given
        for component in owner.components:
            own = given_by(component.modifier, Scope(path, owner))
            whole = both(joined(path, component.name), given.get(component.name), own, self.mistakes)
            yield _Member(component, owner, whole, all_given)

    def _component(self, path: str, member: _Member, around: frozenset[str], depth: int) -> None:
        """Add the variables in a component, or the variable that it is."""
        component, given = member.component, member.given
        name = joined(path, component.name)
        scope = Scope(path, member.around)
        if component.condition and not self.number(component.condition, scope):
            self.absent.add(name)
        if given.redeclares or name in self.absent or component.prefixes & {"outer", "redeclare"}:
            return
        kind, attributes = self._kind(member)
        dimensions = [(tokens, scope) for tokens in component.dimensions]
        while kind.is_short and not kind.is_enumeration:
            base, modifier = kind.bases[0]
            attributes = both(name, attributes, given_by(modifier, Scope(NOWHERE, kind)), self.mistakes)
            dimensions += [(tokens, Scope(NOWHERE, kind)) for tokens in kind.dimensions]
            kind = self.library.base(kind, base)
        self.dimensions[name] = dimensions
        whole = both(name, given, attributes, self.mistakes)
        sizes = tuple(
            self._size(tokens, where) if tokens != (":",) else self._size_of_value(whole, place)
            for place, (tokens, where) in enumerate(dimensions)
        )
        self.sizes[name] = sizes
        prefixes = component.prefixes | (around & _INHERITED)
        if kind in PREDEFINED.values() or kind.is_enumeration:
            leaf = Leaf(whole, prefixes, not kind.is_enumeration, sizes)
            self._add_leaf(name, component, kind, leaf)
        elif not given.value and "expandable" not in kind.prefixes:
            if math.prod(sizes) > _MOST_ELEMENTS or len(self.leaves) > _MOST_LEAVES:
                raise UnknownError
            for places in itertools.product(*map(range, sizes)):
                subscripts = f"[{','.join(str(one + 1) for one in places)}]" if places else ""
                inner = {key: element(one, places) for key, one in whole.inner.items()}
                self._expand(name + subscripts, kind, inner, prefixes, depth + 1)

    def _kind(self, member: _Member) -> tuple[Class, Given]:
        """Return the class of a component, perhaps a redeclared one, and the modifiers of the latter."""
        component, given = member.component, member.given
        if given.type:
            if given.type_scope is None or component.is_constrained:
                raise UnknownError
            return self.library.meaning(given.type, given.type_scope.around), NOTHING
        other = member.around_given.get(component.type)
        if other is not None:
            if not other.type or other.type_scope is None:
                raise UnknownError
            return self.library.meaning(other.type, other.type_scope.around), Given(inner=other.inner)
        own = self.library.element(member.around, component.type)
        return own or self.library.meaning(component.type, member.around), NOTHING

    def _add_leaf(self, name: str, component: Component, kind: Class, leaf: Leaf) -> None:
        has_text = kind is PREDEFINED["String"]  # of which nothing is left in the tokens
        if "constant" in component.prefixes and not (leaf.given.value or has_text):
            self.mistakes.append((f"the constant {name} has no value", component.name))
        for attribute in sorted(leaf.given.inner.keys() - _ATTRIBUTES):
            self.mistakes.append((f"{name} has no attribute {attribute}", attribute))
        self.leaves[name] = leaf

    def _size(self, tokens: Tokens, scope: Scope) -> int:
        size = self.number(tokens, scope)
        if size != int(size) or not 0 <= size <= _MOST_ELEMENTS:
            raise UnknownError
        return int(size)

    def _size_of_value(self, given: Given, place: int) -> int:
        """Return a size that follows from the value."""
        value = self.value(given)
        for _ in range(place):
            if not isinstance(value, list) or not value:
                raise UnknownError
            value = value[0]
        if not isinstance(value, list):
            raise UnknownError
        return len(value)


_ATTRIBUTES: Final = frozenset(
    ("quantity", "unit", "displayUnit", "min", "max", "start", "fixed", "nominal", "stateSelect", "unbounded")
)


def _shape(value: Value) -> list[int]:
    """Return the sizes of an array."""
    found = []
    while isinstance(value, list):
        found.append(len(value))
        value = value[0] if value else 0.0
    return found


def around(name: str) -> Iterator[str]:
    """Yield the paths of the components around a variable, the outermost first."""
    depth = 0
    for place, letter in enumerate(name):
        depth += (letter == "[") - (letter == "]")
        if letter == "." and not depth:
            yield name[:place]
