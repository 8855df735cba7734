"""Drop tangents that nothing reads: most algebraic variables exist only to be looked at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, Step, needed
from fmu_build.codegen.compact import changed
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Slot, leaf


def without_unused(
    equations: Equations, n_old: int, outputs: Sequence[int]
) -> tuple[Equations, dict[int, int]]:
    """Drop algebraic variables from number `n_old` on that nothing reads, except `outputs`.

    Returns the equations and the new numbers of the remaining variables.
    """
    assert equations.sensitivities is not None
    wanted = (
        *equations.derivatives,
        *equations.sensitivities.root_rates,
        *(row.value for row in equations.discrete),
        *equations.initial_residuals,
        *(leaf(source) for _, source in equations.pre),
        *(ex.y(index) for index in (*range(n_old), *outputs)),
    )
    steps: tuple[Step, ...] = needed(equations.algebraics, wanted)
    kept = sorted(unknown for step in steps for unknown in step.unknowns if unknown >= n_old)
    numbers = {old: n_old + number for number, old in enumerate(kept)}
    moved = {ex.y(old): ex.y(new) for old, new in numbers.items() if old != new}
    equations = changed(replace(equations, algebraics=steps), lambda e: ex.substitute(e, moved))
    return (
        replace(
            equations,
            n_y=n_old + len(kept),
            algebraics=tuple(_renumbered(step, numbers) for step in equations.algebraics),
            pre=tuple((slot, renumbered(source, numbers)) for slot, source in equations.pre),
        ),
        numbers,
    )


def renumbered(slot: Slot, numbers: Mapping[int, int]) -> Slot:
    """Return the position of a slot after `without_unused`."""
    return ("y", numbers.get(slot[1], slot[1])) if slot[0] == "y" else slot


def _renumbered(step: Step, numbers: dict[int, int]) -> Step:
    if isinstance(step, Assignment):
        return replace(step, unknown=numbers.get(step.unknown, step.unknown))
    return replace(step, unknowns=tuple(numbers.get(unknown, unknown) for unknown in step.unknowns))
