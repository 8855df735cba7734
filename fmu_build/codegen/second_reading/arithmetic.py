"""The values of expressions of numbers, names and arrays; `UnknownError` for anything else."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Sequence
from typing import Final, Protocol, TypeAlias

from fmu_build.codegen.second_reading.syntax import Tokens

Value: TypeAlias = "float | list[Value]"
_Operation: TypeAlias = Callable[[float, float], float]
_SUM: Final[dict[str, _Operation]] = {"+": operator.add, "-": operator.sub}
_RELATIONS: Final[dict[str, _Operation]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "<>": operator.ne,
}
_PRODUCT: Final[dict[str, _Operation]] = {"*": operator.mul, "/": operator.truediv}
_FUNCTIONS: Final[dict[str, Callable[..., float]]] = {
    "abs": abs,
    "ceil": math.ceil,
    "cos": math.cos,
    "div": lambda a, b: math.trunc(a / b),
    "exp": math.exp,
    "floor": math.floor,
    "integer": math.floor,
    "log": math.log,
    "mod": lambda a, b: a - math.floor(a / b) * b,
    "rem": math.fmod,
    "sin": math.sin,
    "sqrt": math.sqrt,
    "tan": math.tan,
}
_FILLED: Final[dict[str, tuple[float, ...]]] = {"fill": (), "ones": (1.0,), "zeros": (0.0,)}
_MOST_ELEMENTS: Final = 1000
_OF_ARRAYS: Final[dict[str, Callable[[Sequence[float]], float]]] = {
    "max": max,
    "min": min,
    "product": math.prod,
    "sum": sum,
}


class UnknownError(Exception):
    """The second reading does not know a value."""


class Names(Protocol):
    """What names mean in an expression; each method raises `UnknownError` if it is not known."""

    def value(self, name: str) -> Value:
        """Return the value of a parameter, constant or iterator."""

    def sizes(self, name: str) -> Sequence[int]:
        """Return the sizes of an array."""

    def is_function(self, name: str) -> bool:
        """Return whether the source declares a function of this name."""


def value_of(tokens: Tokens, names: Names) -> Value:
    """Return the value of an expression.

    Raises:
        UnknownError: it is not known
    """
    reader = _Reader(tokens, names)
    try:
        found = reader.expression()
    except (ArithmeticError, TypeError, ValueError) as error:
        raise UnknownError from error
    if reader.here:
        raise UnknownError
    return found


class _Reader:
    def __init__(self, tokens: Tokens, names: Names) -> None:
        self._tokens = tokens
        self._place = 0
        self._names = names

    @property
    def here(self) -> str:
        return self._tokens[self._place] if self._place < len(self._tokens) else ""

    def _take(self) -> str:
        if not self.here:
            raise UnknownError
        self._place += 1
        return self._tokens[self._place - 1]

    def _expect(self, token: str) -> None:
        if self._take() != token:
            raise UnknownError

    def expression(self) -> Value:
        if self.here not in ("if", "elseif"):
            return self._logical()
        self._take()
        condition = self._logical()
        self._expect("then")
        chosen = self.expression()
        if self.here == "elseif":
            other = self.expression()
        else:
            self._expect("else")
            other = self.expression()
        return chosen if _number(condition) else other

    def _logical(self) -> Value:
        found = self._conjunction()
        while self.here == "or":
            self._take()
            found = float(bool(_number(found)) | bool(_number(self._conjunction())))
        return found

    def _conjunction(self) -> Value:
        found = self._negation()
        while self.here == "and":
            self._take()
            found = float(bool(_number(found)) & bool(_number(self._negation())))
        return found

    def _negation(self) -> Value:
        if self.here != "not":
            return self._relation()
        self._take()
        return float(not _number(self._relation()))

    def _relation(self) -> Value:
        found = self._sum()
        if self.here in _RELATIONS:
            found = float(_RELATIONS[self._take()](_number(found), _number(self._sum())))
        return found

    def _sum(self) -> Value:
        sign = self._take() if self.here in _SUM else ""
        found = self._product()
        if sign == "-":
            found = _scaled(operator.mul, found, -1.0)
        while self.here in _SUM:
            found = _elementwise(_SUM[self._take()], found, self._product())
        return found

    def _product(self) -> Value:
        found = self._power()
        while self.here in _PRODUCT:
            sign, other = self._take(), self._power()
            if sign == "*" and not isinstance(found, list):
                found, other = other, found
            found = _scaled(_PRODUCT[sign], found, _number(other))
        return found

    def _power(self) -> Value:
        found = self._primary()
        if self.here == "^":
            self._take()
            power = _number(found) ** _number(self._primary())
            if isinstance(power, complex):
                raise UnknownError
            found = float(power)
        return found

    def _primary(self) -> Value:
        first = self._take()
        if first[0].isdigit():
            return float(first)
        if first in ("true", "false"):
            return float(first == "true")
        if first == "(":
            found = self.expression()
            self._expect(")")
            return found
        if first == "{":
            return self._list("}")
        if first == "[":
            return self._matrix()
        if first[0].isalpha() or first[0] in "_'":
            return self._named(first)
        raise UnknownError

    def _list(self, end: str) -> list[Value]:
        elements = [self.expression()]
        while self.here == ",":
            self._take()
            elements.append(self.expression())
        self._expect(end)
        return elements

    def _matrix(self) -> Value:
        rows: list[Value] = []
        while True:
            row = [_number(self.expression())]
            while self.here == ",":
                self._take()
                row.append(_number(self.expression()))
            rows.append(list(row))
            if self._take() == "]":
                return rows

    def _named(self, first: str) -> Value:
        name = self._name(first)
        if self.here != "(":
            return self._names.value(name)
        self._take()
        if self._names.is_function(name):
            raise UnknownError
        return self._size() if name == "size" else _called(name, self._list(")"))

    def _name(self, name: str) -> str:
        while self.here in (".", "["):
            if self.here == "[":
                name += self._take() + self._take()
                if self.here != "]":
                    raise UnknownError
            name += self._take()
            if name[-1] == ".":
                name += self._take()
        return name

    def _size(self) -> Value:
        sizes = self._names.sizes(self._name(self._take()))
        if self.here == ")":
            self._take()
            return [float(size) for size in sizes]
        self._expect(",")
        (dimension,) = self._list(")")
        if not 1 <= _number(dimension) <= len(sizes):
            raise UnknownError
        return float(sizes[int(_number(dimension)) - 1])


def _called(name: str, arguments: list[Value]) -> Value:
    if name in _FILLED:
        value, *sizes = (*_FILLED[name], *map(_number, arguments))
        return _filled(value, sizes)
    if name in _OF_ARRAYS:
        return float(_OF_ARRAYS[name](list(_flat(arguments))))
    if name not in _FUNCTIONS:
        raise UnknownError
    return float(_FUNCTIONS[name](*map(_number, arguments)))


def _filled(value: float, sizes: Sequence[float]) -> Value:
    if not sizes:
        return value
    if not 0 <= sizes[0] <= _MOST_ELEMENTS:
        raise UnknownError
    return [_filled(value, sizes[1:]) for _ in range(int(sizes[0]))]


def _flat(value: Value) -> Iterator[float]:
    if isinstance(value, list):
        for one in value:
            yield from _flat(one)
    else:
        yield value


def _scaled(operation: _Operation, value: Value, other: float) -> Value:
    if isinstance(value, list):
        return [_scaled(operation, one, other) for one in value]
    return operation(value, other)


def _elementwise(operation: _Operation, one: Value, other: Value) -> Value:
    if isinstance(one, list) and isinstance(other, list):
        return [_elementwise(operation, a, b) for a, b in zip(one, other, strict=True)]
    return operation(_number(one), _number(other))


def _number(value: Value) -> float:
    if isinstance(value, list):
        raise UnknownError
    return value
