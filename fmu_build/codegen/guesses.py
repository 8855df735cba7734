"""Guesses for unknowns of algebraic loops, derived from the start values that the model gives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import NewtonBlock, isolate
from fmu_build.codegen.expression import Expression, Slot, number

_LARGEST = number(1e100)


def derived_guesses(
    blocks: Iterable[NewtonBlock], known: set[Slot], n_states: int
) -> Iterator[tuple[Slot, Expression]]:
    """Yield guesses for unknowns of nonlinear loops from equations that determine them.

    Example: a resistance that is a function of temperature. If its guess stays zero, the loop may have no
    Newton step. A guess reads only parameters, states, time and earlier guesses.

    Args:
        blocks: the loops
        known: slots with a start value other than the default of zero
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
            is_usable = Expression("Lt", (ex.unary("Abs", value), _LARGEST))  # false for a NaN
            yield ("y", unknown), ex.select(is_usable, value, ex.ZERO)


def _determined(
    block: NewtonBlock, waiting: list[int], readable: set[Slot]
) -> Iterator[tuple[int, Expression]]:
    """Yield unknowns that an equation of the block determines from known values only."""
    unknowns = {("y", unknown) for unknown in block.unknowns}
    for residual in block.residuals:
        read: set[Slot] = {("y", place) for place in ex.places("y", residual)}
        missing = read - readable
        if len(missing) == 1 and missing <= {("y", one) for one in waiting} and read & unknowns & readable:
            ((_, unknown),) = missing
            value = isolate(residual, ex.y(unknown))
            if value is not None:
                yield unknown, value
