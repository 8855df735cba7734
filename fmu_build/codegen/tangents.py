"""Directional derivatives by forward-mode tangents with respect to states, inputs, parameters and time.

The tangent of an assignment ``v = e`` is the sum of ``de/dx`` times the tangent of x over all x that e reads;
tangents are computed in the order of the assignments. The tangents of an algebraic loop's unknowns solve its
linearization. Relations, conditions and values set by when-clauses count as constant: the derivatives are
those of the active branch.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step, in_order
from fmu_build.codegen.differentiate import call_of_tangent, differentiate
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import DTIME, TIME, ZERO, Expression, Slot, leaf, tangent_leaf
from fmu_build.codegen.variables import StoredVariable

Seeds = Mapping[Expression, Expression]


class NoTangentsError(Exception):
    """The model has no directional derivatives; the message says why."""


@dataclass(frozen=True, slots=True)
class Tangent:
    """The tangent of the value in one slot."""

    slot: Slot
    value: Expression

    @property
    def values(self) -> tuple[Expression, ...]:
        """The expressions to compute."""
        return (self.value,)


@dataclass(frozen=True, slots=True)
class BlockTangent:
    """An algebraic loop, and the tangents of its residuals at constant unknowns."""

    block: NewtonBlock
    residuals: tuple[Expression, ...]

    @property
    def values(self) -> tuple[Expression, ...]:
        """The expressions to compute."""
        return self.residuals


@dataclass(frozen=True)
class Tangents:
    """The tangents of one model in topological order."""

    parameters: tuple[Tangent, ...]
    """Computed parameters."""
    steps: tuple[Tangent | BlockTangent, ...]
    """Algebraic variables, and discrete variables that depend continuously on other values."""
    derivatives: tuple[Expression, ...]
    starts: tuple[Tangent, ...]
    """Start values of states that depend on parameters."""
    initial_residuals: tuple[Expression, ...]
    cover_initialization: bool
    """Whether the tangents are valid across initialization: no when-clause that can act at the start sets a
    state or a value with a tangent, and no start value of a discrete variable has a tangent.
    """

    @classmethod
    def of(cls, equations: Equations, variables: Sequence[StoredVariable]) -> Tangents:
        """Derive the tangents; raises `NoTangentsError` if the equations have no topological order."""
        seeds = {TIME: DTIME} | _moving(("y", i) for i in range(equations.n_y))
        seeds |= _moving(_independent(equations, variables))
        parameters = []
        for index, value in in_order(equations.dependent_parameters):
            parameters.append(Tangent(("p", index), _tangent(value, seeds)))
            _move(seeds, parameters[-1])
        moving = _moving_rows(equations, seeds)
        seeds |= _moving(row.slot for row in moving)
        steps = [_step_tangent(step, seeds) for step in _ordered((*equations.algebraics, *moving))]
        return cls(
            parameters=tuple(t for t in parameters if t.value != ZERO),
            steps=tuple(t for t in steps if isinstance(t, BlockTangent) or t.value != ZERO),
            derivatives=tuple(_tangent(value, seeds) for value in equations.derivatives),
            starts=tuple(
                Tangent(slot, _tangent(value, seeds))
                for slot, value in equations.start_values
                if slot[0] == "y" and slot[1] < equations.n_states
            ),
            initial_residuals=tuple(_tangent(value, seeds) for value in equations.initial_residuals),
            cover_initialization=not _acts_at_start(equations, seeds)
            and all(slot[0] == "y" or _tangent(e, seeds) == ZERO for slot, e in equations.start_values),
        )


@dataclass(frozen=True, slots=True)
class _DiscreteStep:
    slot: Slot
    value: Expression


def _moving(slots: Iterable[Slot]) -> dict[Expression, Expression]:
    return {leaf(slot): tangent_leaf(slot) for slot in slots}


def _independent(equations: Equations, variables: Iterable[StoredVariable]) -> list[Slot]:
    """Return the slots of p that an importer or an initial equation sets."""
    found: list[Slot] = [
        ("p", s.index)
        for s in variables
        if s.store == "p" and s.variable.type == "Real" and s.variable.causality in ("parameter", "input")
    ]
    return [*found, *(slot for slot in equations.initial_unknowns if slot[0] == "p")]


def _tangent(value: Expression, seeds: Seeds) -> Expression:
    return differentiate(value, seeds, call_of_tangent)


def _move(seeds: dict[Expression, Expression], tangent: Tangent) -> None:
    """Seed the slot of a tangent, or remove its seed if the tangent is zero."""
    seeds.pop(leaf(tangent.slot), None)
    if tangent.value != ZERO:
        seeds |= _moving([tangent.slot])


def _step_tangent(step: Step | _DiscreteStep, seeds: dict[Expression, Expression]) -> Tangent | BlockTangent:
    if isinstance(step, NewtonBlock):
        outside = {value: seed for value, seed in seeds.items() if not _is_unknown(value, step)}
        return BlockTangent(step, tuple(_tangent(residual, outside) for residual in step.residuals))
    slot: Slot = ("y", step.unknown) if isinstance(step, Assignment) else step.slot
    tangent = Tangent(slot, _tangent(step.value, seeds))
    _move(seeds, tangent)
    return tangent


def _is_unknown(value: Expression, block: NewtonBlock) -> bool:
    return value.operator == "y" and value.index in block.unknowns


def _moving_rows(equations: Equations, seeds: Seeds) -> list[_DiscreteStep]:
    """Return the discrete variables whose equations hold at all times and whose tangents are not zero."""
    rows = [row for row in equations.discrete if row.kind == "assign" and not row.holds]
    moving: list[_DiscreteStep] = []
    known = dict(seeds)
    while True:
        new = [row for row in rows if leaf(row.slot) not in known and _tangent(row.value, known) != ZERO]
        if not new:
            return moving
        moving += [_DiscreteStep(row.slot, row.value) for row in new]
        known |= _moving(row.slot for row in new)


def _ordered(steps: Sequence[Step | _DiscreteStep]) -> list[Step | _DiscreteStep]:
    """Sort the steps topologically; raises `NoTangentsError` for a cycle."""
    by_slot = {slot: step for step in steps for slot in _slots(step)}
    ordered: list[Step | _DiscreteStep] = []
    entered: set[int] = set()
    done: set[int] = set()

    def visit(step: Step | _DiscreteStep) -> None:
        if id(step) in done:
            return
        if id(step) in entered:
            raise NoTangentsError("discrete and algebraic equations form a cycle")
        entered.add(id(step))
        values = (step.value,) if isinstance(step, _DiscreteStep) else step.expressions
        own = _slots(step)
        read = [(value.operator, value.payload) for value in ex.leaves(*values)]
        for slot in sorted(slot for slot in read if slot in by_slot and slot not in own):
            visit(by_slot[slot])
        done.add(id(step))
        ordered.append(step)

    for step in steps:
        visit(step)
    return ordered


def _slots(step: Step | _DiscreteStep) -> list[tuple[str, object]]:
    if isinstance(step, _DiscreteStep):
        return [step.slot]
    return [("y", unknown) for unknown in step.unknowns]


def _acts_at_start(equations: Equations, seeds: Seeds) -> bool:
    """Return whether a when-clause that can act at the start sets a state or a value with a tangent."""
    starters = {clock.activation for clock in equations.clocks}
    if equations.initial_event is not None:
        starters.add(equations.initial_event)
    read = ex.places("p", *(row.value for row in equations.discrete))
    if starters.isdisjoint(read):
        return False
    return any(
        row.kind == "reinit" or (row.holds and _tangent(row.value, seeds) != ZERO)
        for row in equations.discrete
    )
