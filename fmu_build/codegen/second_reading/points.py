"""Random values of the variables, for which both readings of an expression must have the same value."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import partial
from typing import Final

import numpy as np

from fmu_build.codegen.second_reading.arithmetic import Chosen, Names, value_of
from fmu_build.codegen.second_reading.called_functions import all_arguments, sizes_of_result, variables_of
from fmu_build.codegen.second_reading.functions import Function, function_of
from fmu_build.codegen.second_reading.gathered import flattened, gathered, leaves_in
from fmu_build.codegen.second_reading.givens import Scope, nowhere
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value, called
from fmu_build.codegen.second_reading.records import Constructor, constructor_of, member_of
from fmu_build.codegen.second_reading.scopes import PREDEFINED
from fmu_build.codegen.second_reading.syntax import Class

_BOOLEANS: Final = frozenset(("edge", "change"))
#: Ranges of the random values at each point: roots and logarithms are not defined for negative ones.
_RANGES: Final = ((0.2, 1.8), (0.5, 4.0), (1.1, 1.9), (-3.0, 3.0))
#: The values of a Boolean at the points, in some order.
_BOOLEANS_AT: Final = (0, 0, 1, 1)


@dataclass(frozen=True, slots=True)
class Point:
    """Values of all variables; constants and parameters have their own values unless they are `free`.

    If it is one of replaced names, so have variables with an equation in their declaration.

    If it is smooth, expressions have numbers in the place of Booleans, as `smooth` in `operations` says.
    """

    instances: Variables
    number: int
    free: Set[str]
    is_smooth: bool
    is_replaced: bool
    _drawn: dict[str, Value] = field(default_factory=dict)
    _computed: dict[str, Value | None] = field(default_factory=dict)

    def of(self, path: str) -> Value:
        """Return the value of a variable; raises `UnknownError` if it needs its own, which is not known."""
        if self.is_random(path):
            return self.applied("", path)
        if path not in self._computed:
            self._computed[path] = None  # until it is known
            self._computed[path] = self.own(path)
        found = self._computed[path]
        if found is None:
            raise UnknownError
        return found

    def own(self, path: str) -> Value:
        """Return the value that a variable is given; raises `UnknownError` if it is not known."""
        leaf = self.instances.leaves[path]
        if not leaf.given.value:
            raise UnknownError
        names = source_names(self, leaf.given.scope or self.instances.nowhere)
        return leaf.given.spread(value_of(leaf.given.value, names), leaf.sizes)

    def is_random(self, path: str) -> bool:
        """Return whether a variable has a random value."""
        leaf = self.instances.leaves[path]
        has_own = leaf.is_constant or (self.is_replaced and bool(leaf.given.value)) or path in self._computed
        return path in self.free or not has_own

    def applied(self, operator: str, path: str) -> Value:
        """Return the value of an operator, as ``der``, of a variable; an empty one is the variable itself."""
        key = f"{operator} {path}"
        if key not in self._drawn:
            leaf = self.instances.leaves[path]
            kind = PREDEFINED["Boolean"] if operator in _BOOLEANS else leaf.kind
            self._drawn[key] = self._random(key, kind, leaf.sizes)
        return self._drawn[key]

    @property
    def time(self) -> Value:
        """The time."""
        return self._random("time", PREDEFINED["Real"], ())

    def result(self, function: Function, arguments: Sequence[Value], place: int) -> Value:
        """Return numbers that depend on a function and all its arguments as a smooth result would."""
        if function.is_built_in and not place:
            return called(function.declared.name, arguments)
        key = f"{function.key} {place}"
        variables = variables_of(self.instances, function)
        sizes = sizes_of_result(function, variables, arguments, place, self.names_in(variables))
        own = self._random(key, PREDEFINED["Real"], sizes)
        return as_value(self.dependent(key, arguments) + own)

    def names_in(self, variables: Variables) -> Callable[[Class], Names]:
        """Return what names in classes mean that are no variables of a function, with its heir."""
        point = Point(variables, self.number, frozenset(), self.is_smooth, is_replaced=False)
        return lambda around: source_names(point, nowhere(around))

    def dependent(self, key: str, arguments: Sequence[Value]) -> Value:
        """Return a number that depends on arguments, and on a key in which way."""
        found = 0.0
        for place, argument in enumerate(arguments):
            weights = self._random(f"{key} {place}", PREDEFINED["Real"], argument.shape)
            found += float(np.sum(np.sin(weights + argument)))
        return as_value(found)

    def constructed(
        self, constructor: Constructor, arguments: Sequence[Value], named: Mapping[str, Value]
    ) -> Value:
        """Return the value of a record with these arguments."""
        given: dict[str, Value | None] = {**constructor.given(arguments, named)}
        variables = constructor.variables
        inner = Point(variables, self.number, frozenset(), self.is_smooth, is_replaced=True, _computed=given)
        return flattened(inner.of(leaf) for leaf in leaves_in(variables, ""))

    def of_operator(self, name: str, arguments: Sequence[Value]) -> Value | None:
        """Return the value of an operator that depends on more than its arguments; None for others."""
        if name in ("initial", "terminal"):
            return self._random(name, PREDEFINED["Boolean"], ())
        return self.dependent(name, arguments) if name in ("delay", "sample", "semiLinear") else None

    def _random(self, key: str, kind: Class, sizes: tuple[int, ...]) -> Value:
        numbers = np.random.default_rng(zlib.crc32(f"{key} {self.number}".encode()))
        if kind is PREDEFINED["Real"]:
            return as_value(numbers.uniform(*_RANGES[self.number], sizes))
        if kind is PREDEFINED["Integer"]:
            return as_value(numbers.integers(1, 4, sizes))
        if kind is PREDEFINED["Boolean"]:
            # At two of the points, each is true.
            order = np.random.default_rng(zlib.crc32(key.encode()))
            return as_value(order.permuted(np.tile(_BOOLEANS_AT, (*sizes, 1)), axis=-1)[..., self.number])
        if kind.literals:
            return as_value(numbers.integers(1, len(kind.literals) + 1, sizes))
        raise UnknownError


class Points:
    """The points at which expressions are compared.

    rumoca writes the values of some parameters into its expressions. So parameters have random values only
    where it has kept their names.
    """

    def __init__(self, instances: Variables, kept: Set[str]) -> None:
        leaves = instances.leaves
        constants = {one for one in kept if one in leaves and leaves[one].is_constant}
        integers = {one for one in constants if leaves[one].kind is PREDEFINED["Integer"]}
        self.has_integers = bool(integers)
        self.of_any_integers = _points(instances, constants)
        self.of_own_integers = _points(instances, constants - integers)
        #: rumoca writes the equations of some variables in the place of their names; functions have none.
        has_equations = instances.nowhere.around.kind != "function"
        self.of_replaced_names = _points(instances, constants - integers, is_replaced=has_equations)


def _points(instances: Variables, free: Set[str], *, is_replaced: bool = False) -> list[Point]:
    numbers = range(len(_RANGES))
    return [
        Point(instances, number, free, smooth, is_replaced) for smooth in (False, True) for number in numbers
    ]


def source_names(point: Point, scope: Scope) -> Names:
    """Return what names mean in a scope at a point."""
    return _SourceNames(point, scope)


@dataclass(frozen=True, slots=True)
class _SourceNames:
    point: Point
    scope: Scope

    @property
    def is_smooth(self) -> bool:
        return self.point.is_smooth

    def is_random(self, reference: Chosen) -> bool:
        path = self.point.instances.path_of(reference, self.scope)
        if path is None:
            return reference[0][0] == "time"
        return bool(gathered(self.point.instances, path, reference, self._randomness).any())

    def _randomness(self, path: str) -> Value:
        return np.full(self.point.instances.leaves[path].sizes, float(self.point.is_random(path)))

    def value(self, reference: Chosen) -> Value:
        path = self.point.instances.path_of(reference, self.scope)
        if path is not None:
            return gathered(self.point.instances, path, reference, self.point.of)
        if [name for name, _ in reference] == ["time"]:
            return self.point.time
        return self.point.instances.of_constant(reference, self.scope)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.point.instances.sizes_of(reference, self.scope)

    def applied(self, operator: str, reference: Chosen) -> Value:
        path = self.point.instances.path_of(reference, self.scope)
        if path is None:
            raise UnknownError
        return gathered(self.point.instances, path, reference, partial(self.point.applied, operator))

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        instances = self.point.instances
        is_of_enumeration = name == "Integer"
        if is_of_enumeration or not instances.library.is_class(name, self.scope.around):
            return self.point.of_operator(name, arguments)
        constructor = self._constructor(name)
        if constructor is not None:
            return self.point.constructed(constructor, arguments, named)
        function = function_of(instances.library, instances.lookup, name, self.scope)
        if function.declared is self.scope.around and function.is_built_in:
            return None
        variables = variables_of(instances, function)
        names_in = self.point.names_in(variables)
        return self.point.result(
            function, all_arguments(function, variables, arguments, named, names_in), place
        )

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        constructor = self._constructor(name)
        if constructor is not None:
            return member_of(constructor.variables, "", result, members)
        instances = self.point.instances
        function = function_of(instances.library, instances.lookup, name, self.scope)
        output, *_ = function.outputs
        return member_of(variables_of(instances, function), output, result, members)

    def _constructor(self, name: str) -> Constructor | None:
        try:
            return constructor_of(self.point.instances, name, self.scope)
        except UnknownError:  # It may be a function.
            return None
