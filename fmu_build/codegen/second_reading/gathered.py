"""The values and sizes of what a reference means, from those of the variables that it goes through."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import numpy as np

from fmu_build.codegen.second_reading.arithmetic import Chosen
from fmu_build.codegen.second_reading.givens import joined
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value, whole


class Sizes(Protocol):
    """The variables of a model, the sizes of all components, and the members of those of classes, by path."""

    @property
    def leaves(self) -> Container[str]:
        """The paths of the variables."""

    @property
    def sizes(self) -> Mapping[str, Sequence[int]]:
        """The sizes."""

    @property
    def order(self) -> Mapping[str, Sequence[str]]:
        """The members in the order of their declaration, inherited ones first."""


def gathered(instances: Sizes, path: str, reference: Chosen, of_leaf: Callable[[str], Value]) -> Value:
    """Return the value of a reference to a member of a component, with the values of its variables.

    That of a record is a vector of the values of its members. Raises `UnknownError` if the reference means
    no variable, or an element that is not there.
    """
    if not reference:
        return flattened([of_leaf(leaf) for leaf in leaves_in(instances, path)])
    (name, subscripts), *further = reference
    path = joined(path, name)
    if path in instances.leaves:
        if further:
            raise UnknownError
        return indexed(of_leaf(path), subscripts)
    places, shape = _places(instances, path, subscripts)
    values = [gathered(instances, one, further, of_leaf) for one in places]
    if not values or any(one.shape != values[0].shape for one in values):
        raise UnknownError
    return as_value(values).reshape((*shape, *values[0].shape))


def leaves_in(instances: Sizes, path: str) -> Iterator[str]:
    """Yield the paths of the variables in a component in the order of their declaration.

    Raises `UnknownError` if they are not known.
    """
    if path not in instances.order:
        raise UnknownError
    for name in instances.order[path]:
        member = joined(path, name)
        if member in instances.leaves:
            yield member
        else:
            for one in _places(instances, member, ())[0]:
                yield from leaves_in(instances, one)


def flattened(values: Iterable[Value]) -> Value:
    """Return the numbers of all values as a vector."""
    return np.concatenate([np.empty(0), *(one.reshape(-1) for one in values)])


def sizes_of(instances: Sizes, path: str, reference: Chosen) -> Sequence[int]:
    """Return the sizes of an array, of which the last name of the reference has no subscripts."""
    (name, subscripts), *further = reference
    path = joined(path, name)
    if not further:
        if path not in instances.sizes or subscripts:
            raise UnknownError
        return instances.sizes[path]
    places, shape = _places(instances, path, subscripts)
    if not places:
        raise UnknownError
    return *shape, *sizes_of(instances, places[0], further)


def indexed(value: Value, subscripts: Sequence[Value | None]) -> Value:
    """Return the elements of an array that its subscripts choose."""
    if len(subscripts) > value.ndim:
        raise UnknownError
    # From the last dimension, so that the places of those before do not change.
    for dimension in reversed(range(len(subscripts))):
        subscript = subscripts[dimension]
        if subscript is not None:
            chosen = _indices(subscript, value.shape[dimension])
            places = chosen if subscript.ndim else chosen[0]
            value = value.take(places, axis=dimension)
    return as_value(value)


def _places(instances: Sizes, path: str, subscripts: Sequence[Value | None]) -> tuple[list[str], list[int]]:
    """Return the paths of the chosen elements of an array of components, and the shape that they form."""
    sizes = instances.sizes.get(path)
    if sizes is None or len(subscripts) > len(sizes):
        raise UnknownError
    chosen, shape = [], []
    given = [*subscripts, *[None] * (len(sizes) - len(subscripts))]
    for subscript, size in zip(given, sizes, strict=True):
        chosen.append([*range(size)] if subscript is None else _indices(subscript, size))
        if subscript is None or subscript.ndim:
            shape.append(len(chosen[-1]))
    places = itertools.product(*chosen)
    return [
        f"{path}[{','.join(str(one + 1) for one in place)}]" if sizes else path for place in places
    ], shape


def _indices(subscript: Value, size: int) -> list[int]:
    """Return the places, from zero, that a subscript of one dimension chooses."""
    if subscript.ndim > 1:
        raise UnknownError
    places = [whole(as_value(one)) - 1 for one in subscript.reshape(-1)]
    if any(not 0 <= one < size for one in places):
        raise UnknownError
    return places
