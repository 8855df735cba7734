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

from fmu_build.codegen.second_reading.arithmetic import Chosen, value_of
from fmu_build.codegen.second_reading.functions import function_of
from fmu_build.codegen.second_reading.gathered import gathered, sizes_of
from fmu_build.codegen.second_reading.givens import (
    ATTRIBUTES,
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
from fmu_build.codegen.second_reading.lookup import Lookup
from fmu_build.codegen.second_reading.operations import (
    ChangedError,
    UnknownError,
    Value,
    as_value,
    called,
    scalar,
)
from fmu_build.codegen.second_reading.record_values import RecordValues, has_values
from fmu_build.codegen.second_reading.redeclarations import Member, Redeclarations, redeclared_classes
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Tokens

#: Prefixes of a component that apply to the variables in it.
_INHERITED: Final = frozenset(("flow", "stream", "parameter", "constant"))
_MOST_ELEMENTS: Final = 1000
_MOST_LEAVES: Final = 20_000
_DEEPEST: Final = 50
#: The size of arrays of functions that depends on arguments.
_FREE_SIZE: Final = 3


@dataclass(frozen=True, slots=True)
class Leaf:
    """A variable of a predefined type."""

    given: Given
    prefixes: frozenset[str]
    kind: Class
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
class _Names:
    """What names mean in a scope."""

    instances: Instances
    scope: Scope

    is_smooth: bool = False

    def is_random(self, reference: Chosen) -> bool:
        return False

    def value(self, reference: Chosen) -> Value:
        return self.instances.named(reference, self.scope)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.instances.sizes_of(reference, self.scope)

    def applied(self, operator: str, reference: Chosen) -> Value:
        raise UnknownError

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        raise UnknownError

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        library = self.instances.library
        if not library.is_class(name, self.scope.around):
            return None
        function = function_of(library, self.instances.lookup, name, self.scope)
        if not function.is_built_in or named or place:
            raise UnknownError
        return called(function.declared.name, arguments)


class Instances:
    """The variables of a model.

    Attributes:
        leaves: by path, as ``a.b[2].c``; an array of a predefined type is one
        parts: the other components by path, with the subscripts of arrays; the path of the model is empty
        sizes: of all components, by path; the last name has no subscripts
        dimensions: the expressions of all sizes, also of those that are not known, with their scopes
        order: the names of the members of components in the order of their declaration, if it is known
        absent: the paths of components whose conditions are false
        mistakes: what is invalid in the modifiers, each with the name that it is about
        unknown: what rumoca may have lost without a trace, with the class in which it stands
        nowhere: the scope of what the model itself is given
        lookup: what names of classes and constants mean
    """

    def __init__(
        self,
        library: Library,
        owner: Class,
        packages: dict[int, Instances] | None = None,
        heir: Class | None = None,
    ) -> None:
        """Find the variables of a model or function, or the constants of a package.

        Args:
            library: the classes
            owner: the model, function or package
            packages: those already read, by the identities of their classes
            heir: the package through which a function is called
        """
        self.leaves: dict[str, Leaf] = {}
        self.parts: dict[str, Part] = {}
        self.sizes: dict[str, tuple[int, ...]] = {}
        self.dimensions: dict[str, list[tuple[Tokens, Scope]]] = {}
        self.order: dict[str, list[str]] = {}
        self.absent: set[str] = set()
        self.mistakes: list[Mistake] = []
        self.unknown: list[tuple[str, Class]] = []
        self.library = library
        self._members: dict[str, set[str]] = {}
        self._packages = {} if packages is None else packages
        self._others: dict[tuple[int, int], Instances] = {}
        self.lookup = Lookup(library)
        if heir is not None:
            self.lookup.heirs[""] = heir
        self._redeclarations = Redeclarations(library, self.lookup, self.mistakes)
        self._records = RecordValues(
            library, self.lookup, self._redeclarations, self._components, self._dimensions
        )
        self._evaluating: set[str] = set()
        self._has_free_sizes = False
        self._outer: set[str] = set()
        self._inner: set[str] = set()
        self.nowhere = nowhere(owner)
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

    def value(self, given: Given) -> Value:
        """Return the value that is given; raises `UnknownError` if it is not known."""
        if not given.value:
            raise UnknownError
        return given.chosen(self.value_of(given.value, given.scope or self.nowhere))

    def value_of(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> Value:
        """Return the value of an expression; raises `UnknownError` if it is not known."""
        return value_of(tokens, _Names(self, scope), iterators)

    def number(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> float:
        """Return the value of a scalar; raises `UnknownError` if it is not known."""
        return scalar(self.value_of(tokens, scope, iterators))

    def named(self, reference: Chosen, scope: Scope) -> Value:
        """Return the value of a parameter or constant; raises `UnknownError` if it is not known."""
        path = self.path_of(reference, scope)
        if path is not None:
            return gathered(self, path, reference, self.known)
        return self.of_constant(reference, scope)

    def known(self, path: str) -> Value:
        """Return the value of a parameter or constant with a path; raises `UnknownError` if not known."""
        leaf = self.leaves[path]
        if not leaf.is_constant or not leaf.given.value or path in self._evaluating:
            raise UnknownError
        self._evaluating.add(path)
        try:
            found = self.value_of(leaf.given.value, leaf.given.scope or self.nowhere)
        finally:
            self._evaluating.discard(path)
        return leaf.given.spread(found, leaf.sizes)

    def path_of(self, reference: Chosen, scope: Scope) -> str | None:
        """Return the path of the component in which a reference begins; None if it means no variable.

        It is that of the scope, or a component around with an inner component. Raises `UnknownError` if it is
        not known.
        """
        name = reference[0][0]
        if scope.path == NOWHERE:
            return None
        if self.means_member(name, scope):
            return scope.path
        if plain(joined(scope.path, name)) not in self._outer:
            return None
        for path in reversed(["", *around(scope.path)]):
            if joined(path, name) in self._inner:
                return path
        raise UnknownError

    def of_constant(self, reference: Chosen, scope: Scope) -> Value:
        """Return the value of a constant of a package, or of a member or elements of it.

        Raises `UnknownError` if it means something else, or the value is not known.
        """
        names = [name for name, _ in reference]
        for count in range(len(names), 0, -1):
            if any(one for _, one in reference[: count - 1]):
                continue
            try:
                owner, last = self.lookup.constant(".".join(names[:count]), scope)
                return self._of_package(owner, [(last, reference[count - 1][1]), *reference[count:]])
            except ChangedError:
                raise
            except UnknownError:
                continue  # Another name may be that of a record.
        raise UnknownError

    def _of_package(self, owner: Class, reference: Chosen) -> Value:
        """Return the value of a constant in a package, or of a literal of an enumeration."""
        last = reference[0][0]
        if last in owner.literals and len(reference) == 1:
            return as_value(owner.literals.index(last) + 1)
        if owner.kind != "package":
            raise UnknownError
        if id(owner) not in self._packages:
            self._packages[id(owner)] = self  # until it is read, nothing is known of it
            self._packages[id(owner)] = Instances(self.library, owner, self._packages)
        package = self._packages[id(owner)]
        if package is self:
            raise UnknownError
        return gathered(package, "", reference, package.known)

    def sizes_of(self, reference: Chosen, scope: Scope) -> Sequence[int]:
        """Return the sizes of an array; raises `UnknownError` if they are not known."""
        path = self.path_of(reference, scope)
        if path is not None:
            return sizes_of(self, path, reference)
        return self.of_constant(reference, scope).shape

    def of_class(self, other: Class, heir: Class | None) -> Instances:
        """Return the variables of a function or record, with the package through which it is called."""
        key = (id(other), id(heir))
        if key not in self._others:
            self._others[key] = Instances(self.library, other, self._packages, heir)
        return self._others[key]

    def _dimensions(self, name: Tokens, scope: Scope) -> int:
        return self.value_of(("size", "(", *name, ")"), scope).size

    def _expand(
        self, path: str, owner: Class, given: Mapping[str, Given], prefixes: frozenset[str], depth: int
    ) -> None:
        """Find the variables in a component of a class, to which the prefixes of the component apply."""
        members: list[Member] = []
        is_known = depth < _DEEPEST
        try:
            members += self._components(path, owner, given)
        except UnknownError:
            is_known = False
        names = {one.component.name for one in members}
        outer = {one.component.name for one in members if "outer" in one.component.prefixes}
        self._members[path] = names - outer if is_known else set()
        self._outer |= {plain(joined(path, name)) for name in outer}
        self._inner |= {
            joined(path, one.component.name) for one in members if "inner" in one.component.prefixes
        }
        if not is_known:
            return
        with suppress(UnknownError):
            self.order[path] = [*self.library.components(owner)]
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
                except ChangedError:
                    name = joined(path, member.component.name)
                    self.unknown.append(
                        (f"the class of {name}, which heirs of a package change,", member.around)
                    )
                except UnknownError:
                    unknown.append(member)
            if len(unknown) == len(before) and owner.kind == "function" and not self._has_free_sizes:
                self._has_free_sizes = True
            elif len(unknown) == len(before):
                for member in unknown:
                    self._unknown(path, member)
                break

    def _components(self, path: str, owner: Class, given: Mapping[str, Given]) -> Iterator[Member]:
        """Yield the components of a class, inherited ones first."""
        if not owner.is_certain:
            raise UnknownError
        redeclared = {one.name for one in owner.components if "redeclare" in one.prefixes}
        all_given = given
        for name, modifier in owner.bases:
            base = self.library.base(owner, name)
            if base in PREDEFINED.values():
                raise UnknownError
            inner = {
                **redeclared_classes(path, owner),
                **inner_of(modifier, Scope(NOWHERE if owner.is_short else path, owner)),
            }
            all_given = merged(path, all_given, inner, self.mistakes)
            inherited = list(self._components(path, base, merged(path, given, inner, self.mistakes)))
            names = {one.component.name for one in inherited}
            self.mistakes += unknown_names(self.library, path, base, inner, names)
            yield from (one for one in inherited if one.component.name not in redeclared)
        self.lookup.given[path, id(owner)] = all_given
        for component in owner.components:
            outer = given.get(component.name)
            own = self._redeclarations.declared(path, owner, component, outer)
            whole = both(joined(path, component.name), outer, own, self.mistakes)
            yield Member(component, owner, whole, all_given)

    def _component(self, path: str, member: Member, around: frozenset[str], depth: int) -> None:
        """Add the variables in a component, or the variable that it is."""
        component, given = member.component, member.given
        name = joined(path, component.name)
        scope = Scope(path, member.around)
        if component.condition and not self.number(component.condition, scope):
            self.absent.add(name)
        if given.redeclares or name in self.absent or "outer" in component.prefixes:
            return
        kind, attributes = self._redeclarations.kind(path, member)
        dimensions = [(tokens, scope) for tokens in component.dimensions]
        while kind.is_short and not kind.is_enumeration:
            base, modifier = kind.bases[0]
            where = self._redeclarations.around(path, member.around, kind)
            attributes = both(name, attributes, given_by(modifier, where), self.mistakes)
            dimensions += [(tokens, where) for tokens in kind.dimensions]
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
            leaf = Leaf(whole, prefixes, kind, not kind.is_enumeration, sizes)
            self._add_leaf(name, component, kind, leaf)
        elif given.value and given.type:
            self.unknown.append((f"the value of {name}, which a modifier redeclares,", member.around))
        elif given.value and kind.kind == "record":
            for subscripts, places in self._elements(sizes):
                inner = self._records.members(name + subscripts, element(whole, places), kind)
                self._expand(name + subscripts, kind, inner, prefixes, depth + 1)
        elif not given.value and "expandable" not in kind.prefixes:
            for subscripts, places in self._elements(sizes):
                inner = {key: element(one, places) for key, one in whole.inner.items()}
                self._expand(name + subscripts, kind, inner, prefixes, depth + 1)

    def _elements(self, sizes: Sequence[int]) -> Iterator[tuple[str, tuple[int, ...]]]:
        """Yield the subscripts and places of the elements of an array."""
        if math.prod(sizes) > _MOST_ELEMENTS or len(self.leaves) > _MOST_LEAVES:
            raise UnknownError
        for places in itertools.product(*map(range, sizes)):
            yield f"[{','.join(str(one + 1) for one in places)}]" if places else "", places

    def _unknown(self, path: str, member: Member) -> None:
        """Take note of a record with a whole value that is not known, if it has other values, too."""
        with suppress(UnknownError):
            kind, attributes = self._redeclarations.kind(path, member)
            given = both("", member.given, attributes, [])
            while kind.is_short:
                base, modifier = kind.bases[0]
                given = both("", given, given_by(modifier, self.nowhere), [])
                kind = self.library.base(kind, base)
            is_whole = bool(given.value) and kind.kind == "record"
            if is_whole and (given.is_over_others or has_values(self.library, kind)):
                name = joined(path, member.component.name)
                self.unknown.append((f"the value of {name}, whose members have others,", member.around))

    def _add_leaf(self, name: str, component: Component, kind: Class, leaf: Leaf) -> None:
        has_text = kind is PREDEFINED["String"]  # of which nothing is left in the tokens
        if "constant" in component.prefixes and not (leaf.given.value or has_text):
            self.mistakes.append((f"the constant {name} has no value", component.name))
        for attribute in sorted(leaf.given.inner.keys() - ATTRIBUTES):
            self.mistakes.append((f"{name} has no attribute {attribute}", attribute))
        self.leaves[name] = leaf

    def _size(self, tokens: Tokens, scope: Scope) -> int:
        try:
            size = self.number(tokens, scope)
        except UnknownError:
            if not self._has_free_sizes:
                raise
            return _FREE_SIZE
        if size != int(size) or not 0 <= size <= _MOST_ELEMENTS:
            raise UnknownError
        return int(size)

    def _size_of_value(self, given: Given, place: int) -> int:
        """Return a size that follows from the value."""
        if self._has_free_sizes and not given.value:
            return _FREE_SIZE
        shape = self.value(given).shape
        if place >= len(shape):
            raise UnknownError
        return int(shape[place])


def around(name: str) -> Iterator[str]:
    """Yield the paths of the components around a variable, the outermost first."""
    depth = 0
    for place, letter in enumerate(name):
        depth += (letter == "[") - (letter == "]")
        if letter == "." and not depth:
            yield name[:place]
