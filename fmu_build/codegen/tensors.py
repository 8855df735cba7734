"""Operations of the Solve IR on ranges of registers, spelled out element by element."""

from __future__ import annotations

import math
from collections.abc import Mapping, MutableMapping
from functools import reduce
from itertools import product
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import ONE, ZERO, Expression, binary

Fields = Mapping[str, Any]
Registers = MutableMapping[int, Expression]


def load(fields: Fields, registers: Registers) -> None:
    """A range of y or p."""
    leaf = ex.y if fields["input"] == "Y" else ex.p
    for i in range(fields["count"]):
        registers[fields["dst_start"] + i] = leaf(fields["input_start"] + i)


def elementwise(fields: Fields, registers: Registers) -> None:
    """An operator between two arrays, or an array and a scalar (stride 0)."""
    for i in range(fields["count"]):
        a = registers[fields["lhs_start"] + i * fields["lhs_stride"]]
        b = registers[fields["rhs_start"] + i * fields["rhs_stride"]]
        registers[fields["dst_start"] + i] = binary(fields["op"], a, b)


def matrix_product(fields: Fields, registers: Registers) -> None:
    """Row-major matrices, rows by inner and inner by columns."""
    rows, inner, columns = fields["rows"], fields["inner"], fields["columns"]
    for i, j in product(range(rows), range(columns)):
        terms = (
            binary(
                "Mul",
                registers[fields["lhs_start"] + i * inner + k],
                registers[fields["rhs_start"] + k * columns + j],
            )
            for k in range(inner)
        )
        registers[fields["dst_start"] + i * columns + j] = reduce(
            lambda total, term: binary("Add", total, term), terms, ZERO
        )


def transposed(fields: Fields, registers: Registers) -> None:
    """A row-major matrix of elements of `element_width` scalars each; the shape given is the result's."""
    rows, columns, width = fields["rows"], fields["columns"], fields["element_width"]
    for i, j, k in product(range(rows), range(columns), range(width)):
        source = fields["src_start"] + (j * rows + i) * width + k
        registers[fields["dst_start"] + (i * columns + j) * width + k] = registers[source]


def filled(fields: Fields, registers: Registers) -> None:
    """``fill(value, ...)``."""
    for i in range(fields["count"]):
        registers[fields["dst_start"] + i] = registers[fields["value_start"]]


def concatenated(fields: Fields, registers: Registers) -> None:
    """``cat(axis + 1, ...)`` of row-major arrays."""
    axis = fields["axis"]
    outer = math.prod(fields["dimensions"][:axis])
    position = fields["dst_start"]
    for i in range(outer):
        for source in fields["sources"]:
            length = math.prod(source["dimensions"][axis:])
            for k in range(length):
                registers[position] = registers[source["start"] + i * length + k]
                position += 1


def element(fields: Fields, registers: Registers) -> Expression:
    """``array[i, j, ...]``; NaN where an index that is known at run time only lies outside of its bounds."""
    chosen = ex.number(math.nan)
    places = product(*(range(size) for size in fields["dimensions"]))
    for offset, place in reversed(list(enumerate(places))):
        here: Expression = ONE
        for index, position in zip(fields["indices"], place, strict=True):
            here = binary("And", here, _is_at(index, position, registers))
        chosen = ex.select(here, registers[fields["base"] + offset * fields["stride"]], chosen)
    return chosen


def _is_at(index: Fields, position: int, registers: Registers) -> Expression:
    """Whether an index has a position, counted from 0; run-time indices count from 1, as Modelica's do."""
    ((kind, value),) = index.items()
    if kind == "Runtime":
        return Expression("Eq", (registers[value], ex.number(position + 1)))
    return ONE if value == position else ZERO
