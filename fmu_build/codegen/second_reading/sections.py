"""The equations of a section as trees: plain ones, connections, branches, loops, when-clauses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from fmu_build.codegen.second_reading.syntax import Section, Tokens

_OPENING: Final = {"(": ")", "[": "]", "{": "}"}
_ENDS: Final = frozenset(("elseif", "elsewhen", "else", "end"))


@dataclass(frozen=True, slots=True)
class Equation:
    """A plain equation, or an assignment, between two offsets into its file."""

    left: Tokens
    right: Tokens
    start: int
    end: int

    @property
    def results(self) -> dict[int, Tokens]:
        """What gets the results of a function in ``(a, , b) = f(x)``, by place; nothing otherwise."""
        is_tuple = self.left[:1] == ("(",) and self.left[-1:] == (")",)
        found = arguments(self.left[1:-1]) if is_tuple else ()
        return {place: one for place, one in enumerate(found) if one} if len(found) > 1 else {}


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
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Loop:
    """A for-equation with its iterators and their ranges; the first iterator begins at `start`."""

    iterators: tuple[tuple[str, Tokens], ...]
    body: tuple[Statement, ...]
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class When:
    """A when-clause: conditions with equations or statements."""

    branches: tuple[tuple[Tokens, tuple[Statement, ...]], ...]
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Call:
    """A call that is an equation or statement, as ``assert()``, between two offsets into its file."""

    name: str
    arguments: tuple[Tokens, ...]
    start: int
    end: int


Statement: TypeAlias = "Equation | Connection | Branches | Loop | When | Call"


def statements(section: Section) -> tuple[Statement, ...]:
    """Return the equations or statements of a section.

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
                yield Branches(*self._branches())
            elif self.here == "for":
                yield self._loop()
            elif self.here == "when":
                yield When(*self._branches())
            else:
                plain = self._plain()
                if plain is not None:
                    yield plain
            self._take_if(";")

    def _branches(self) -> tuple[tuple[tuple[Tokens, tuple[Statement, ...]], ...], int, int]:
        found = []
        start = self._section.places[self._place]
        while self.here != "end":
            condition = self._condition() if self._take() != "else" else ()
            self._take_if("then")
            found.append((condition, tuple(self.statements(_ENDS))))
        self._until(";")
        return tuple(found), start, self._section.places[self._place]

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
        return Loop(tuple(iterators), body, start, self._section.places[self._place])

    def _plain(self) -> Equation | Connection | Call | None:
        first = self._place
        tokens = self._until(";")
        places = self._section.places
        if tokens[:2] == ("connect", "("):
            self._place = first + 2
            one = self._until(",")
            self._take()
            other = self._until(")")
            self._until(";")
            return Connection(one, other, places[first])
        end = places[self._place]
        place = next((one for one in _outermost(tokens) if tokens[one] in ("=", ":=")), None)
        if place is not None:
            return Equation(tokens[:place], tokens[place + 1 :], places[first], end)
        if not tokens or tokens[0] == "annotation":
            return None
        if tokens == ("return",):
            return Call("return", (), places[first], end)
        if "(" not in tokens:
            raise SyntaxError(f"an equation is expected, not {tokens[0]}")
        opening = tokens.index("(")
        return Call("".join(tokens[:opening]), arguments(tokens[opening + 1 : -1]), places[first], end)

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


def has_clauses(one: Statement) -> bool:
    """Return whether a statement is a when-clause or call, or contains one."""
    if isinstance(one, Branches):
        return any(has_clauses(inner) for _, body in one.branches for inner in body)
    if isinstance(one, Loop):
        return any(map(has_clauses, one.body))
    return isinstance(one, When | Call)


def has_branches(inner: Sequence[Statement]) -> bool:
    """Return whether there is an if-equation or if-statement among statements, or in them."""
    for one in inner:
        if isinstance(one, Branches):
            return True
        bodies = [body for _, body in one.branches] if isinstance(one, When) else []
        bodies += [one.body] if isinstance(one, Loop) else []
        if any(map(has_branches, bodies)):
            return True
    return False


def arguments(tokens: Tokens) -> tuple[Tokens, ...]:
    """Return the arguments between commas."""
    commas = [place for place in _outermost(tokens) if tokens[place] == ","]
    starts = [0, *(place + 1 for place in commas)]
    return tuple(tokens[a:b] for a, b in zip(starts, [*commas, len(tokens)], strict=True))


def _outermost(tokens: Tokens) -> Iterator[int]:
    """Yield the places of the tokens outside of brackets."""
    depth = 0
    for place, token in enumerate(tokens):
        depth += (token in _OPENING) - (token in _OPENING.values())
        if not depth:
            yield place
