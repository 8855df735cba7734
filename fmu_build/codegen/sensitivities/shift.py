"""Make room for additional states by moving the algebraic variables of a model back in y."""

from __future__ import annotations

from dataclasses import replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step
from fmu_build.codegen.compact import changed
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Slot


def with_room(equations: Equations, n: int) -> Equations:
    """Return the same equations with every algebraic variable `n` places further back in y."""
    first = equations.n_states
    moved = {ex.y(i): ex.y(i + n) for i in range(first, equations.n_y)}

    def slot(old: Slot) -> Slot:
        return shifted(old, first, n)

    equations = changed(equations, lambda e: ex.substitute(e, moved))
    return replace(
        equations,
        n_y=equations.n_y + n,
        algebraics=tuple(_step(step, n) for step in equations.algebraics),
        discrete=tuple(replace(row, slot=slot(row.slot)) for row in equations.discrete),
        pre=tuple((index, slot(source)) for index, source in equations.pre),
        start_values=tuple((slot(old), value) for old, value in equations.start_values),
        guesses=tuple((slot(old), value) for old, value in equations.guesses),
        initial_unknowns=tuple(map(slot, equations.initial_unknowns)),
    )


def shifted(slot: Slot, n_states: int, n: int) -> Slot:
    """Return the position of a slot after `with_room`."""
    return (slot[0], slot[1] + n) if slot[0] == "y" and slot[1] >= n_states else slot


def _step(step: Step, n: int) -> Step:
    if isinstance(step, Assignment):
        return replace(step, unknown=step.unknown + n)
    return NewtonBlock(tuple(unknown + n for unknown in step.unknowns), step.residuals, step.jacobian)
