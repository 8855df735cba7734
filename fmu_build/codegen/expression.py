"""Expressions of a lowered model: immutable nodes that can be compared, searched and differentiated.

All values are doubles; truth values are 1 or 0. Equality is structural, so that common subexpressions can be
looked up in a dictionary.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

UNARY = frozenset(
    (
        *("Neg", "Not", "Abs", "Sign", "Sqrt", "Exp", "Log", "Log10", "Floor", "Ceil", "Trunc"),
        *("Sin", "Cos", "Tan", "Asin", "Acos", "Atan", "Sinh", "Cosh", "Tanh"),
    )
)
BINARY = frozenset(("Add", "Sub", "Mul", "Div", "Pow", "Atan2", "Min", "Max", "And", "Or"))
COMPARE = frozenset(("Lt", "Le", "Gt", "Ge", "Eq", "Ne"))
TRUTH = COMPARE | {"And", "Or", "Not"}

Slot = tuple[Literal["y", "p"], int]
"""A position in one of the two arrays of values."""


@dataclass(frozen=True, slots=True, eq=False)
class Expression:
    """One node: an operator with its arguments, or a leaf.

    Leaves: ``number`` (payload: float), ``time``, ``y`` and ``p`` (payload: index), and the tangents of the
    last three, ``dtime``, ``dy`` and ``dp``. Operators: the names in `UNARY`, `BINARY` and `COMPARE`,
    ``Select`` (condition, value if true, value if false), and ``call`` (payload: function name and number of
    the result; arguments: scalars).
    """

    operator: str
    arguments: tuple[Expression, ...] = ()
    payload: float | int | tuple[str, int] | None = None
    _hash: int = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_hash", hash((self.operator, self.arguments, self.payload)))

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        return (
            isinstance(other, Expression)
            and self._hash == other._hash
            and self.operator == other.operator
            and self.payload == other.payload
            and self.arguments == other.arguments
        )

    @property
    def is_number(self) -> bool:
        """Whether this node is a literal."""
        return self.operator == "number"

    @property
    def value(self) -> float:
        """The value of a ``number`` node."""
        assert isinstance(self.payload, float)
        return self.payload

    @property
    def index(self) -> int:
        """The index of a ``y`` or ``p`` node, or of its tangent."""
        assert isinstance(self.payload, int)
        return self.payload


TIME = Expression("time")


def number(value: float) -> Expression:
    """Return a literal."""
    return Expression("number", payload=float(value))


def y(index: int) -> Expression:
    """Return the leaf that reads a state or an algebraic variable."""
    return Expression("y", payload=index)


def p(index: int) -> Expression:
    """Return the leaf that reads a parameter, input, discrete variable or memory."""
    return Expression("p", payload=index)


def leaf(slot: Slot) -> Expression:
    """Return the leaf that reads a slot."""
    return y(slot[1]) if slot[0] == "y" else p(slot[1])


DTIME = Expression("dtime")


def tangent_leaf(slot: Slot) -> Expression:
    """Return the leaf that reads the tangent of a slot; the tangent of time is `DTIME`."""
    return Expression(f"d{slot[0]}", payload=slot[1])


ZERO, ONE = number(0.0), number(1.0)

_FOLD: dict[str, Callable[[float, float], float]] = {
    "Add": lambda a, b: a + b,
    "Sub": lambda a, b: a - b,
    "Mul": lambda a, b: a * b,
}


def negate(a: Expression) -> Expression:
    """Return -a: cancels a double negation and swaps the operands of a difference."""
    if a.is_number:
        return number(-a.value)
    if a.operator == "Sub":
        return binary("Sub", a.arguments[1], a.arguments[0])
    return a.arguments[0] if a.operator == "Neg" else Expression("Neg", (a,))


def unary(operator: str, a: Expression) -> Expression:
    """Return a unary operation, simplified."""
    if operator == "Neg":
        return negate(a)
    if operator == "Not" and a.is_number:
        return number(a.value == 0.0)
    return Expression(operator, (a,))


def binary(operator: str, a: Expression, b: Expression) -> Expression:
    """Return a binary operation, with simplifications that preserve its value for finite arguments."""
    if a.is_number and b.is_number and operator in _FOLD:
        return number(_FOLD[operator](a.value, b.value))
    if operator in _SIMPLIFY:
        return _SIMPLIFY[operator](a, b)
    return Expression(operator, (a, b))


def _sum(a: Expression, b: Expression) -> Expression:
    if ZERO in (a, b):
        return b if a == ZERO else a
    if b.operator == "Neg":
        return _difference(a, b.arguments[0])
    return _difference(b, a.arguments[0]) if a.operator == "Neg" else Expression("Add", (a, b))


def _difference(a: Expression, b: Expression) -> Expression:
    if ZERO in (a, b):
        return negate(b) if a == ZERO else a
    if b.operator == "Neg":
        return _sum(a, b.arguments[0])
    return negate(_sum(a.arguments[0], b)) if a.operator == "Neg" else Expression("Sub", (a, b))


def _product(a: Expression, b: Expression) -> Expression:
    if ZERO in (a, b):
        return ZERO
    if ONE in (a, b):
        return b if a == ONE else a
    for this, other in ((a, b), (b, a)):
        if this.operator == "Neg":
            return negate(_product(this.arguments[0], other))
    return Expression("Mul", (a, b))


def _quotient(a: Expression, b: Expression) -> Expression:
    return ZERO if a == ZERO else a if b == ONE else Expression("Div", (a, b))


def _both(a: Expression, b: Expression) -> Expression:
    return _truth("And", a, b, neutral=1.0)


def _either(a: Expression, b: Expression) -> Expression:
    return _truth("Or", a, b, neutral=0.0)


def _truth(operator: str, a: Expression, b: Expression, neutral: float) -> Expression:
    for this, other in ((a, b), (b, a)):
        if this.is_number:
            return other if (this.value != 0.0) == (neutral != 0.0) else number(1.0 - neutral)
    return a if a == b else Expression(operator, (a, b))


_SIMPLIFY: dict[str, Callable[[Expression, Expression], Expression]] = {
    "Add": _sum,
    "Sub": _difference,
    "Mul": _product,
    "Div": _quotient,
    "And": _both,
    "Or": _either,
}


def select(condition: Expression, if_true: Expression, if_false: Expression) -> Expression:
    """Return a conditional value, without the condition if it makes no difference."""
    if condition.is_number:
        return if_true if condition.value != 0.0 else if_false
    if if_true == if_false:
        return if_true
    if if_false == ZERO and _is_finite_guard(condition, if_true):
        # rumoca wraps a divisor as "finite ? divisor : 0"; without the guard, a non-finite divisor shows.
        return if_true
    return Expression("Select", (condition, if_true, if_false))


def _is_finite_guard(condition: Expression, guarded: Expression) -> bool:
    largest = number(1.7976931348623157e308)
    return condition == Expression(
        "And",
        (Expression("Ge", (guarded, negate(largest))), Expression("Le", (guarded, largest))),
    )


def walk(*roots: Expression, closed: Container[Expression] = ()) -> Iterator[Expression]:
    """Yield every distinct node of the roots in post-order: arguments before the nodes that use them.

    The arguments of a node in `closed` are not visited.
    """
    seen: set[Expression] = set()
    for root in roots:
        stack: list[tuple[Expression, bool]] = [(root, False)]
        while stack:
            node, expanded = stack.pop()
            if expanded:
                yield node
            elif node not in seen:
                seen.add(node)
                stack.append((node, True))
                if node not in closed:
                    stack.extend((argument, False) for argument in reversed(node.arguments))


def leaves(*roots: Expression) -> set[Expression]:
    """Return the ``y``, ``p`` and ``time`` nodes that the expressions read."""
    return {node for node in walk(*roots) if node.operator in ("y", "p", "time")}


def places(store: Literal["y", "p"], *roots: Expression) -> set[int]:
    """Return the indices of a store that the expressions read."""
    return {leaf.index for leaf in leaves(*roots) if leaf.operator == store}


def varies(root: Expression) -> bool:
    """Return whether a value can change between events: it reads y or time."""
    return any(leaf.operator in ("y", "time") for leaf in leaves(root))


def substitute(root: Expression, replacements: Mapping[Expression, Expression]) -> Expression:
    """Return the expression with nodes replaced; the replacements themselves are not searched."""
    done: dict[Expression, Expression] = dict(replacements)
    for node in walk(root):
        if node not in done:
            done[node] = rebuild(node, tuple(done[argument] for argument in node.arguments))
    return done[root]


def rebuild(node: Expression, arguments: tuple[Expression, ...]) -> Expression:
    """Return the same operation on other arguments, simplified."""
    if arguments == node.arguments:
        return node
    if node.operator == "Select":
        return select(*arguments)
    if node.operator in UNARY:
        return unary(node.operator, *arguments)
    if node.operator in BINARY:
        return binary(node.operator, *arguments)
    return Expression(node.operator, arguments, node.payload)
