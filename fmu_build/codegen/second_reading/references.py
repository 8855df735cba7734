"""The components that a reference in ``connect()`` means, with the elements of arrays."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen.second_reading.givens import Scope, joined
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.syntax import Tokens


@dataclass(frozen=True, slots=True)
class Elements:
    """Elements of an array of components by path, the last subscript first to change, or one component."""

    paths: tuple[str, ...]
    shape: tuple[int, ...]
    first: str
    """The path of the component with which the reference begins."""


def elements(
    instances: Variables, scope: Scope, reference: Tokens, iterators: Mapping[str, float]
) -> Elements | None:
    """Return what a reference means; None if that is absent.

    Raises:
        UnknownError: it is not known
    """
    paths = [scope.path]
    shape: list[int] = []
    first = ""
    for name, subscripts in _parts(reference):
        path = joined(paths[0], name)
        if any(joined(one, name) in instances.absent for one in paths):
            return None
        if path not in instances.sizes:
            raise UnknownError
        chosen = [*_chosen(instances, scope, subscripts, instances.sizes[path], iterators)]
        shape += [len(one) for one, is_range in chosen if is_range]
        places = [_subscript(one) for one in itertools.product(*(one for one, _ in chosen))]
        paths = [joined(one, name) + place for one in paths for place in places]
        first = first or paths[0] if paths else first
        if not paths:
            break
    return Elements(tuple(paths), tuple(shape), first)


def _subscript(places: Sequence[int]) -> str:
    return f"[{','.join(map(str, places))}]" if places else ""


def _parts(reference: Tokens) -> Iterator[tuple[str, list[Tokens]]]:
    """Yield the names of a reference, each with its subscripts."""
    name, depth = "", 0
    subscripts: list[list[str]] = []
    for token in reference:
        depth += (token in "([{") - (token in ")]}")
        if depth == 0 and token == ".":
            yield name, [tuple(one) for one in subscripts]
            name, subscripts = "", []
        elif depth == 0 and token != "]":
            if name:
                raise UnknownError
            name = token
        elif depth == 1 and token in "[,":
            subscripts.append([])
        elif depth:
            subscripts[-1].append(token)
    yield name, [tuple(one) for one in subscripts]


def _chosen(
    instances: Variables,
    scope: Scope,
    subscripts: Sequence[Tokens],
    sizes: Sequence[int],
    iterators: Mapping[str, float],
) -> Iterator[tuple[list[int], bool]]:
    """Yield the indices that are chosen in each dimension, and whether they are a range."""
    if len(subscripts) > len(sizes):
        raise UnknownError
    given = [*subscripts, *[(":",)] * (len(sizes) - len(subscripts))]
    for subscript, size in zip(given, sizes, strict=True):
        known = {**iterators, "end": float(size)}
        if subscript == (":",):
            yield list(range(1, size + 1)), True
        elif ":" in subscript:
            yield indices(instances, scope, subscript, known), True
        else:
            yield [_whole(instances.number(subscript, scope, known))], False


def indices(instances: Variables, scope: Scope, tokens: Tokens, iterators: Mapping[str, float]) -> list[int]:
    """Return the numbers in a range; raises `UnknownError` if they are not known."""
    places = [place for place, token in enumerate(tokens) if token == ":"]
    ends = zip([0, *(place + 1 for place in places)], [*places, len(tokens)], strict=True)
    numbers = [_whole(instances.number(tokens[a:b], scope, iterators)) for a, b in ends]
    step = numbers[1] if len(numbers) == 3 else 1
    if not step or len(numbers) not in (2, 3):
        raise UnknownError
    return list(range(numbers[0], numbers[-1] + (1 if step > 0 else -1), step))


def _whole(number: float) -> int:
    if number != int(number):
        raise UnknownError
    return int(number)


def points(
    instances: Variables,
    scope: Scope,
    ranges: Sequence[tuple[str, Tokens]],
    iterators: Mapping[str, float],
) -> Iterator[Mapping[str, float]]:
    """Yield the values of all iterators for each pass of a loop with these ranges.

    Raises `UnknownError` if they are not known.
    """
    if not ranges:
        yield iterators
        return
    (name, numbers), *inner = ranges
    for number in indices(instances, scope, numbers, iterators):
        yield from points(instances, scope, inner, {**iterators, name: float(number)})
