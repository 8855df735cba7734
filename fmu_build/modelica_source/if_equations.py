"""If-equations in Modelica source: their branches and conditions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_TOKEN = re.compile(
    r"\bend\s+(?P<end>if)\b|\bend\s+(?:when|for|while)\b|'(?:[^'\\\n]|\\.)*'|"
    r"(?<![\w.])(?P<word>if|elseif|else|then|loop|initial|equation|algorithm)(?!\w)|(?P<sign>[;()\[\]{}])|\S"
)
_BEFORE_EQUATIONS = {";", "then", "else", "loop", "equation"}
_BRACKETS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


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


def if_equations(plain: str) -> Iterator[IfEquation]:
    """Yield the outermost if-equations of a text without comments and strings, and no if-statements."""
    reader = _Reader(plain)
    before, depth = "", 0
    for token in _TOKEN.finditer(plain):
        word = token["word"] or token["sign"] or ("end if" if token["end"] else "")
        if word in _BRACKETS:
            depth += _BRACKETS[word]
        elif word and not depth:
            yield from reader.take(word, token.start(), token.end(), before)
        before = word


class _Reader:
    """Reads the words outside of brackets one by one."""

    def __init__(self, plain: str) -> None:
        self._plain = plain
        self._open: list[IfEquation] = []
        self._in_equations = False
        self._in_expression = False
        self._condition: int | None = None
        """Where the condition begins that is being read."""

    def take(self, word: str, start: int, end: int, before: str) -> Iterator[IfEquation]:
        """Take the next word; yield the outermost if-equation that it ends."""
        if word in ("equation", "algorithm"):
            self._in_equations, self._in_expression = word == "equation", False
            self._open.clear()
        elif word == ";":
            self._in_expression = False
        elif not self._in_equations:
            pass
        elif word == "if":
            self._if(start, end, before)
        elif self._open and word == "end if":
            yield from self._end(start, end)
        elif self._open and not self._in_expression:
            self._branch(word, start, end)

    def _if(self, start: int, end: int, before: str) -> None:
        if self._in_expression or before not in _BEFORE_EQUATIONS:
            self._in_expression = True
        else:
            self._open.append(IfEquation(start, branches=[Branch()]))
            self._condition = end

    def _branch(self, word: str, start: int, end: int) -> None:
        innermost = self._open[-1]
        if word in ("elseif", "else"):
            innermost.branches[-1].end = start
            innermost.branches.append(Branch(start=end))
            innermost.has_else = word == "else"
            self._condition = end if word == "elseif" else None
        elif word == "then" and self._condition is not None:  # that of a when-clause ends no condition
            innermost.branches[-1].condition = self._plain[self._condition : start]
            innermost.branches[-1].start = end
            self._condition = None

    def _end(self, start: int, end: int) -> Iterator[IfEquation]:
        done = self._open.pop()
        done.branches[-1].end, done.end = start, end
        if self._open:
            self._open[-1].branches[-1].inner.append(done)
        else:
            yield done
