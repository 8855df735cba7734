"""The variables of a model with what its source gives to each: merged as in Modelica 3.6 (chapter 7).

What a redeclaration, a condition, an outer component or an unknown size may change is left out.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Final

from fmu_build.codegen.second_reading.givens import (
    ATTRIBUTES,
    NOWHERE,
    Given,
    Scope,
    both,
    element,
    given_by,
    inner_of,
    joined,
    merged,
    plain,
)
from fmu_build.codegen.second_reading.invalid import repeated_classes, repeated_components, unknown_names
from fmu_build.codegen.second_reading.known_variables import Leaf, Part, Variables
from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError
from fmu_build.codegen.second_reading.record_values import RecordValues, has_values
from fmu_build.codegen.second_reading.redeclarations import Member, Redeclarations, redeclared_classes
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Tokens

#: Prefixes of a component that apply to the variables in it.
_INHERITED: Final = frozenset(("flow", "stream", "parameter", "constant"))
_MOST_ELEMENTS: Final = 1000
_MOST_LEAVES: Final = 20_000
_DEEPEST: Final = 50
#: The size of arrays of functions that depends on arguments; random Integers are smaller.
_FREE_SIZE: Final = 5


class Instances(Variables):
    """The variables of a model, function or record, or the constants of a package, from its class."""

    def __init__(
        self,
        library: Library,
        owner: Class,
        packages: dict[int, Variables] | None = None,
        heir: Class | None = None,
    ) -> None:
        """Find the variables; arguments as for `Variables`."""
        super().__init__(library, owner, packages, heir)
        self._redeclarations = Redeclarations(library, self.lookup, self.mistakes)
        self._records = RecordValues(
            library, self.lookup, self._redeclarations, self._components, self._dimensions
        )
        self._has_free_sizes = False
        self._expand("", owner, {}, frozenset(), 0)

    def _read(self, other: Class, heir: Class | None) -> Instances:
        return Instances(self.library, other, self._packages, heir)

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
            self._name_package(path, owner, name, base)
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

    def _name_package(self, path: str, owner: Class, name: str, base: Class) -> None:
        """Take note of the package in which the names of a base class are looked up (section 5.6.1)."""
        *package, _ = name.split(".")
        key, own = (plain(path), id(base)), (plain(path), id(owner))
        if package and package != [""]:
            with suppress(UnknownError):
                self.lookup.of_bases[key] = self.lookup.class_in(package, Scope(path, owner))
        elif own in self.lookup.of_bases:
            self.lookup.of_bases[key] = self.lookup.of_bases[own]

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
            return self._size_of_type(tokens, scope)
        if size != int(size) or not 0 <= size <= _MOST_ELEMENTS:
            raise UnknownError
        return int(size)

    def _size_of_type(self, tokens: Tokens, scope: Scope) -> int:
        """Return the size for Booleans or the literals of an enumeration as subscripts, or a free one."""
        with suppress(UnknownError):
            kind = PREDEFINED["Boolean"]
            if tokens != (kind.name,):
                kind = self.lookup.class_in("".join(tokens).split("."), scope)
            if kind.literals or kind is PREDEFINED["Boolean"]:
                return len(kind.literals) or 2
        if not self._has_free_sizes:
            raise UnknownError
        return _FREE_SIZE

    def _size_of_value(self, given: Given, place: int) -> int:
        """Return a size that follows from the value."""
        if self._has_free_sizes and not given.value:
            return _FREE_SIZE
        shape = self.value(given).shape
        if place >= len(shape):
            raise UnknownError
        return int(shape[place])
