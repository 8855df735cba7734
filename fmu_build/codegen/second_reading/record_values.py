"""What the value of a whole record gives to its members, as ``R(a = 5)`` or ``other`` (Modelica 3.6, 12.6).

It holds instead of what declarations give to the members.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from typing import Final

from fmu_build.codegen.second_reading.arithmetic import tree_of
from fmu_build.codegen.second_reading.expressions import Array, Call, Reference
from fmu_build.codegen.second_reading.givens import ATTRIBUTES, Given, Scope, inner_of, merged
from fmu_build.codegen.second_reading.lookup import Lookup
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.redeclarations import Member, Redeclarations
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.sections import arguments
from fmu_build.codegen.second_reading.syntax import Class, Tokens

#: Prefixes of members that are no arguments of a constructor.
_KEPT: Final = frozenset(("final", "constant"))


class RecordValues:
    """Finds what whole records give to their members.

    Args:
        library: the classes
        lookup: what names of classes mean
        redeclarations: the scopes of short classes
        components: the components of a class with what it is given, for the path of a component
        dimensions: the number of dimensions of the array that a name means in a scope
    """

    def __init__(
        self,
        library: Library,
        lookup: Lookup,
        redeclarations: Redeclarations,
        components: Callable[[str, Class, Mapping[str, Given]], Iterable[Member]],
        dimensions: Callable[[Tokens, Scope], int],
    ) -> None:
        self._library = library
        self._lookup = lookup
        self._redeclarations = redeclarations
        self._components = components
        self._dimensions = dimensions

    def members(self, path: str, given: Given, record: Class) -> dict[str, Given]:
        """Return what the members of a record with a path are given, whose whole value `given` has.

        Raises `UnknownError` if that is not known.
        """
        if given.scope is None:
            raise UnknownError
        value, scope = self._element(given, given.scope), given.scope
        found = self._of_constructor(path, value, scope, record, given.inner)
        if found is None:
            is_operand = isinstance(tree_of(value), Call | Reference)
            whole = value if is_operand else ("(", *value, ")")
            names = self._arguments(path, record, given.inner)
            found = {name: Given((*whole, ".", name), scope) for name in names}
        return merged(path, given.inner, found, [])

    def _element(self, given: Given, scope: Scope) -> Tokens:
        """Return the value for one element of an array of records."""
        value, places = _bare(given.value), given.place
        while places and isinstance(tree_of(value), Array):
            elements = arguments(value[1:-1])
            if places[0] >= len(elements):
                raise UnknownError
            value, places = _bare(elements[places[0]]), places[1:]
        if not places or isinstance(tree_of(value), Call):  # A record is the same for all elements.
            return value
        if value[-1] == "]" or not isinstance(tree_of(value), Reference):
            raise UnknownError
        chosen = places[: self._dimensions(value, scope)]
        subscripts = [token for one in chosen for token in (",", str(one + 1))]
        return (*value, "[", *subscripts[1:], "]") if subscripts else value

    def _of_constructor(
        self, path: str, value: Tokens, scope: Scope, record: Class, inner: Mapping[str, Given]
    ) -> dict[str, Given] | None:
        """Return what the arguments of a constructor are; None for other expressions."""
        if not isinstance(tree_of(value), Call):
            return None
        place = value.index("(")
        called, given = self._called("".join(value[:place]), scope)
        if called.kind != "record":
            return None
        names = self._arguments(path, called, given)
        if called is not record and {*names} != {*self._arguments(path, record, inner)}:
            raise UnknownError
        found = {}
        given_arguments = (one for one in arguments(value[place + 1 : -1]) if one)
        for name, argument in zip(names, given_arguments, strict=False):
            is_named = argument[1:2] == ("=",)
            found[argument[0] if is_named else name] = Given(argument[2:] if is_named else argument, scope)
        if len(found) < len(names):
            if called is not record:
                raise UnknownError
            defaults = {one.component.name: one.given for one in self._components(path, called, given)}
            found = {**{name: defaults[name] for name in names}, **found}
        return found

    def _arguments(self, path: str, record: Class, given: Mapping[str, Given]) -> list[str]:
        members = self._components(path, record, given)
        final = {one.component.name for one in members if one.given.final}
        return [name for name in argument_names(self._library, record) if name not in final]

    def _called(self, name: str, scope: Scope) -> tuple[Class, Mapping[str, Given]]:
        """Return the class of a constructor, and what a short class gives to it."""
        found = self._lookup.class_in(name.split("."), scope)
        given: Mapping[str, Given] = {}
        while found.is_short:
            base, modifier = found.bases[0]
            where = self._redeclarations.around(scope.path, scope.around, found)
            given = merged("", given, inner_of(modifier, where), [])
            found = self._library.base(found, base)
        return found, given


def argument_names(library: Library, record: Class) -> list[str]:
    """Return the members that are arguments of a constructor; final and constant ones are none.

    Raises `UnknownError` if they are not known.
    """
    return [name for name, (_, one) in library.components(record).items() if not one.prefixes & _KEPT]


def has_values(library: Library, record: Class) -> bool:
    """Return whether modifiers in a record give values to members of others, or to inherited ones.

    Raises `UnknownError` if that is not known.
    """
    for base in library.lineage(record):
        if any(modifier.inner for _, modifier in base.bases):
            return True
        if any(one.modifier.inner.keys() - ATTRIBUTES for one in base.components):
            return True
    return False


def _bare(value: Tokens) -> Tokens:
    """Return an expression without parentheses around it."""
    while value[0] == "(":
        with suppress(UnknownError):
            tree_of(value[1:-1])
            value = value[1:-1]
            continue
        break
    return value
