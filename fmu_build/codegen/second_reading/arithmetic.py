"""The values of expressions; `UnknownError` for anything that is not known."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import reduce
from typing import Any, Final, Protocol, TypeAlias

import numpy as np

from fmu_build.codegen.second_reading.expressions import (
    Array,
    Call,
    Choice,
    Comprehension,
    End,
    Expression,
    Matrix,
    Member,
    Number,
    Operation,
    Part,
    Reference,
    Span,
    expression,
    parts_of,
)
from fmu_build.codegen.second_reading.operations import (
    MOST_ELEMENTS,
    UnknownError,
    Value,
    as_value,
    binary,
    called,
    choice,
    matrix,
    scalar,
    smooth,
    span_of,
    unary,
    whole,
)
from fmu_build.codegen.second_reading.syntax import Tokens

Chosen: TypeAlias = Sequence[tuple[str, Sequence["Value | None"]]]
"""The names of a reference, each with the values of its subscripts, of which None is ``:``."""

_SAME: Final = frozenset(("noEvent",))
#: Operators of a variable, not of its value.
OPERATORS: Final = frozenset(("der", "pre", "edge", "change"))
_REDUCTIONS: Final[Mapping[str, Callable[..., Any]]] = {
    "max": np.max,
    "min": np.min,
    "product": np.prod,
    "sum": np.sum,
}


class Names(Protocol):
    """What names mean in an expression; each method raises `UnknownError` if it is not known."""

    @property
    def is_smooth(self) -> bool:
        """Whether numbers take the place of Booleans that depend on random values."""

    def is_random(self, reference: Chosen) -> bool:
        """Return whether the value is a random one."""

    def value(self, reference: Chosen) -> Value:
        """Return the value of a variable, parameter or constant."""

    def sizes(self, reference: Chosen) -> Sequence[int]:
        """Return the sizes of an array, of which the last name has no subscripts."""

    def applied(self, operator: str, reference: Chosen) -> Value:
        """Return the value of an operator for a variable, as ``der(x)``."""

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        """Return the result in a place of a function that the source declares; None if it declares none."""

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        """Return a member of the record that a function or constructor has returned."""


class NotRandom:
    """The part of `Names` that is the same wherever no value is random."""

    __slots__ = ()

    @property
    def is_smooth(self) -> bool:
        """Return False."""
        return False

    def is_random(self, reference: Chosen) -> bool:
        """Return False."""
        del reference
        return False

    def applied(self, operator: str, reference: Chosen) -> Value:
        """Raise `UnknownError`."""
        raise UnknownError


def tree_of(tokens: Tokens) -> Expression:
    """Return the tree of an expression; raises `UnknownError` if it is not understood."""
    try:
        return expression(tokens)
    except SyntaxError as error:
        raise UnknownError from error


def value_of(tokens: Tokens, names: Names, iterators: Mapping[str, float] | None = None) -> Value:
    """Return the value of an expression, in which iterators have these values.

    Raises:
        UnknownError: it is not known
    """
    return _Evaluation(names, iterators or {}).of(tree_of(tokens))


def results_of(
    tokens: Tokens, places: Iterable[int], names: Names, iterators: Mapping[str, float] | None = None
) -> list[Value]:
    """Return the results in some places of the function that an expression calls.

    Raises:
        UnknownError: they are not known
    """
    tree = tree_of(tokens)
    if not isinstance(tree, Call):
        raise UnknownError
    return [_Evaluation(names, iterators or {}).result(tree, place) for place in places]


def chosen_of(tokens: Tokens, names: Names, iterators: Mapping[str, float]) -> Chosen:
    """Return a reference, as an assignment has it on its left side, with the values of its subscripts.

    Raises:
        UnknownError: it is something else, or its subscripts are not known
    """
    tree = tree_of(tokens)
    if not isinstance(tree, Reference):
        raise UnknownError
    return _Evaluation(names, iterators).chosen(tree)


class _Evaluation:
    def __init__(self, names: Names, iterators: Mapping[str, float], dimension: int | None = None) -> None:
        self._names = names
        self._iterators = iterators
        self._end = dimension

    def of(self, tree: Expression) -> Value:  # noqa: C901 (one case for each kind)
        match tree:
            case Number():
                return as_value(tree.value)
            case Reference():
                return self._reference(tree)
            case Operation():
                return self._operation(tree)
            case Choice():
                return self._choice(tree)
            case Call():
                return self._call(tree)
            case Array():
                return as_value([self.of(one) for one in tree.elements])
            case Matrix():
                return matrix([[self.of(one) for one in row] for row in tree.rows])
            case Span():
                return span_of(self.of(tree.first), self.of(tree.step), self.of(tree.last))
            case Comprehension():
                return self._comprehension(tree)
            case Member():
                return self._member(tree.record, (tree.name,))
            case End() if self._end is not None:
                return as_value(self._end)
        raise UnknownError

    def _operation(self, tree: Operation) -> Value:
        operands = [self.of(one) for one in tree.operands]
        found = smooth(tree.sign, operands) if self._is_smooth(tree) else None
        if found is not None:
            return found
        return unary(tree.sign, *operands) if len(operands) == 1 else binary(tree.sign, *operands)

    def _choice(self, tree: Choice) -> Value:
        (condition, value), *further = tree.branches
        holds = self.of(condition)
        if scalar(holds) == 1:
            return self.of(value)
        other = Choice(tuple(further), tree.otherwise) if further else tree.otherwise
        return self.of(other) if not scalar(holds) else choice(holds, self.of(value), self.of(other))

    def _is_smooth(self, tree: Operation | Call) -> bool:
        operands = tree.operands if isinstance(tree, Operation) else tree.arguments
        return self._names.is_smooth and any(map(self._is_random, operands))

    def _is_random(self, tree: Expression) -> bool:
        if isinstance(tree, Reference):
            is_iterator = tree.name in self._iterators
            return not is_iterator and self._names.is_random(self.chosen(tree))
        if isinstance(tree, Comprehension):
            return self._is_random_for(tree.body, tree.iterators)
        if isinstance(tree, Call) and tree.name == "size":
            return False
        return any(map(self._is_random, parts_of(tree)))

    def _is_random_for(self, body: Expression, iterators: Sequence[tuple[str, Expression]]) -> bool:
        if not iterators:
            return self._is_random(body)
        *outer, (name, numbers) = iterators
        inner = (
            _Evaluation(self._names, {**self._iterators, name: float(one)}, self._end)
            for one in self.of(numbers).flat
        )
        return any(one._is_random_for(body, outer) for one in inner)

    def _reference(self, tree: Reference) -> Value:
        if tree.name in self._iterators and not tree.parts[0].subscripts:
            return as_value(self._iterators[tree.name])
        return self._names.value(self.chosen(tree))

    def chosen(self, tree: Reference) -> Chosen:
        """Return a reference with the values of its subscripts."""
        found: list[tuple[str, Sequence[Value | None]]] = []
        for part in tree.parts:
            subscripts = [
                None if one is None else self._subscript(one, [*found, (part.name, ())], place)
                for place, one in enumerate(part.subscripts)
            ]
            found.append((part.name, subscripts))
        return found

    def _subscript(self, tree: Expression, array: Chosen, place: int) -> Value:
        if not _has_end(tree):
            return self.of(tree)
        sizes = self._names.sizes(array)
        if place >= len(sizes):
            raise UnknownError
        return _Evaluation(self._names, self._iterators, sizes[place]).of(tree)

    def _call(self, tree: Call) -> Value:
        if tree.name in OPERATORS:
            variable = tree.arguments[0] if len(tree.arguments) == 1 else None
            if not isinstance(variable, Reference):
                raise UnknownError
            return self._names.applied(tree.name, self.chosen(variable))
        if tree.name == "size":
            return self._size(tree)
        rounded = smooth(tree.name, self._arguments(tree)) if self._is_smooth(tree) else None
        return self.result(tree, 0) if rounded is None else rounded

    def result(self, tree: Call, place: int) -> Value:
        """Return the result of a function in a place."""
        arguments = self._arguments(tree)
        named = {name: self.of(one) for name, one in tree.named}
        found = self._names.called(tree.name, arguments, named, place)
        if found is None and place:
            raise UnknownError
        return built_in(tree.name, arguments, named) if found is None else found

    def _arguments(self, tree: Call) -> list[Value]:
        return [self.of(one) for one in tree.arguments]

    def _size(self, tree: Call) -> Value:
        if not 1 <= len(tree.arguments) <= 2:
            raise UnknownError
        array, *dimension = tree.arguments
        if isinstance(array, Reference) and not array.parts[-1].subscripts:
            sizes = self._names.sizes(self.chosen(array))
        else:
            sizes = self.of(array).shape
        if not dimension:
            return as_value(sizes)
        place = whole(self.of(*dimension))
        if not 1 <= place <= len(sizes):
            raise UnknownError
        return as_value(sizes[place - 1])

    def _member(self, record: Expression, names: tuple[str, ...]) -> Value:
        """Return the value of a member of a record, of which the names are nested."""
        match record:
            case Member():
                return self._member(record.record, (record.name, *names))
            case Reference():
                return self._reference(Reference((*record.parts, *map(Part, names))))
            case Choice():
                branches = ((condition, reduce(Member, names, one)) for condition, one in record.branches)
                return self._choice(Choice(tuple(branches), reduce(Member, names, record.otherwise)))
            case Call():
                return self._names.member(record.name, self._call(record), names)
        raise UnknownError

    def _comprehension(self, tree: Comprehension) -> Value:
        elements = self._elements(tree.body, tree.iterators)
        if not tree.function:
            return elements
        if tree.function not in _REDUCTIONS or not elements.size:
            raise UnknownError
        if self._names.is_smooth and self._is_random(tree):
            found = smooth(tree.function, [elements])
            if found is not None:
                return found
        # The elements of a sum may be arrays.
        axes = tuple(range(len(tree.iterators)))
        return as_value(_REDUCTIONS[tree.function](elements, axis=axes))

    def _elements(self, body: Expression, iterators: Sequence[tuple[str, Expression]]) -> Value:
        """Return an array whose last dimension belongs to the first iterator (section 10.4.1.1)."""
        if not iterators:
            return self.of(body)
        *outer, (name, numbers) = iterators
        values = self.of(numbers)
        if values.ndim != 1 or values.size > MOST_ELEMENTS:
            raise UnknownError
        points = [
            _Evaluation(self._names, {**self._iterators, name: float(one)}, self._end) for one in values
        ]
        return as_value([one._elements(body, outer) for one in points])


def built_in(name: str, arguments: Sequence[Value], named: Mapping[str, Value]) -> Value:
    """Return the result of a built-in function or operator."""
    if name == "homotopy":
        return arguments[0] if arguments else named["actual"]
    if named:
        raise UnknownError
    if name == "smooth" and len(arguments) == 2:
        return arguments[1]
    if name in _SAME and len(arguments) == 1:
        return arguments[0]
    return called(name, arguments)


def _has_end(tree: Expression) -> bool:
    """Return whether there is an ``end`` in an expression, but not in the subscripts of another array."""
    return isinstance(tree, End) or any(map(_has_end, parts_of(tree)))
