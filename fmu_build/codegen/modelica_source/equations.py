"""Equations in Modelica source that rumoca may drop: parts of if-equations, and calls that are equations."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

_TOKEN = re.compile(
    r"\bend\s+(?P<end>if|when|for|while)\b|'(?:[^'\\\n]|\\.)*'|"
    r"(?<![\w.])(?P<word>if|elseif|else|then|loop|when|equation|algorithm)(?!\w)|"
    r"(?<![\w.])(?P<called>[A-Za-z_]\w*(?:\s*\.\s*\w+)*)(?=\s*\()|(?P<sign>[;()\[\]{}])|\w+|\S"
)
_BEFORE_EQUATIONS = {";", "then", "else", "loop", "equation"}
_BRACKETS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


class Call(NamedTuple):
    """A call that is an equation, such as ``f(x);``, by offsets into the text."""

    name: str
    start: int
    end: int


@dataclass(slots=True)
class Branch:
    """One branch: its condition (empty for ``else``), and the offsets of its equations and inner ifs."""

    condition: str = ""
    start: int = 0
    end: int = 0
    inner: list[IfEquation] = field(default_factory=list)


@dataclass(slots=True)
class IfEquation:
    """An if-equation, from ``if`` to ``end if``, by offsets into the text."""

    start: int
    end: int = 0
    has_else: bool = False
    branches: list[Branch] = field(default_factory=list)


def equations(plain: str) -> Iterator[IfEquation | Call]:
    """Yield the outermost if-equations, and the calls outside of when-clauses that are equations.

    The text has no comments and strings. Statements of algorithms are left out.
    """
    reader = _Reader(plain)
    depth = 0
    for token in _TOKEN.finditer(plain):
        if token["sign"] in _BRACKETS:
            depth += _BRACKETS[token["sign"]]
        elif not depth:
            yield from reader.take(token)


class _Reader:
    """Reads the tokens outside of brackets one by one."""

    def __init__(self, plain: str) -> None:
        self._plain = plain
        self._open: list[IfEquation] = []
        self._in_equations = False
        self._in_when = False
        self._in_expression = False
        self._condition: int | None = None
        """Where the condition begins that is being read."""
        self._before = ""
        self._call: re.Match[str] | None = None
        """The call that is the whole equation if it ends with the next token."""

    def take(self, token: re.Match[str]) -> Iterator[IfEquation | Call]:
        """Take the next token; yield what it completes."""
        word = token["word"] or token["sign"] or (f"end {token['end']}" if token["end"] else "")
        call, self._call = self._call, None
        is_first = self._before in _BEFORE_EQUATIONS and not self._in_expression
        self._before = word
        if word in ("equation", "algorithm"):
            self._in_equations = word == "equation"
            self._in_when = self._in_expression = False
            self._open.clear()
        elif word == ";":
            self._in_expression = False
            if call is not None:
                yield Call("".join(call["called"].split()), call.start(), token.start())
        elif self._in_equations:
            yield from self._in_equation(word, token, is_first=is_first)

    def _in_equation(self, word: str, token: re.Match[str], *, is_first: bool) -> Iterator[IfEquation]:
        if token["called"] and is_first and not self._in_when:
            self._call = token
        elif word == "if":
            self._if(token, is_first=is_first)
        elif word == "end if" and self._open:
            yield from self._end(token)
        elif word in ("when", "end when"):
            self._in_when = word == "when"
        elif self._open and not self._in_expression:
            self._branch(word, token)

    def _if(self, token: re.Match[str], *, is_first: bool) -> None:
        if is_first:
            self._open.append(IfEquation(token.start(), branches=[Branch()]))
            self._condition = token.end()
        else:
            self._in_expression = True

    def _branch(self, word: str, token: re.Match[str]) -> None:
        innermost = self._open[-1]
        if word in ("elseif", "else"):
            innermost.branches[-1].end = token.start()
            innermost.branches.append(Branch(start=token.end()))
            innermost.has_else = word == "else"
            self._condition = token.end() if word == "elseif" else None
        elif word == "then" and self._condition is not None:  # that of a when-clause ends no condition
            innermost.branches[-1].condition = self._plain[self._condition : token.start()]
            innermost.branches[-1].start = token.end()
            self._condition = None

    def _end(self, token: re.Match[str]) -> Iterator[IfEquation]:
        done = self._open.pop()
        done.branches[-1].end, done.end = token.start(), token.end()
        if self._open:
            self._open[-1].branches[-1].inner.append(done)
        else:
            yield done
