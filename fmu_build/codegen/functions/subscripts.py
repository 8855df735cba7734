"""Subscripts in bodies of Modelica functions: positions in C arrays, checked if they may be out of bounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.code import FunctionCode, twin
from fmu_build.codegen.functions.dae import FunctionDae
from fmu_build.codegen.functions.index import Index, Position, flat

HELPERS = {
    "at": """/* The element of an array that Modelica counts from one; NaN beyond its bounds. */
static double at(const double *array, int size, double index)
{
    return index >= 1.0 && index <= size ? array[(int)index - 1] : NAN;
}
""",
    "put": """/* array[index] = value, counted from one; beyond the bounds all elements become NaN. */
static void put(double *array, int size, double index, double value)
{
    if (index >= 1.0 && index <= size) {
        array[(int)index - 1] = value;
    } else {
        for (int i = 0; i < size; ++i) array[i] = NAN;
    }
}
""",
    "within": """/* An index of one of several dimensions; NaN beyond its bounds. */
static double within(double index, int size)
{
    return index >= 1.0 && index <= size ? index : NAN;
}
""",
}
"""C helper functions by name."""


class Subscripts:
    """Resolves subscripts to positions; `element` returns an element of an expression."""

    def __init__(
        self, dae: FunctionDae, code: FunctionCode, element: Callable[[int, tuple[Position, ...]], Expression]
    ) -> None:
        self.binders: dict[tuple[int, int], Index] = {}
        self._dae = dae
        self._code = code
        self._element = element

    def read(
        self, name: str, dimensions: tuple[int, ...], at: tuple[Position, ...], offset: int = 0
    ) -> Expression:
        """Return an element of an array that begins at `offset` of a C array, or a scalar C variable."""
        place = self._place(dimensions, at)
        if isinstance(place, Index):
            return self._code.variable(f"{name}[{(place + offset).text()}]" if dimensions else name)
        array = f"{name} + {offset}" if offset else name
        where = f"{math.prod(dimensions)}, {self._code.text(place)}"
        return self._code.leaf(f"at({array}, {where})", lambda: f"at({twin(array)}, {where})", is_costly=True)

    def store(
        self, name: str, dimensions: tuple[int, ...], at: tuple[Position, ...], value: Expression
    ) -> None:
        """Write the assignment to an element."""
        place = self._place(dimensions, at)
        if isinstance(place, Index):
            self._code.assign(f"{name}[{place.text()}]", value)
        else:
            self._code.put(name, math.prod(dimensions), place, value)

    def _place(self, dimensions: tuple[int, ...], at: tuple[Position, ...]) -> Position:
        """Return the row-major position of an element."""
        indices = tuple(position for position in at if isinstance(position, Index))
        if len(indices) == len(at):
            return flat(indices, dimensions)
        total: Expression = ex.ONE
        for position, dimension in zip(at, dimensions, strict=True):
            one_based = self.value(position)
            if len(dimensions) > 1 and isinstance(position, Expression):
                one_based = self._code.leaf(
                    f"within({self._code.text(position)}, {dimension})", is_costly=True
                )
            rows = ex.binary("Mul", ex.number(dimension), ex.binary("Sub", total, ex.ONE))
            total = ex.binary("Add", rows, one_based)
        return total

    def value(self, position: Position) -> Expression:
        """Return a position as a one-based expression."""
        return self._code.index_value(position + 1) if isinstance(position, Index) else position

    def base_positions(
        self, subscripts: Sequence[Mapping[str, Any]], dimensions: tuple[int, ...], at: tuple[Position, ...]
    ) -> tuple[Position, ...]:
        """Return the position in ``a``, which has `dimensions`, of the element `at` of ``a[subscripts]``."""
        rest = list(at)
        result: list[Position] = []
        for place, dimension in enumerate(dimensions):
            subscript = subscripts[place] if place < len(subscripts) else None
            if subscript is None or subscript["kind"] == "whole":
                result.append(rest.pop(0))
                continue
            number = subscript["expression"]
            inner = (rest.pop(0),) if subscript["kind"] == "slice" else ()
            index = self.integer(number, inner)
            if index is None:
                result.append(self._element(number, inner))
            elif (index + -1).lies_in(dimension):
                result.append(index + -1)
            elif index.is_constant:
                raise self._dae.unsupported(
                    f"index {index.constant} of an array with {dimension} elements", number
                )
            else:
                result.append(self._code.index_value(index))
        return tuple(result)

    def integer(self, number: int, at: tuple[Position, ...]) -> Index | None:
        """Return the value of an Integer expression if it is affine in loop variables, else None."""
        operation = self._dae.operation(number)
        match operation["kind"]:
            case "literal" if "integer" in operation["value"]:
                return Index(int(operation["value"]["integer"]))
            case "coordinate" if operation["coordinate"]["kind"] == "binder":
                coordinate = operation["coordinate"]
                return self.binders.get((coordinate["domain"], coordinate["ordinal"]))
            case "unary" if operation["operator"] == "negate":
                inner = self.integer(operation["operand"], at)
                return None if inner is None else inner * -1
            case "binary" if operation["operator"] in ("add", "subtract", "multiply"):
                return self._sum_or_product(operation, at)
            case "builtin" if operation["builtin"] == "size" and len(operation["arguments"]) == 2:
                return self._size(operation)
            case "range" if isinstance(at[0], Index):
                return _in_range(operation, at[0])
            case "array" if isinstance(at[0], Index) and at[0].is_constant:
                return self.integer(operation["elements"][at[0].constant], at[1:])
        return None

    def _sum_or_product(self, operation: Mapping[str, Any], at: tuple[Position, ...]) -> Index | None:
        if self._dae.dimensions(operation["lhs"]) or self._dae.dimensions(operation["rhs"]):
            return None
        a, b = (self.integer(operation[side], at) for side in ("lhs", "rhs"))
        if a is None or b is None:
            return None
        if operation["operator"] != "multiply":
            return a + b * (1 if operation["operator"] == "add" else -1)
        if b.is_constant:
            return a * b.constant
        return b * a.constant if a.is_constant else None

    def _size(self, operation: Mapping[str, Any]) -> Index | None:
        array, axis = operation["arguments"]
        place = self.integer(axis, ())
        if place is None or not place.is_constant:
            return None
        return Index(self._dae.dimensions(array)[place.constant - 1])


def _in_range(operation: Mapping[str, Any], place: Index) -> Index | None:
    """Return the number at a position of ``start:step:stop`` if start and step are constant, else None."""
    start, step = operation["start"]["value"], operation["explicit_step"]
    increment = 1 if step is None else step["value"]
    if not isinstance(start, int) or not isinstance(increment, int):
        return None
    return place * increment + start
