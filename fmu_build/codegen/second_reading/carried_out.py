"""Carry out the algorithms of functions, as the source gives them, for values of their inputs.

What `points` compares are expressions; this computes results, of assignments, branches, loops and calls.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fmu_build.codegen.second_reading.arithmetic import (
    Chosen,
    Names,
    NotRandom,
    chosen_of,
    results_of,
    value_of,
)
from fmu_build.codegen.second_reading.called_functions import all_arguments, variables_of
from fmu_build.codegen.second_reading.functions import Function, function_of
from fmu_build.codegen.second_reading.gathered import flattened, indexed, leaves_in
from fmu_build.codegen.second_reading.givens import Scope, nowhere
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value, called, scalar, whole
from fmu_build.codegen.second_reading.points import Point
from fmu_build.codegen.second_reading.records import constructor_of, member_of
from fmu_build.codegen.second_reading.sections import Branches, Call, Equation, Loop, Statement, statements
from fmu_build.codegen.second_reading.syntax import Class, Section, Tokens

_MOST_STATEMENTS: Final = 10_000
_DEEPEST: Final = 50


class _ReturnError(Exception):
    """The function has come to a ``return``."""


def result_of_call(
    variables: Variables,
    scope: Scope,
    name: str,
    arguments: Sequence[Value],
    named: Mapping[str, Value],
    place: int,
    depth: int = 0,
) -> Value | None:
    """Return the result in a place of the function or constructor that a name means; None for a built-in one.

    Raises `UnknownError` if it is not known.
    """
    if name == "Integer" or not variables.library.is_class(name, scope.around):
        return None
    record = _constructed(variables, scope, name, arguments, named)
    if record is not None:
        return record
    function = function_of(variables.library, variables.lookup, name, scope)
    if function.declared is scope.around and function.is_built_in:
        return None
    if function.is_built_in and not named and not place:
        return called(function.declared.name, arguments)
    own = variables_of(variables, function)
    given = all_arguments(function, own, arguments, named, lambda around: _Locals(own, nowhere(around), {}))
    found = _results(function, own, given, depth + 1)
    if place >= len(found):
        raise UnknownError
    return found[place]


def member_of_result(
    variables: Variables, scope: Scope, name: str, result: Value, members: Sequence[str]
) -> Value:
    """Return a member of the record that a constructor has returned; raises `UnknownError` for a function."""
    constructor = constructor_of(variables, name, scope)
    if constructor is None:
        raise UnknownError
    return member_of(constructor.variables, "", result, members)


def _constructed(
    variables: Variables, scope: Scope, name: str, arguments: Sequence[Value], named: Mapping[str, Value]
) -> Value | None:
    """Return the record that a constructor makes; None for another function.

    Raises `UnknownError` if a member has no value, or one that a function returns.
    """
    try:
        constructor = constructor_of(variables, name, scope)
    except UnknownError:
        return None
    if constructor is None:
        return None
    given: dict[str, Value | None] = {**constructor.given(arguments, named)}
    leaves = [*leaves_in(constructor.variables, "")]
    defaults = [constructor.variables.leaves[leaf].given.value for leaf in leaves if leaf not in given]
    if any(not one or "(" in one for one in defaults):
        raise UnknownError
    point = Point(constructor.variables, 0, frozenset(), is_smooth=False, is_replaced=True, _computed=given)
    return flattened(point.of(leaf) for leaf in leaves)


@dataclass(frozen=True, slots=True)
class _Locals(NotRandom):
    """What names mean in a function: its variables with their present values, and constants."""

    variables: Variables
    scope: Scope
    values: Mapping[str, Value]
    depth: int = 0

    def value(self, reference: Chosen) -> Value:
        ((name, subscripts), *further) = reference
        if name in self.values and not further:
            return indexed(self.values[name], subscripts)
        if name in self.variables.order.get("", ()):
            raise UnknownError  # It has no value yet, or is a record.
        return self.variables.of_constant(reference, self.scope)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.value(reference).shape

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        return result_of_call(self.variables, self.scope, name, arguments, named, place, self.depth)

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        return member_of_result(self.variables, self.scope, name, result, members)


class Algorithm:
    """An algorithm that is carried out.

    Attributes:
        values: those of variables that it has assigned, by name, and of others that are only known to it
    """

    def __init__(
        self,
        values: dict[str, Value],
        assignable: Container[str],
        names_in: Callable[[Class, Mapping[str, Value]], Names],
    ) -> None:
        """Begin.

        Args:
            values: those that are known before
            assignable: the names of the variables that it may assign
            names_in: what names in a class mean with these values
        """
        self.values = values
        self._assignable = assignable
        self._names_in = names_in
        self._count = 0

    def carry_out(self, section: Section, base: Class) -> None:
        """Carry out the statements of a class; raises `UnknownError` if something is not known."""
        try:
            self._statements(statements(section), base, {})
        except SyntaxError as error:
            raise UnknownError from error
        except _ReturnError:
            pass

    def _names(self, base: Class) -> Names:
        return self._names_in(base, self.values)

    def _statements(self, inner: Sequence[Statement], base: Class, iterators: Mapping[str, float]) -> None:
        for one in inner:
            self._count += 1
            if self._count > _MOST_STATEMENTS:
                raise UnknownError
            match one:
                case Equation():
                    self._assign(one, base, iterators)
                case Branches():
                    self._statements(self._chosen(one, base, iterators), base, iterators)
                case Loop():
                    self._repeat(one.iterators, one.body, base, iterators)
                case Call(name="return"):
                    raise _ReturnError
                case Call(name="assert"):
                    pass
                case _:
                    raise UnknownError

    def _chosen(self, one: Branches, base: Class, iterators: Mapping[str, float]) -> Sequence[Statement]:
        for condition, body in one.branches:
            if not condition or scalar(value_of(condition, self._names(base), iterators)):
                return body
        return ()

    def _repeat(
        self,
        ranges: Sequence[tuple[str, Tokens]],
        body: Sequence[Statement],
        base: Class,
        iterators: Mapping[str, float],
    ) -> None:
        if not ranges:
            self._statements(body, base, iterators)
            return
        (name, numbers), *inner = ranges
        for number in value_of(numbers, self._names(base), iterators).flat:
            self._repeat(inner, body, base, {**iterators, name: float(number)})

    def _assign(self, one: Equation, base: Class, iterators: Mapping[str, float]) -> None:
        names, targets = self._names(base), one.results
        if targets:
            values = results_of(one.right, targets, names, iterators)
        else:
            values = [value_of(one.right, names, iterators)]
        for target, value in zip(targets.values() or (one.left,), values, strict=True):
            ((name, subscripts), *further) = chosen_of(target, names, iterators)
            if further or name not in self._assignable:
                raise UnknownError
            if not subscripts:
                self.values[name] = as_value(value)
            elif name in self.values:
                self.values[name] = _replaced(self.values[name], subscripts, value)
            else:
                raise UnknownError


def _results(function: Function, variables: Variables, arguments: Sequence[Value], depth: int) -> list[Value]:
    """Return the results of a function; raises `UnknownError` if they are not known."""
    lineage = function.library.lineage(function.declared)
    sections = [(base, section) for base in lineage for section in base.algorithms]
    if len(sections) != 1 or depth > _DEEPEST:
        raise UnknownError
    ((base, section),) = sections
    values = dict(zip(function.inputs, arguments, strict=True))
    own = [name for name in variables.leaves if name not in values]
    for name in variables.order.get("", ()):
        if name in own:
            _begin(name, variables, values, depth)
    algorithm = Algorithm(
        values, own, lambda around, known: _Locals(variables, nowhere(around), known, depth)
    )
    algorithm.carry_out(section, base)
    if not values.keys() >= function.outputs.keys():
        raise UnknownError
    return [values[name] for name in function.outputs]


def _begin(name: str, variables: Variables, values: dict[str, Value], depth: int) -> None:
    """Give a result or local the value of its declaration, or NaN for an array without one."""
    leaf, dimensions = variables.leaves[name], variables.dimensions[name]

    def value(tokens: Tokens, scope: Scope) -> Value:
        return value_of(tokens, _Locals(variables, nowhere(scope.around), values, depth))

    if leaf.given.value:
        values[name] = leaf.given.chosen(value(leaf.given.value, leaf.given.scope or variables.nowhere))
        if not values[name].ndim and dimensions:
            raise UnknownError
    elif dimensions and all(tokens != (":",) for tokens, _ in dimensions):
        sizes = [whole(value(*one)) for one in dimensions]
        if math.prod(sizes) > _MOST_STATEMENTS:
            raise UnknownError
        values[name] = np.full(sizes, np.nan)


def _replaced(array: Value, subscripts: Sequence[Value | None], value: Value) -> Value:
    """Return an array with a value in the place of the elements that subscripts choose."""
    if len(subscripts) != array.ndim:
        raise UnknownError
    places = [
        np.arange(size) if one is None else np.atleast_1d(one).astype(int) - 1
        for one, size in zip(subscripts, array.shape, strict=True)
    ]
    if any(((one < 0) | (one >= size)).any() for one, size in zip(places, array.shape, strict=True)):
        raise UnknownError
    found = array.copy()
    shape = [len(one) for one in places]
    if value.ndim and value.size != math.prod(shape):
        raise UnknownError
    found[np.ix_(*places)] = value.reshape(shape) if value.ndim else value
    return found
