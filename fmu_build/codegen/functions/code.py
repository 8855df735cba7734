"""The lines of a C function while they are collected."""

from __future__ import annotations

import re
from collections import Counter

from fmu_build.codegen import expression as ex
from fmu_build.codegen.c_expression import Writer
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.index import Index

_WORTH_A_VARIABLE = 6
"""Operations from which on a part that occurs twice in a statement is computed once."""

_RESERVED = """
    auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile
    while bool true false result sign fabs sqrt exp log log10 sin cos tan asin acos atan sinh cosh tanh floor
    ceil trunc pow atan2 fmin fmax at put within NAN INFINITY NULL EOF BUFSIZ HUGE_VAL
"""
"""Names that a Modelica variable may have but that mean something else in the C code."""


class FunctionCode:
    """Lines with their indentation, names that are in use, and values that have a C text already."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._depth = 0
        self._taken: set[str] = set(_RESERVED.split())
        self._texts: dict[Expression, str] = {}
        self._leaves: dict[str, Expression] = {}
        self._costly: set[Expression] = set()
        self._called: dict[str, str] = {}

    def name(self, wanted: str) -> str:
        """A C identifier like `wanted` that nothing else in the function has."""
        base = re.sub(r"\W+", "_", wanted.removeprefix("__rumoca_")).strip("_") or "value"
        base = base if not base[0].isdigit() else f"n{base}"
        candidate, number = base, 2
        while candidate in self._taken:
            candidate, number = f"{base}_{number}", number + 1
        self._taken.add(candidate)
        return candidate

    def release(self, name: str) -> None:
        """Let another variable in another scope have the name."""
        self._taken.discard(name)

    def leaf(self, text: str, is_costly: bool = False) -> Expression:
        """A value that stands in C as `text`, which binds like a name; a costly one is computed once."""
        if text not in self._leaves:
            leaf = Expression("text", payload=len(self._leaves))
            self._leaves[text] = leaf
            self._texts[leaf] = text
            if is_costly:
                self._costly.add(leaf)
        return self._leaves[text]

    def index_value(self, index: Index) -> Expression:
        """The value of an index as a double."""
        total = ex.number(index.constant)
        for variable, factor in reversed(index.terms):
            term = ex.binary("Mul", ex.number(factor), self.leaf(f"(double){variable.name}"))
            total = ex.binary("Add", term, total)
        return total

    def text(self, node: Expression) -> str:
        """The C text of a value, after lines that compute large parts which it has twice."""
        names = dict(self._texts)
        uses = Counter(argument for part in ex.walk(node) for argument in part.arguments)
        sizes: dict[Expression, int] = {}
        for part in ex.walk(node):
            sizes[part] = 1 + sum(sizes[argument] for argument in part.arguments)
            if uses[part] > 1 and (sizes[part] >= _WORTH_A_VARIABLE or part in self._costly):
                name = self.name("t")
                self.line(f"const double {name} = {Writer(names).text(part)};")
                names[part] = name
                sizes[part] = 1
        return Writer(names).text(node)

    def condition(self, node: Expression) -> str:
        """The C text of a truth value as a condition."""
        text = self.text(node)
        return text if node.operator in ex.TRUTH else f"{text} != 0.0"

    def results(self, call: str, placeholder: str, size: int) -> str:
        """The array with the results of a call; its name replaces the placeholder in the text of the call."""
        if call not in self._called:
            name = self._called[call] = self.name("r")
            self.line(f"double {name}[{size}];")
            self.line(f"{call.replace(placeholder, name)};")
        return self._called[call]

    def new_statement(self) -> None:
        """Results of calls are not used again: variables may have changed."""
        self._called.clear()

    def line(self, text: str) -> None:
        """A line at the present indentation."""
        self.lines.append("    " * self._depth + text)

    def open(self, head: str) -> None:
        """Begin a block after `head`."""
        self.line(f"{head} {{")
        self._depth += 1
        self.new_statement()

    def close(self, tail: str = "") -> None:
        """End a block; `tail` is what follows its brace, such as ``else {``, which opens the next one."""
        self._depth -= 1
        self.line(f"}} {tail}".rstrip())
        if tail:
            self._depth += 1
        self.new_statement()
