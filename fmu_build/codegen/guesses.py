"""Guesses for the unknowns of algebraic loops that follow from those that the model gives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import NewtonBlock, isolate
from fmu_build.codegen.expression import Expression, Slot, number

_LARGEST = number(1e100)


def derived_guesses(
    blocks: Iterable[NewtonBlock], known: set[Slot], n_states: int
) -> Iterator[tuple[Slot, Expression]]:
    """Yield guesses for unknowns of nonlinear loops by the equations that determine them from known ones.

    A resistance that follows from a temperature is not zero if the temperature is not: from a start at zero a
    loop with such a resistance has no Newton step. Each guess reads parameters, states, time, earlier ones.

    Args:
        blocks: the loops
        known: slots whose start value is more than the default of zero
        n_states: the slots of y below are states
    """
    for block in blocks:
        if block.is_linear:
            continue
        readable: set[Slot] = known | {("y", state) for state in range(n_states)}
        waiting = [unknown for unknown in block.unknowns if ("y", unknown) not in known]
        while True:
            found = next(_determined(block, waiting, readable), None)
            if found is None:
                break
            unknown, value = found
            waiting.remove(unknown)
            readable.add(("y", unknown))
            is_usable = Expression("Lt", (ex.unary("Abs", value), _LARGEST))  # not so for a NaN
            yield ("y", unknown), ex.select(is_usable, value, ex.ZERO)


def _determined(
    block: NewtonBlock, waiting: list[int], readable: set[Slot]
) -> Iterator[tuple[int, Expression]]:
    """Yield unknowns that an equation of the block determines from other unknowns, all of them known."""
    unknowns = {("y", unknown) for unknown in block.unknowns}
    for residual in block.residuals:
        read: set[Slot] = {("y", place) for place in ex.places("y", residual)}
        missing = read - readable
        if len(missing) == 1 and missing <= {("y", one) for one in waiting} and read & unknowns & readable:
            ((_, unknown),) = missing
            value = isolate(residual, ex.y(unknown))
            if value is not None:
                yield unknown, value
