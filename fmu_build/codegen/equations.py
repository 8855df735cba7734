"""The equations of a model, ready to be written as C."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Step
from fmu_build.codegen.clocks import Clock
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.relations import Relations

DiscreteKind = Literal["assign", "condition", "reinit"]
ActionKind = Literal["error", "warning", "terminate"]


@dataclass(frozen=True, slots=True)
class DiscreteRow:
    """``slot = value`` at events; `kind` determines at which, see `DiscreteKind` in the runtime's model.h."""

    kind: DiscreteKind
    slot: Slot
    value: Expression

    @property
    def holds(self) -> bool:
        """Whether the row holds a discrete variable's value until a when-clause sets it."""
        value = self.value
        while value.operator == "Select":
            value = value.arguments[2]
        return self.slot[0] == "p" and value == ex.p(self.slot[1])


@dataclass(frozen=True, slots=True)
class Action:
    """An assert() or terminate(), triggered when `condition` is true; its message has texts and values."""

    kind: ActionKind
    condition: Expression
    message: tuple[str | tuple[str, Expression], ...]


@dataclass(frozen=True, slots=True)
class EventSensitivities:
    """How sensitivities change at an event: see `Sensitivities` in the runtime's model.h."""

    n_states: int
    """Number of states of the model itself; their sensitivities follow, parameter by parameter."""
    moves: tuple[int, ...]
    """For each parameter, the slot of p with the derivative of the event's time during an event, else 0."""
    next_moves: tuple[int, ...]
    """The same for the event that is due next."""
    root_rates: tuple[Expression, ...]
    """For each root, including those in time: its derivatives along the motion and by each parameter."""


@dataclass(frozen=True)
class Equations:
    """All equations that determine y and p."""

    n_states: int
    n_y: int
    n_p: int
    derivatives: tuple[Expression, ...]
    algebraics: tuple[Step, ...]
    relations: Relations
    discrete: tuple[DiscreteRow, ...]
    clocks: tuple[Clock, ...]
    pre: tuple[tuple[int, Slot], ...]
    actions: tuple[Action, ...]
    dependent_parameters: tuple[tuple[int, Expression], ...]
    start_values: tuple[tuple[Slot, Expression], ...]
    initial_unknowns: tuple[Slot, ...]
    initial_residuals: tuple[Expression, ...]
    initial_event: int | None
    homotopy: int | None = None
    """The slot of p for the distance of homotopy() from its actual expression, from 0 to 1."""
    guesses: tuple[tuple[Slot, Expression], ...] = ()
    """Initial guesses for unknowns of algebraic loops that depend on parameters."""
    sensitivities: EventSensitivities | None = None


def watched_conditions(equations: Equations) -> list[Expression]:
    """Return the conditions of actions that can become true between events: those that read y or time."""
    return [action.condition for action in equations.actions if ex.varies(action.condition)]


def written_slots(equations: Equations) -> set[int]:
    """Return the slots of p that the runtime or an equation writes."""
    relations = equations.relations
    slots = {relation.memory for relation in (*relations.crossings, *relations.of_time)}
    slots |= {row.slot[1] for row in equations.discrete if row.slot[0] == "p"}
    slots |= {slot for slot, _ in equations.pre} | {clock.activation for clock in equations.clocks}
    if equations.sensitivities is not None:
        slots |= {*equations.sensitivities.moves, *equations.sensitivities.next_moves}
    return slots | {slot for slot in (equations.initial_event, equations.homotopy) if slot is not None}


def acting_expressions(equations: Equations) -> Sequence[Expression]:
    """Return every expression that affects the solution after initialization; this excludes assertions."""
    return (
        *equations.derivatives,
        *(e for step in equations.algebraics for e in step.expressions),
        *(row.value for row in equations.discrete),
        *(relation.root for relation in equations.relations.crossings),
        *equations.relations.event_times,
    )
