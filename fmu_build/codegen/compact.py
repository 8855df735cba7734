"""Dead code elimination: rumoca allocates a memory for every condition and relation, used or not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step
from fmu_build.codegen.equations import Equations, EventSensitivities, written_slots
from fmu_build.codegen.expression import ZERO, Expression, Slot
from fmu_build.codegen.relations import Relation, Relations

Change = Callable[[Expression], Expression]


def compact(equations: Equations, n_named: int) -> Equations:
    """Drop unused memories and renumber the remaining slots of p without gaps.

    The first `n_named` slots of p are parameters, inputs and discrete variables; they keep their numbers.
    """
    equations = _without_unwritten(equations, n_named)
    equations = _without_unread(equations)
    kept = [slot for slot in range(equations.n_p) if slot < n_named or slot in written_slots(equations)]
    numbers = {old: new for new, old in enumerate(kept)}
    moved = {ex.p(old): ex.p(new) for old, new in numbers.items() if old != new}
    return _renumbered(changed(equations, lambda e: ex.substitute(e, moved)), numbers)


def _without_unwritten(equations: Equations, n_named: int) -> Equations:
    """Replace each memory that is never written by 0, its constant value."""
    written = written_slots(equations)
    zero = {ex.p(slot): ZERO for slot in range(n_named, equations.n_p) if slot not in written}
    return changed(equations, lambda e: ex.substitute(e, zero))


def _without_unread(equations: Equations) -> Equations:
    """Drop conditions, pre() values and relations that no expression reads."""
    while True:
        read = ex.places("p", *_expressions(equations))
        relations = equations.relations
        smaller = replace(
            equations,
            discrete=tuple(r for r in equations.discrete if r.kind != "condition" or r.slot[1] in read),
            pre=tuple(binding for binding in equations.pre if binding[0] in read),
            homotopy=equations.homotopy if equations.homotopy in read else None,
            relations=replace(
                relations,
                crossings=[r for r in relations.crossings if r.memory in read or _keeps_step(r, relations)],
                of_time=[r for r in relations.of_time if r.memory in read],
            ),
        )
        if smaller == equations:
            return equations
        equations = smaller


def _keeps_step(relation: Relation, relations: Relations) -> bool:
    """Return whether a crossing is needed to update the memory of floor() or a similar function."""
    steps = {ex.p(memory) for memory in relations.floors.values()}
    return not steps.isdisjoint(ex.leaves(relation.root))


def _expressions(equations: Equations) -> list[Expression]:
    """Return every expression that may read a memory; a relation's root does not read its own."""
    found: list[Expression] = []

    def note(expression: Expression) -> Expression:
        found.append(expression)
        return expression

    changed(equations, note)
    return found


def changed(equations: Equations, change: Change) -> Equations:
    """Apply `change` to every expression of the equations."""
    relations = equations.relations
    return replace(
        equations,
        derivatives=tuple(change(e) for e in equations.derivatives),
        algebraics=tuple(_changed_step(step, change) for step in equations.algebraics),
        relations=replace(
            relations,
            crossings=[replace(r, root=change(r.root)) for r in relations.crossings],
            of_time=[replace(r, root=change(r.root)) for r in relations.of_time],
            event_times=[change(e) for e in relations.event_times],
            floors={change(e): memory for e, memory in relations.floors.items()},
        ),
        discrete=tuple(replace(row, value=change(row.value)) for row in equations.discrete),
        actions=tuple(
            replace(
                action,
                condition=change(action.condition),
                message=tuple(p if isinstance(p, str) else (p[0], change(p[1])) for p in action.message),
            )
            for action in equations.actions
        ),
        dependent_parameters=tuple((slot, change(e)) for slot, e in equations.dependent_parameters),
        start_values=tuple((slot, change(e)) for slot, e in equations.start_values),
        guesses=tuple((slot, change(e)) for slot, e in equations.guesses),
        initial_residuals=tuple(change(e) for e in equations.initial_residuals),
        sensitivities=_changed_sensitivities(equations.sensitivities, change),
    )


def _changed_sensitivities(
    sensitivities: EventSensitivities | None, change: Change
) -> EventSensitivities | None:
    if sensitivities is None:
        return None
    return replace(sensitivities, root_rates=tuple(change(e) for e in sensitivities.root_rates))


def _changed_step(step: Step, change: Change) -> Step:
    if isinstance(step, Assignment):
        return replace(step, value=change(step.value))
    return NewtonBlock(
        step.unknowns,
        tuple(change(e) for e in step.residuals),
        tuple(tuple(change(e) for e in row) for row in step.jacobian),
    )


def _renumbered(equations: Equations, numbers: dict[int, int]) -> Equations:
    def moved(slot: Slot) -> Slot:
        return slot if slot[0] == "y" else ("p", numbers[slot[1]])

    relations = equations.relations
    initial_event, homotopy = equations.initial_event, equations.homotopy
    return replace(
        equations,
        n_p=len(numbers),
        relations=replace(
            relations,
            n_p=len(numbers),
            crossings=[replace(r, memory=numbers[r.memory]) for r in relations.crossings],
            of_time=[replace(r, memory=numbers[r.memory]) for r in relations.of_time],
            floors={e: numbers[memory] for e, memory in relations.floors.items()},
        ),
        discrete=tuple(replace(row, slot=moved(row.slot)) for row in equations.discrete),
        clocks=tuple(replace(clock, activation=numbers[clock.activation]) for clock in equations.clocks),
        pre=tuple((numbers[slot], moved(source)) for slot, source in equations.pre),
        initial_event=None if initial_event is None else numbers[initial_event],
        homotopy=None if homotopy is None else numbers[homotopy],
    )
