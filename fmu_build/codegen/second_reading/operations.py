"""The operators and built-in functions of Modelica on numbers and arrays; Booleans are 0 and 1.

Modelica 3.6, chapters 3.7 and 10.6. What is not defined, as a square root of -1, is NaN or infinite.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
import numpy.typing as npt

Value: TypeAlias = npt.NDArray[np.float64]

MOST_ELEMENTS: Final = 10_000


class UnknownError(Exception):
    """The second reading does not know a value."""

    is_of_change = False
    """Whether that is because of a redeclaration, or of heirs of a package."""


class ChangedError(UnknownError):
    """Redeclarations or heirs of a package may give other values or classes."""

    is_of_change = True


def scalar(value: Value) -> float:
    """Return a scalar as a number; raises `UnknownError` for an array."""
    if value.ndim:
        raise UnknownError
    return float(value)


def whole(value: Value) -> int:
    """Return a whole number; raises `UnknownError` for anything else."""
    number = scalar(value)
    if number != np.floor(number) or not np.isfinite(number):
        raise UnknownError
    return int(number)


def as_value(given: Any) -> Value:
    """Return numbers, perhaps nested, as a value; raises `UnknownError` if the rows differ in length."""
    try:
        return np.asarray(given, dtype=float)
    except ValueError as error:
        raise UnknownError from error


def binary(sign: str, one: Value, other: Value) -> Value:
    """Return the result of an operator between two operands."""
    if sign not in _BINARY:
        raise UnknownError
    with np.errstate(all="ignore"):
        return as_value(_BINARY[sign](one, other))


def smooth(sign: str, operands: Sequence[Value]) -> Value | None:
    """Return a number in the place of a Boolean, which depends on all that this depends on; None for others.

    So ``x > c`` has another value for each ``c``. What is the same by the laws of logic has the same value,
    as ``not x > c`` and ``x <= c``, and the values of 0 and 1 are those of false and true.
    """
    if sign not in _SMOOTH:
        return None
    with np.errstate(all="ignore"):
        return as_value(_SMOOTH[sign](*operands))


def choice(condition: Value, chosen: Value, other: Value) -> Value:
    """Return the value of ``if condition then chosen else other`` for such a number as a condition."""
    if chosen.shape != other.shape:
        raise UnknownError
    weight = scalar(condition)
    return as_value(weight * chosen + (1 - weight) * other)


def unary(sign: str, operand: Value) -> Value:
    """Return the result of ``-``, ``+`` or ``not``."""
    if sign in ("-", ".-"):
        return as_value(-operand)
    if sign in ("+", ".+"):
        return operand
    if sign != "not":
        raise UnknownError
    return as_value(operand == 0)


def called(name: str, arguments: Sequence[Value]) -> Value:
    """Return the result of a built-in function."""
    function = _OF_NUMBERS.get(name)
    with np.errstate(all="ignore"):
        try:
            if function is not None:
                return as_value(function(*arguments))
            if name not in _OF_ARRAYS:
                raise UnknownError
            return as_value(_OF_ARRAYS[name](*arguments))
        except (TypeError, ValueError, IndexError, np.linalg.LinAlgError) as error:
            raise UnknownError from error


def is_built_in(name: str) -> bool:
    """Return whether a built-in function has this name."""
    return name in _OF_NUMBERS or name in _OF_ARRAYS


def matrix(rows: Sequence[Sequence[Value]]) -> Value:
    """Return ``[a, b; c, d]`` (Modelica 3.6, section 10.4.2.1)."""
    try:
        return np.vstack([np.hstack([_promoted(one) for one in row]) for row in rows])
    except ValueError as error:
        raise UnknownError from error


def span_of(first: Value, step: Value, last: Value) -> Value:
    """Return ``first:step:last``."""
    start, stride, end = scalar(first), scalar(step), scalar(last)
    if not stride:
        raise UnknownError
    count = max(0, int(np.floor((end - start) / stride + 1e-10)) + 1)
    if count > MOST_ELEMENTS:
        raise UnknownError
    return as_value([start + place * stride for place in range(count)])


def _promoted(value: Value) -> Value:
    if value.ndim > 2:
        raise UnknownError
    shape = (*value.shape, 1, 1)[:2]
    promoted: Value = value.reshape(shape)
    return promoted


def _same(operation: Callable[[Value, Value], Value]) -> Callable[[Value, Value], Value]:
    def of_same_shape(one: Value, other: Value) -> Value:
        if one.shape != other.shape:
            raise UnknownError
        return operation(one, other)

    return of_same_shape


def _broadcast(operation: Callable[[Value, Value], Value]) -> Callable[[Value, Value], Value]:
    def of_shape_or_scalar(one: Value, other: Value) -> Value:
        if one.ndim and other.ndim and one.shape != other.shape:
            raise UnknownError
        return operation(one, other)

    return of_shape_or_scalar


def _of_scalars(operation: Callable[[Any, Any], Any]) -> Callable[[Value, Value], Value]:
    def of_scalars(one: Value, other: Value) -> Value:
        return as_value(operation(scalar(one), scalar(other)))

    return of_scalars


def _product(one: Value, other: Value) -> Value:
    if not one.ndim or not other.ndim:
        return one * other
    if one.ndim > 2 or other.ndim > 2 or one.shape[-1] != other.shape[0]:
        raise UnknownError
    return as_value(one @ other)


def _quotient(one: Value, other: Value) -> Value:
    return as_value(np.divide(one, scalar(other)))


def _power(one: Value, other: Value) -> Value:
    if one.ndim == 2 and one.shape[0] == one.shape[1] and not other.ndim:
        return as_value(np.linalg.matrix_power(one, whole(other)))
    return as_value(np.power(scalar(one), scalar(other)))


_BINARY: Final[Mapping[str, Callable[[Value, Value], Any]]] = {
    "+": _same(np.add),
    "-": _same(np.subtract),
    "*": _product,
    "/": _quotient,
    "^": _power,
    ".+": _broadcast(np.add),
    ".-": _broadcast(np.subtract),
    ".*": _broadcast(np.multiply),
    "./": _broadcast(np.divide),
    ".^": _broadcast(np.power),
    "and": _broadcast(lambda one, other: (one != 0) & (other != 0)),
    "or": _broadcast(lambda one, other: (one != 0) | (other != 0)),
    "<": _of_scalars(lambda one, other: one < other),
    "<=": _of_scalars(lambda one, other: one <= other),
    ">": _of_scalars(lambda one, other: one > other),
    ">=": _of_scalars(lambda one, other: one >= other),
    "==": _of_scalars(lambda one, other: one == other),
    "<>": _of_scalars(lambda one, other: one != other),
}


def _above(one: Value, other: Value) -> float:
    return 0.37 * (scalar(one) - scalar(other)) + 0.21


def _equal(one: Value, other: Value) -> float:
    return 0.31 * (scalar(one) - scalar(other)) ** 2 + 0.17


def _mixed(factor: float, *operands: Value) -> float:
    """Return a number that depends on all operands, in any order."""
    return float(sum(np.sum(one) for one in operands) + factor * np.prod([np.prod(one) for one in operands]))


_SMOOTH: Final[Mapping[str, Callable[..., Any]]] = {
    ">": _above,
    "<=": lambda one, other: 1 - _above(one, other),
    "<": lambda one, other: _above(other, one),
    ">=": lambda one, other: 1 - _above(other, one),
    "==": _equal,
    "<>": lambda one, other: 1 - _equal(one, other),
    "and": lambda one, other: one * other,
    "or": lambda one, other: one + other - one * other,
    "not": lambda one: 1 - one,
    "ceil": lambda one: 1.3 * one,
    "floor": lambda one: 1.2 * one,
    "integer": lambda one: 1.2 * one,
    "Integer": lambda one: 1.2 * one,
    "sign": lambda one: 0.7 * one,
    "div": lambda one, other: one + 0.6 * other,
    "max": lambda *operands: _mixed(1.4, *operands),
    "min": lambda *operands: _mixed(1.6, *operands),
    "mod": lambda one, other: one + 0.7 * other,
    "rem": lambda one, other: one + 0.8 * other,
}

_OF_NUMBERS: Final[Mapping[str, Callable[..., Any]]] = {
    "abs": np.abs,
    "acos": np.arccos,
    "asin": np.arcsin,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "ceil": np.ceil,
    "cos": np.cos,
    "cosh": np.cosh,
    "div": lambda a, b: np.trunc(a / b),
    "exp": np.exp,
    "floor": np.floor,
    "integer": np.floor,
    "Integer": np.floor,  # of an enumeration
    "log": np.log,
    "log10": np.log10,
    "mod": lambda a, b: a - np.floor(a / b) * b,
    "rem": lambda a, b: a - np.trunc(a / b) * b,
    "sign": np.sign,
    "sin": np.sin,
    "sinh": np.sinh,
    "sqrt": np.sqrt,
    "tan": np.tan,
    "tanh": np.tanh,
}


def _filled(value: Value, *sizes: Value) -> Value:
    shape = [whole(one) for one in sizes]
    if min(shape, default=0) < 0 or np.prod(shape, dtype=float) > MOST_ELEMENTS:
        raise UnknownError
    return np.tile(value, (*shape, *(1 for _ in value.shape))) if shape else value


def _extreme(of_array: Callable[[Value], Any], of_two: Callable[[Value, Value], Any]) -> Callable[..., Any]:
    def extreme(*arguments: Value) -> Any:
        if len(arguments) == 1:
            return of_array(arguments[0]) if arguments[0].size else _unknown()
        return of_two(*arguments)

    return extreme


def _unknown() -> Value:
    raise UnknownError


def _joined(dimension: Value, *arrays: Value) -> Value:
    return np.concatenate(arrays, axis=whole(dimension) - 1)


def _skew(one: Value) -> Value:
    x, y, z = one
    return as_value([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def _symmetric(one: Value) -> Value:
    upper = np.triu(one)
    return as_value(upper + np.triu(one, 1).T)


def _vector(one: Value) -> Value:
    return as_value(one.reshape(-1)) if sum(size > 1 for size in one.shape) <= 1 else _unknown()


def _matrix(one: Value) -> Value:
    if one.ndim < 2:
        return _promoted(one)
    return as_value(one.reshape(one.shape[:2]))


_OF_ARRAYS: Final[Mapping[str, Callable[..., Any]]] = {
    "cat": _joined,
    "cross": np.cross,
    "diagonal": np.diag,
    "fill": _filled,
    "identity": lambda size: np.eye(whole(size)),
    "linspace": lambda first, last, count: np.linspace(scalar(first), scalar(last), whole(count)),
    "matrix": _matrix,
    "max": _extreme(np.max, np.maximum),
    "min": _extreme(np.min, np.minimum),
    "ndims": np.ndim,
    "ones": lambda *sizes: _filled(as_value(1), *sizes),
    "outerProduct": np.outer,
    "product": np.prod,
    "scalar": lambda one: one.reshape(()),
    "skew": _skew,
    "sum": np.sum,
    "symmetric": _symmetric,
    "transpose": lambda one: np.swapaxes(one, 0, 1),
    "vector": _vector,
    "zeros": lambda *sizes: _filled(as_value(0), *sizes),
}
