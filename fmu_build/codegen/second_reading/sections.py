"""The equations of a section as trees: plain ones, connections, branches, loops, when-clauses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, TypeAlias

from fmu_build.codegen.second_reading.syntax import Section, Tokens

_OPENING: Final = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True, slots=True)
class Equation:
    """A plain equation, between two offsets into its file."""

    tokens: Tokens
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Connection:
    """``connect(first, second)``."""

    first: Tokens
    second: Tokens
    start: int


@dataclass(frozen=True, slots=True)
class Branches:
    """An if-equation: conditions with equations; the condition of ``else`` is empty."""

    branches: tuple[tuple[Tokens, tuple[Statement, ...]], ...]


@dataclass(frozen=True, slots=True)
class Loop:
    """A for-equation with its iterators and their ranges; the first iterator begins at `start`."""

    iterators: tuple[tuple[str, Tokens], ...]
    body: tuple[Statement, ...]
    start: int


@dataclass(frozen=True, slots=True)
class When:
    """A when-clause, between two offsets into its file."""

    start: int
    end: int


Statement: TypeAlias = "Equation | Connection | Branches | Loop | When"


def statements(section: Section) -> tuple[Statement, ...]:
    """Return the equations of a section without its calls.

    Raises `SyntaxError` if one is not understood.
    """
    reader = _Reader(section)
    found = tuple(reader.statements(frozenset()))
    if reader.here:
        raise SyntaxError(f"an equation is expected, not {reader.here}")
    return found


class _Reader:
    def __init__(self, section: Section) -> None:
        self._section = section
        self._place = 0

    @property
    def here(self) -> str:
        tokens = self._section.tokens
        return tokens[self._place] if self._place < len(tokens) else ""

    def statements(self, ends: frozenset[str]) -> Iterator[Statement]:
        """Yield the equations up to one of these words."""
        while self.here and self.here not in ends:
            if self.here == "if":
                yield self._branches()
            elif self.here == "for":
                yield self._loop()
            elif self.here == "when":
                yield self._when()
            else:
                yield from self._plain()
            self._take_if(";")

    def _branches(self) -> Branches:
        found = []
        while self.here != "end":
            condition = self._condition() if self._take() != "else" else ()
            self._take_if("then")
            found.append((condition, tuple(self.statements(frozenset(("elseif", "else", "end"))))))
        self._until(";")
        return Branches(tuple(found))

    def _condition(self) -> Tokens:
        """The tokens up to the ``then`` of the equation, with those of if-expressions."""
        first, thens = self._place, 1
        while True:
            self._until("if", "elseif", "then")
            thens += -1 if self.here == "then" else 1
            if not thens:
                return self._section.tokens[first : self._place]
            self._take()

    def _loop(self) -> Loop:
        iterators = []
        start = self._section.places[self._place + 1]
        while self._take() != "loop":
            name = self._take()
            if self._take() != "in":
                raise SyntaxError(f"the iterator {name} has no range")
            iterators.append((name, self._until("loop", ",")))
        body = tuple(self.statements(frozenset(("end",))))
        self._until(";")
        return Loop(tuple(iterators), body, start)

    def _when(self) -> When:
        start = self._section.places[self._place]
        while self._take() != "end" or self.here != "when":
            self._until("end")
        self._until(";")
        return When(start, self._section.places[self._place])

    def _plain(self) -> Iterator[Equation | Connection]:
        first = self._place
        tokens = self._until(";")
        places = self._section.places
        if tokens[:2] == ("connect", "("):
            self._place = first + 2
            one = self._until(",")
            self._take()
            other = self._until(")")
            self._until(";")
            yield Connection(one, other, places[first])
        elif "=" in _outermost(tokens):
            yield Equation(tokens, places[first], places[self._place])

    def _until(self, *ends: str) -> Tokens:
        """Take the tokens up to one of these outside of brackets."""
        first = self._place
        closing: list[str] = []
        while closing or self.here not in ends:
            token = self._take()
            if token in _OPENING:
                closing.append(_OPENING[token])
            elif closing and token == closing[-1]:
                closing.pop()
        return self._section.tokens[first : self._place]

    def _take_if(self, token: str) -> None:
        if self.here == token:
            self._place += 1

    def _take(self) -> str:
        if not self.here:
            raise SyntaxError("the section ends within an equation")
        self._place += 1
        return self._section.tokens[self._place - 1]


def _outermost(tokens: Tokens) -> Iterator[str]:
    """Yield the tokens outside of brackets."""
    depth = 0
    for token in tokens:
        depth += (token in _OPENING) - (token in _OPENING.values())
        if not depth:
            yield token
