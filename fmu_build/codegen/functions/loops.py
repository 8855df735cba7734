"""Write C loops over the elements of arrays."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.code import FunctionCode
from fmu_build.codegen.functions.index import Index, LoopVariable, positions

_UNROLLED = 3
"""The largest number of elements that are unrolled instead of written as a loop."""

REDUCTIONS = {
    "sum": ("Add", 0.0),
    "product": ("Mul", 1.0),
    "min": ("Min", math.inf),
    "max": ("Max", -math.inf),
}
"""The operator and the initial value of each reduction."""

At = tuple[Index, ...]


class ArrayLoops:
    """Applies an action to every element: unrolled if there are few, else in loops."""

    def __init__(self, code: FunctionCode) -> None:
        self._code = code

    def for_each(self, dimensions: tuple[int, ...], action: Callable[[At], None]) -> None:
        """Write the statements of `action` for all positions."""
        if math.prod(dimensions) <= _UNROLLED:
            for position in positions(dimensions):
                action(position)
            return
        variables = [LoopVariable(self._code.name("i"), 0, dimension - 1) for dimension in dimensions]
        for loop in variables:
            self._code.open(f"for (int {loop.name} = 0; {loop.name} <= {loop.maximum}; ++{loop.name})")
        action(tuple(Index.of(variable) for variable in variables))
        for variable in variables:
            self._code.close()
            self._code.release(variable.name)

    def copy(self, target: str, source: str, size: int) -> None:
        """Copy a whole array to another."""

        def assign(at: At) -> None:
            self._code.assign(f"{target}[{at[0].text()}]", self._code.variable(f"{source}[{at[0].text()}]"))

        self.for_each((size,), assign)

    def reduced(
        self, reduction: str, dimensions: tuple[int, ...], term: Callable[[At], Expression]
    ) -> Expression:
        """Return the sum, product, minimum or maximum of the terms at all positions."""
        operator, start = REDUCTIONS[reduction]
        if math.prod(dimensions) <= _UNROLLED:
            terms = [term(position) for position in positions(dimensions)] or [ex.number(start)]
            return functools.reduce(lambda a, b: ex.binary(operator, a, b), terms)
        name = self._code.name(reduction)
        total = self._code.variable(name)
        self._code.define(name, ex.number(start), is_constant=False)

        def add(position: At) -> None:
            self._code.assign(name, ex.binary(operator, total, term(position)))

        self.for_each(dimensions, add)
        return total
