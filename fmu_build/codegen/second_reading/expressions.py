"""The expressions of Modelica source as trees (Modelica 3.6, section 2.3.3 and appendix A.2.7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from functools import lru_cache
from typing import Final, TypeAlias, cast

from fmu_build.codegen.second_reading.syntax import Tokens

_RELATIONS: Final = frozenset(("<", "<=", ">", ">=", "==", "<>"))
_SUMS: Final = frozenset(("+", "-", ".+", ".-"))
_PRODUCTS: Final = frozenset(("*", "/", ".*", "./"))
_POWERS: Final = frozenset(("^", ".^"))
_WORDS: Final = frozenset(("and", "or", "not", "if", "then", "else", "elseif", "for", "in", "loop"))


@dataclass(frozen=True, slots=True)
class Number:
    """A number; ``false`` and ``true`` are 0 and 1."""

    value: float


@dataclass(frozen=True, slots=True)
class Part:
    """A name of a reference with its subscripts, of which None is ``:``."""

    name: str
    subscripts: tuple[Expression | None, ...] = ()


@dataclass(frozen=True, slots=True)
class Reference:
    """A variable or constant, as ``a.b[2].c``; the first name is empty for ``.P.c``."""

    parts: tuple[Part, ...]

    @property
    def name(self) -> str:
        """The names without subscripts."""
        return ".".join(part.name for part in self.parts)


@dataclass(frozen=True, slots=True)
class End:
    """``end`` as a subscript: the size of the dimension."""


@dataclass(frozen=True, slots=True)
class Operation:
    """An operator between its operands, or before its operand."""

    sign: str
    operands: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Choice:
    """``if a then b elseif c then d else e``."""

    branches: tuple[tuple[Expression, Expression], ...]
    otherwise: Expression


@dataclass(frozen=True, slots=True)
class Call:
    """A call with its positional and its named arguments."""

    name: str
    arguments: tuple[Expression, ...]
    named: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True, slots=True)
class Array:
    """``{a, b}``."""

    elements: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Matrix:
    """``[a, b; c, d]``."""

    rows: tuple[tuple[Expression, ...], ...]


@dataclass(frozen=True, slots=True)
class Span:
    """``first:step:last``."""

    first: Expression
    step: Expression
    last: Expression


@dataclass(frozen=True, slots=True)
class Comprehension:
    """``{a for i in b, j in c}``, or a reduction as ``sum(a for i in b)``, whose function is named."""

    function: str
    body: Expression
    iterators: tuple[tuple[str, Expression], ...]


@dataclass(frozen=True, slots=True)
class Member:
    """A member of a record that an expression gives, as ``f(x).a``; a source cannot contain this."""

    record: Expression
    name: str


Expression: TypeAlias = (
    "Number | Reference | End | Operation | Choice | Call | Array | Matrix | Span | Comprehension | Member"
)


def parts_of(tree: Expression) -> Iterator[Expression]:
    """Yield the expressions of which one consists, without those in subscripts."""
    waiting = [getattr(tree, one.name) for one in fields(tree)]
    for one in waiting:
        if isinstance(one, tuple):
            waiting += one
        elif is_dataclass(one) and not isinstance(one, Part):
            yield cast("Expression", one)


@lru_cache(maxsize=10_000)
def expression(tokens: Tokens) -> Expression:
    """Return the tree of an expression; raises `SyntaxError` if it is not understood."""
    reader = _Reader(tokens)
    found = reader.expression()
    if reader.here:
        raise SyntaxError(f"an expression goes on with {reader.here}")
    return found


class _Reader:
    def __init__(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self._place = 0

    @property
    def here(self) -> str:
        return self._tokens[self._place] if self._place < len(self._tokens) else ""

    def _take(self) -> str:
        if not self.here:
            raise SyntaxError("an expression ends early")
        self._place += 1
        return self._tokens[self._place - 1]

    def _expect(self, token: str) -> None:
        if self._take() != token:
            raise SyntaxError(f"{token} is expected")

    def _takes(self, token: str) -> bool:
        """Take a token if it is this one."""
        is_here = self.here == token
        self._place += is_here
        return is_here

    def expression(self) -> Expression:
        if not self._takes("if"):
            return self._span()
        branches = []
        while True:
            condition = self.expression()
            self._expect("then")
            branches.append((condition, self.expression()))
            if not self._takes("elseif"):
                break
        self._expect("else")
        return Choice(tuple(branches), self.expression())

    def _span(self) -> Expression:
        first = self._or()
        if not self._takes(":"):
            return first
        second = self._or()
        if not self._takes(":"):
            return Span(first, Number(1.0), second)
        return Span(first, second, self._or())

    def _or(self) -> Expression:
        return self._chain(frozenset(("or",)), self._and)

    def _and(self) -> Expression:
        return self._chain(frozenset(("and",)), self._not)

    def _not(self) -> Expression:
        return Operation("not", (self._relation(),)) if self._takes("not") else self._relation()

    def _relation(self) -> Expression:
        found = self._sum()
        if self.here in _RELATIONS:
            return Operation(self._take(), (found, self._sum()))
        return found

    def _sum(self) -> Expression:
        if self.here not in _SUMS:
            return self._chain(_SUMS, self._product)
        first = Operation(self._take(), (self._product(),))
        return self._chain(_SUMS, self._product, first)

    def _product(self) -> Expression:
        return self._chain(_PRODUCTS, self._power)

    def _power(self) -> Expression:
        found = self._primary()
        if self.here in _POWERS:
            return Operation(self._take(), (found, self._primary()))
        return found

    def _chain(
        self, signs: frozenset[str], operand: Callable[[], Expression], first: Expression | None = None
    ) -> Expression:
        """Return operations that are carried out from the left to the right."""
        found = operand() if first is None else first
        while self.here in signs:
            found = Operation(self._take(), (found, operand()))
        return found

    def _primary(self) -> Expression:
        found = self._operand()
        while self._takes("."):
            found = Member(found, self._take())
        return found

    def _operand(self) -> Expression:
        first = self._take()
        if first[0].isdigit():
            return Number(float(first))
        if first in ("true", "false"):
            return Number(float(first == "true"))
        if first == "(":
            found = self.expression()
            self._expect(")")
            return found
        if first == "{":
            return self._array()
        if first == "[":
            return self._matrix()
        if first == "end":
            return End()
        if first == "." or (first not in _WORDS and (first[0].isalpha() or first[0] in "_'")):
            return self._reference(first)
        raise SyntaxError(f"{first} is no expression")

    def _array(self) -> Expression:
        first = self.expression()
        if self.here == "for":
            return self._comprehension("", first, "}")
        elements = [first]
        while self._takes(","):
            elements.append(self.expression())
        self._expect("}")
        return Array(tuple(elements))

    def _matrix(self) -> Expression:
        rows: list[tuple[Expression, ...]] = []
        while True:
            row = [self.expression()]
            while self._takes(","):
                row.append(self.expression())
            rows.append(tuple(row))
            if not self._takes(";"):
                self._expect("]")
                return Matrix(tuple(rows))

    def _comprehension(self, function: str, body: Expression, closing: str) -> Expression:
        self._expect("for")
        iterators = []
        while True:
            name = self._take()
            self._expect("in")
            iterators.append((name, self.expression()))
            if not self._takes(","):
                self._expect(closing)
                return Comprehension(function, body, tuple(iterators))

    def _reference(self, first: str) -> Expression:
        parts = [Part("")] if first == "." else [self._part(first)]
        while first == "." or self._takes("."):
            parts.append(self._part(self._take()))
            first = ""
        found = Reference(tuple(parts))
        return self._call(found.name) if self._takes("(") else found

    def _part(self, name: str) -> Part:
        if not self._takes("["):
            return Part(name)
        subscripts = [self._subscript()]
        while self._takes(","):
            subscripts.append(self._subscript())
        self._expect("]")
        return Part(name, tuple(subscripts))

    def _subscript(self) -> Expression | None:
        is_whole = self.here == ":"
        return None if is_whole and self._take() else self.expression()

    def _call(self, name: str) -> Expression:
        arguments: list[Expression] = []
        named = []
        while not self._takes(")"):
            if self._place + 1 < len(self._tokens) and self._tokens[self._place + 1] == "=":
                argument = self._take()
                self._expect("=")
                named.append((argument, self.expression()))
            else:
                arguments.append(self.expression())
            if self.here == "for":
                return self._comprehension(name, arguments[0], ")")
            if self.here != ")":
                self._expect(",")
        return Call(name, tuple(arguments), tuple(named))
