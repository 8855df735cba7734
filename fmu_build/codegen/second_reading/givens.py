"""What the modifiers of a source give to names, and how they are merged (Modelica 3.6, section 7.2)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value
from fmu_build.codegen.second_reading.syntax import Class, Modifier, Tokens

_WITHOUT_SPACES: Final = re.compile(r" ?([.()\[\]{},;:^]) ?")
_SUBSCRIPTS: Final = re.compile(r"\[[^\[\]]*\]|\s")

Mistake = tuple[str, str]
"""What is invalid, and the name that it is about."""


ATTRIBUTES: Final = frozenset(
    ("quantity", "unit", "displayUnit", "min", "max", "start", "fixed", "nominal", "stateSelect", "unbounded")
)
"""The attributes of the predefined types."""


@dataclass(frozen=True, slots=True)
class Scope:
    """Where an expression stands: the path of a component, and the class of it, or a base of that."""

    path: str
    around: Class


@dataclass(frozen=True, slots=True)
class Text:
    """Tokens in a scope, perhaps with a name that redeclarations or heirs may give another meaning."""

    scope: Scope
    tokens: Tokens
    is_changed: bool = False


@dataclass(frozen=True, slots=True)
class Given:
    """What a name is given, and the scope of its value.

    `type` is that of a redeclaration, which stands in the scope `type_scope`, else empty.
    Of an array for the elements of an array of components, `place` selects those of this component.
    `is_over_others` is for the value of a whole record that holds instead of values of its members.
    """

    value: Tokens = ()
    scope: Scope | None = None
    inner: Mapping[str, Given] = field(default_factory=dict)
    each: bool = False
    final: bool = False
    type: str = ""
    type_scope: Scope | None = None
    redeclares: bool = False
    place: tuple[int, ...] = ()
    is_used_up: bool = False
    is_over_others: bool = False

    def chosen(self, value: Value) -> Value:
        """Return the element of a value for this component; raises `UnknownError` if there is none."""
        for place in self.place:
            if value.ndim and place >= len(value):
                raise UnknownError
            value = as_value(value[place]) if value.ndim else value
        return value

    def spread(self, value: Value, sizes: tuple[int, ...]) -> Value:
        """Return the value of a variable of these sizes, which a scalar fills.

        Raises `UnknownError` if the value has other sizes.
        """
        found = self.chosen(value)
        if not found.ndim:
            return np.full(sizes, found)
        if found.shape != sizes:
            raise UnknownError
        return found


NOTHING: Final = Given()
NOWHERE: Final = ".."
"""The path of what has no component around it, such as the modifiers of a short class."""


def nowhere(around: Class) -> Scope:
    """Return the scope of what stands in a class, in whichever component."""
    return Scope(NOWHERE, around)


def joined(path: str, name: str) -> str:
    """Return the path of a component in another one."""
    return f"{path}.{name}" if path else name


def given_by(modifier: Modifier, scope: Scope) -> Given:
    """Return what a modifier gives that stands in a scope."""
    return Given(
        value=modifier.value,
        scope=scope,
        inner=inner_of(modifier, scope),
        each=modifier.each,
        final=modifier.final,
        type=modifier.type,
        type_scope=scope,
        redeclares=modifier.redeclares,
    )


def inner_of(modifier: Modifier, scope: Scope) -> dict[str, Given]:
    """Return what a modifier in a scope gives to the members of what it modifies."""
    return {name: given_by(one, scope) for name, one in modifier.inner.items()}


def element(given: Given, places: tuple[int, ...], *, is_inner: bool = False) -> Given:
    """Return what an element of an array is given by a modifier of the array.

    An ``each`` in the modifier of a modifier may belong to this array or to one inside: it is used up here,
    and nothing is known of the latter.
    """
    if not places:
        return given
    if given.is_used_up:
        return replace(given, redeclares=True)
    if given.each:
        return replace(given, each=False, is_used_up=is_inner)
    inner = {name: element(one, places, is_inner=True) for name, one in given.inner.items()}
    return replace(given, inner=inner, place=given.place + places)


def merged(
    path: str, outer: Mapping[str, Given], inner: Mapping[str, Given], mistakes: list[Mistake]
) -> dict[str, Given]:
    """Return what holds for the members of a component where modifiers further out meet those further in."""
    names = dict.fromkeys((*inner, *outer))
    return {name: both(joined(path, name), outer.get(name), inner.get(name), mistakes) for name in names}


def both(path: str, outer: Given | None, inner: Given | None, mistakes: list[Mistake]) -> Given:
    """Return what holds where a modifier further out meets one further in, and add what is invalid."""
    if outer is None or inner is None:
        return outer or inner or NOTHING
    if inner.final and outer.value:
        what = f"{path} is final and cannot be given another value"
        mistakes.append((what, path.rpartition(".")[2]))
    first = outer if outer.value else inner
    own_inner = without_values(inner).inner if outer.value else inner.inner
    is_unclear = bool(outer.inner and inner.inner) and outer.each != inner.each
    return replace(
        first,
        inner=merged(path, outer.inner, own_inner, mistakes),
        final=outer.final or inner.final,
        type=outer.type or inner.type,
        type_scope=outer.type_scope if outer.type else inner.type_scope,
        redeclares=outer.redeclares or inner.redeclares or is_unclear,
        is_over_others=outer.is_over_others or inner.is_over_others or own_inner != inner.inner,
    )


def without_values(given: Given) -> Given:
    """Return what is given but for values of members; attributes, as ``start``, and final values stay."""
    inner = {
        name: one if name in ATTRIBUTES or one.final else without_values(one)
        for name, one in given.inner.items()
    }
    return replace(given, value=(), inner=inner)


def as_written(tokens: Tokens) -> str:
    """Return tokens as a text, with spaces around words and operators only."""
    return _WITHOUT_SPACES.sub(r"\1", " ".join(tokens)).replace(",", ", ").strip()


def plain(path: str) -> str:
    """Return a path without its subscripts."""
    while (shorter := _SUBSCRIPTS.sub("", path)) != path:
        path = shorter
    return path


def around(name: str) -> Iterator[str]:
    """Yield the paths of the components around a variable, the outermost first."""
    depth = 0
    for place, letter in enumerate(name):
        depth += (letter == "[") - (letter == "]")
        if letter == "." and not depth:
            yield name[:place]
