"""The lines of a C function, with forward-mode tangents on request.

With tangents, every variable ``x`` has a twin ``d_x``, set just before it: the derivative of its value in the
direction given by the twins of the inputs.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen import expression as ex
from fmu_build.codegen.c_expression import Writer
from fmu_build.codegen.differentiate import differentiate
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.index import Index

_WORTH_A_VARIABLE = 6
"""Smallest number of nodes for which a common subexpression of a statement becomes a variable."""

_RESERVED = """
    auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile
    while bool true false result sign fabs sqrt exp log log10 sin cos tan asin acos atan sinh cosh tanh floor
    ceil trunc pow atan2 fmin fmax at put within NAN INFINITY NULL EOF BUFSIZ HUGE_VAL
"""
"""Names that are valid in Modelica but have another meaning in the C code."""


def twin(text: str) -> str:
    """Return the C name of the tangent of a variable or array element."""
    return f"d_{text}"


@dataclass(frozen=True, slots=True)
class _Line:
    text: str
    sets: str | None
    """The variable that the line declares or sets, if it has no other effect."""


class FunctionCode:
    """Lines with their indentation, names in use, and values with a C text."""

    def __init__(self, with_tangents: bool = False) -> None:
        self.with_tangents = with_tangents
        self._lines: list[_Line] = []
        self._tangents = _Tangents()
        self._depth = 0
        self._taken: set[str] = set(_RESERVED.split())
        self._texts: dict[Expression, str] = {}
        self._leaves: dict[str, Expression] = {}
        self._costly: set[Expression] = set()
        self._called: dict[str, str] = {}

    def name(self, wanted: str) -> str:
        """Return a C identifier like `wanted` that is unique in the function."""
        base = re.sub(r"\W+", "_", wanted.removeprefix("__rumoca_")).strip("_") or "value"
        base = base if not base[0].isdigit() else f"n{base}"
        candidate, number = base, 2
        while not self._taken.isdisjoint(self._with_twin(candidate)):
            candidate, number = f"{base}_{number}", number + 1
        self._taken.update(self._with_twin(candidate))
        return candidate

    def release(self, name: str) -> None:
        """Allow another scope to reuse the name."""
        self._taken.difference_update(self._with_twin(name))

    def _with_twin(self, name: str) -> tuple[str, ...]:
        return (name, twin(name)) if self.with_tangents else (name,)

    def leaf(
        self, text: str, tangent: Callable[[], str] | None = None, is_costly: bool = False
    ) -> Expression:
        """Return a leaf written in C as `text`, which binds like a name; a costly one is computed once.

        `tangent` returns the C text of its tangent; a leaf without one, such as a loop variable, is constant.
        """
        if text not in self._leaves:
            leaf = Expression("text", payload=len(self._leaves))
            self._leaves[text] = leaf
            self._texts[leaf] = text
            if is_costly:
                self._costly.add(leaf)
        if tangent is not None:
            self._tangents.makers[self._leaves[text]] = lambda: self.leaf(tangent(), is_costly=is_costly)
        return self._leaves[text]

    def variable(self, text: str) -> Expression:
        """Return the leaf for a variable, or for an array element at a known position."""
        return self.leaf(text, lambda: twin(text))

    def tangent(self, value: Expression) -> Expression:
        """Return the tangent of a value."""
        return differentiate(value, self._tangents)

    def index_value(self, index: Index) -> Expression:
        """Return the value of an index as a double."""
        total = ex.number(index.constant)
        for variable, factor in reversed(index.terms):
            term = ex.binary("Mul", ex.number(factor), self.leaf(f"(double){variable.name}"))
            total = ex.binary("Add", term, total)
        return total

    def text(self, node: Expression) -> str:
        """Return the C text of a value, after appending lines for its large common subexpressions."""
        names = dict(self._texts)
        uses = Counter(argument for part in ex.walk(node) for argument in part.arguments)
        sizes: dict[Expression, int] = {}
        for part in ex.walk(node):
            sizes[part] = 1 + sum(sizes[argument] for argument in part.arguments)
            if uses[part] > 1 and (sizes[part] >= _WORTH_A_VARIABLE or part in self._costly):
                name = self.name("t")
                self.line(f"const double {name} = {Writer(names).text(part)};", sets=name)
                names[part] = name
                sizes[part] = 1
        return Writer(names).text(node)

    def condition(self, node: Expression) -> str:
        """Return the C text of a truth value as a condition."""
        text = self.text(node)
        return text if node.operator in ex.TRUTH else f"{text} != 0.0"

    def declare(self, name: str, size: int | None = None) -> None:
        """Declare a variable, or an array of `size` elements, without a value."""
        for each in self._with_twin(name):
            self.line(f"double {each};" if size is None else f"double {each}[{size}];", sets=each)

    def define(self, name: str, value: Expression, is_constant: bool = True) -> None:
        """Define a variable with its value."""
        self._set(name, value, "const double " if is_constant else "double ")

    def define_array(self, name: str, values: Sequence[Expression], is_constant: bool = True) -> None:
        """Define an array with the values of its elements."""
        kind = "const double" if is_constant else "double"
        texts = {name: [self.text(value) for value in values]}
        if self.with_tangents:
            texts[twin(name)] = [self.text(self.tangent(value)) for value in values]
        for each, elements in texts.items():
            self.line(f"{kind} {each}[{len(elements)}] = {{{', '.join(elements)}}};", sets=each)

    def assign(self, target: str, value: Expression) -> None:
        """Assign to a variable, or to an array element at a known position."""
        self._set(target, value, "")

    def _set(self, target: str, value: Expression, declaration: str) -> None:
        if self.with_tangents:
            tangent = self.text(self.tangent(value))
            if tangent != twin(target):
                self.line(f"{declaration}{twin(target)} = {tangent};", sets=twin(target).partition("[")[0])
        self.line(f"{declaration}{target} = {self.text(value)};", sets=target.partition("[")[0])

    def put(self, array: str, size: int, place: Expression, value: Expression) -> None:
        """Assign to an array element whose one-based position is known only at run time."""
        where = self.text(place)
        if self.with_tangents:
            tangent = self.text(self.tangent(value))
            self.line(f"put({twin(array)}, {size}, {where}, {tangent});", sets=twin(array))
        self.line(f"put({array}, {size}, {where}, {self.text(value)});", sets=array)

    def result(self, place: str, value: Expression) -> None:
        """Store one of several results of the function, or its tangent."""
        self.line(f"result[{place}] = {self.text(self.tangent(value) if self.with_tangents else value)};")

    def results(self, call: Callable[[str], str], tangent_call: Callable[[str], str], size: int) -> str:
        """Return the name of an array with the results of a call; both callables take that name."""
        key = call("")
        if key not in self._called:
            name = self._called[key] = self.name("r")
            self.declare(name, size)
            self.store_results(name, call, tangent_call)
        return self._called[key]

    def store_results(
        self, name: str, call: Callable[[str], str], tangent_call: Callable[[str], str]
    ) -> None:
        """Write a call that stores its results in an array."""
        if self.with_tangents:
            self.line(f"{tangent_call(twin(name))};", sets=twin(name))
        self.line(f"{call(name)};", sets=name)

    def new_statement(self) -> None:
        """Forget the results of calls: variables may change between statements."""
        self._called.clear()

    def line(self, text: str, sets: str | None = None) -> None:
        """Append an indented line; `sets` is the variable that it sets, if that is its only effect."""
        self._lines.append(_Line("    " * self._depth + text, sets))

    @property
    def lines(self) -> list[str]:
        """The function's lines; with tangents, after dead code elimination."""
        lines = self._lines
        while self.with_tangents:
            idle = {line.sets for line in lines} - {None} - _read(lines)
            kept = _without_empty_blocks([line for line in lines if line.sets not in idle])
            if len(kept) == len(lines):
                break
            lines = kept
        return [line.text for line in lines]

    def open(self, head: str) -> None:
        """Begin a block after `head`."""
        self.line(f"{head} {{")
        self._depth += 1
        self.new_statement()

    def close(self, tail: str = "") -> None:
        """End a block; `tail` follows its brace and may open the next block (``else {``)."""
        self._depth -= 1
        self.line(f"}} {tail}".rstrip())
        if tail:
            self._depth += 1
        self.new_statement()


def _read(lines: Sequence[_Line]) -> set[str | None]:
    """Return the names that lines mention, except the variable that each line sets."""
    names: set[str | None] = set()
    for line in lines:
        names.update(name for name in re.findall(r"[A-Za-z_]\w*", line.text) if name != line.sets)
    return names


def _without_empty_blocks(lines: Sequence[_Line]) -> list[_Line]:
    kept: list[_Line] = []
    for line in lines:
        is_empty = bool(kept) and kept[-1].text.endswith("{") and line.text.strip() == "}"
        if not is_empty:
            kept.append(line)
        elif kept[-1].text.strip().startswith("}"):
            kept[-1] = line  # an empty else branch
        else:
            kept.pop()
    return kept


class _Tangents(Mapping[Expression, Expression]):
    """The tangents of leaves, created on demand because creating one may append lines."""

    def __init__(self) -> None:
        self.makers: dict[Expression, Callable[[], Expression]] = {}

    def __getitem__(self, leaf: Expression) -> Expression:
        return self.makers[leaf]()

    def __contains__(self, leaf: object) -> bool:
        return leaf in self.makers

    def __iter__(self) -> Iterator[Expression]:
        return iter(self.makers)

    def __len__(self) -> int:
        return len(self.makers)
