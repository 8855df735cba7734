"""The values of expressions of numbers, names and arrays; `UnknownError` for anything else."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Final, TypeAlias

from fmu_build.codegen.second_reading.syntax import Tokens

Value: TypeAlias = "float | list[Value]"
_SUM: Final = {"+": operator.add, "-": operator.sub}
_RELATIONS: Final = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "<>": operator.ne,
}
_PRODUCT: Final = {"*": operator.mul, "/": operator.truediv}


class UnknownError(Exception):
    """The second reading does not know a value."""


def value_of(tokens: Tokens, look_up: Callable[[str], Value]) -> Value:
    """Return the value of an expression; `look_up` gives those of names.

    Raises:
        UnknownError: it is not known
    """
    reader = _Reader(tokens, look_up)
    try:
        found = reader.logical()
    except (ArithmeticError, ValueError) as error:
        raise UnknownError from error
    if reader.here:
        raise UnknownError
    return found


class _Reader:
    def __init__(self, tokens: Tokens, look_up: Callable[[str], Value]) -> None:
        self._tokens = tokens
        self._place = 0
        self._look_up = look_up

    @property
    def here(self) -> str:
        return self._tokens[self._place] if self._place < len(self._tokens) else ""

    def _take(self) -> str:
        if not self.here:
            raise UnknownError
        self._place += 1
        return self._tokens[self._place - 1]

    def logical(self) -> Value:
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
            found = -_number(found)
        while self.here in _SUM:
            found = _SUM[self._take()](_number(found), _number(self._product()))
        return found

    def _product(self) -> Value:
        found = self._power()
        while self.here in _PRODUCT:
            found = _PRODUCT[self._take()](_number(found), _number(self._power()))
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
            found = self.logical()
            self._close(")")
            return found
        if first == "{":
            return self._array()
        if first[0].isalpha() or first[0] in "_'":
            return self._named(first)
        raise UnknownError

    def _array(self) -> Value:
        elements = [self.logical()]
        while self.here == ",":
            self._take()
            elements.append(self.logical())
        self._close("}")
        return elements

    def _named(self, name: str) -> Value:
        while self.here in (".", "["):
            if self.here == "[":
                name += self._take() + self._take()
                if self.here != "]":
                    raise UnknownError
            name += self._take()
            if name[-1] == ".":
                name += self._take()
        if self.here == "(":
            raise UnknownError
        return self._look_up(name)

    def _close(self, bracket: str) -> None:
        if self._take() != bracket:
            raise UnknownError


def _number(value: Value) -> float:
    if isinstance(value, list):
        raise UnknownError
    return value
