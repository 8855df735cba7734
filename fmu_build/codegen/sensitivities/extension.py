"""Extend the equations of a model with those of its sensitivities.

For each parameter p, every state x gets an additional state dx/dp with the derivative ``(df/dx) dx/dp +
df/dp``. All other tangents are ordinary algebraic variables, computed parameters and discrete variables.

Time also has a tangent, the slot ``move``: it is zero between events and, during an event, the derivative of
the event's time by the parameter. The runtime sets it, adds ``der(x)*move`` to dx/dp before the event and
subtracts it afterwards. In between, all tangents are those of values at the moving event, so that the
tangents of discrete equations and of reinit() need no special treatment.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.differentiate import NotDifferentiableError
from fmu_build.codegen.equations import DiscreteRow, Equations, EventSensitivities
from fmu_build.codegen.expression import ONE, TIME, ZERO, Expression, Slot, leaf
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.sensitivities.declared import Declaration, declare, quotient_unit
from fmu_build.codegen.sensitivities.direction import Direction
from fmu_build.codegen.sensitivities.refusals import reject_without_sensitivities
from fmu_build.codegen.sensitivities.shift import shifted, with_room
from fmu_build.codegen.sensitivities.slots import NewSlots
from fmu_build.codegen.sensitivities.unused import renumbered, without_unused
from fmu_build.codegen.sensitivities.wanted import Wanted
from fmu_build.codegen.variables import StoredVariable, nominals
from fmu_build.support.description import Variable
from fmu_build.support.errors import UnsupportedModelError


@dataclass(frozen=True)
class Extended:
    """A model with its sensitivities: `outputs` are the requested ones, `states` those of states."""

    model: LoweredModel
    equations: Equations
    outputs: frozenset[str]
    states: frozenset[str]

    def marked(self, stored: Sequence[StoredVariable]) -> tuple[StoredVariable, ...]:
        """Return the variables with the requested sensitivities marked as outputs.

        Events can change the sensitivities of all states.
        """
        return tuple(replace(one, variable=self._marked(one.variable)) for one in stored)

    def _marked(self, variable: Variable) -> Variable:
        if variable.name in self.outputs:
            variable = replace(variable, causality="output")
        return replace(variable, reinit=True) if variable.name in self.states else variable


def extend(
    model: LoweredModel, equations: Equations, stored: Sequence[StoredVariable], wanted: Wanted
) -> Extended:
    """Return the model with the requested sensitivities.

    Raises `UnsupportedModelError`, which names the construct, if the model does not allow any.
    """
    reject_without_sensitivities(model, equations, stored)
    try:
        return _Extension(model, equations, stored, wanted).extended()
    except NotDifferentiableError as error:
        raise UnsupportedModelError(
            f"{model.name}: no sensitivities: {error} has no known derivative"
        ) from error


class _Extension:
    def __init__(
        self, model: LoweredModel, equations: Equations, stored: Sequence[StoredVariable], wanted: Wanted
    ) -> None:
        self.model = model
        self.stored = stored
        self.wanted = wanted
        self.n = equations.n_states
        self.n_more = self.n * len(wanted.parameters)
        self.plain = with_room(equations, self.n_more)
        self.slots = NewSlots(self.plain.n_y, self.plain.n_p, self._texts(model))
        self.state_names = model.y_names[: self.n]
        for number, name in enumerate(self._names_of_states()):
            self.slots.names["y", self.n + number] = name
        self.moves = [self.slots.named("p", f"move.{p.variable.name}")[1] for p in wanted.parameters]
        self.next_moves = [
            self.slots.named("p", f"next_move.{p.variable.name}")[1] for p in wanted.parameters
        ]
        self.initial: list[tuple[Slot, Expression]] = []
        self.starts: list[tuple[Slot, Expression]] = []
        self.discrete: list[DiscreteRow] = []
        self.pre: list[tuple[int, Slot]] = []

    def _texts(self, model: LoweredModel) -> dict[Slot, str]:
        texts: dict[Slot, str] = {}
        for index, name in enumerate(model.y_names):
            texts[shifted(("y", index), self.n, self.n_more)] = name
        return texts | {slot: name for name, slot in model.slots.items() if slot[0] == "p"}

    def _names_of_states(self) -> Iterator[str]:
        for parameter in self.wanted.parameters:
            for state in self.state_names:
                yield _name(state, parameter)

    def extended(self) -> Extended:
        directions = [self._by_parameter(number) for number in range(len(self.wanted.parameters))]
        along = self._along_motion()
        outputs = list(self._outputs(directions))
        equations = self._equations(directions, along, [step for _, step in outputs])
        equations, numbers = without_unused(equations, self.plain.n_y, [step.unknown for _, step in outputs])
        names = {
            renumbered(slot, numbers): name
            for slot, name in self.slots.names.items()
            if slot[0] == "p" or slot[1] < self.plain.n_y or slot[1] in numbers
        }
        shown = [replace(one, slot=("y", numbers[step.unknown])) for one, step in outputs]
        states = list(self._declared_states())
        declarations = (*states, *shown)
        model = declare(self.model, self.n, names, declarations, self.n_more)
        asked = {_name(v.variable.name, p) for v in self.wanted.variables for p in self.wanted.parameters}
        return Extended(model, equations, frozenset(asked), frozenset(one.name for one in states))

    def _state(self, state: int, parameter: int) -> int:
        return self.n * (1 + parameter) + state

    def _by_parameter(self, number: int) -> Direction:
        """Return the tangents by one parameter; collects those of start values and discrete equations."""
        plain = self.plain
        parameter = self.wanted.parameters[number]
        seeds = {TIME: ex.p(self.moves[number]), ex.p(parameter.index): ONE}
        seeds |= {ex.y(i): ex.y(self._state(i, number)) for i in range(self.n)}
        direction = Direction(parameter.variable.name, self.slots, seeds)
        free = [slot for slot in plain.initial_unknowns if slot[0] == "p"]
        direction.seeds |= {leaf(slot): leaf(self.slots.add(slot, direction.name)) for slot in free}
        direction.along_parameters(plain.dependent_parameters)
        for slot in direction.moving_slots(plain):
            direction.seeds.setdefault(leaf(slot), leaf(self.slots.add(slot, direction.name)))
        direction.along_algebraics(plain.algebraics)
        self._note_initial(direction)
        self.discrete += direction.discrete(plain.discrete)
        for index, source in plain.pre:
            before, now = direction.slot_of(("p", index)), direction.slot_of(source)
            if before is not None and now is not None:
                self.pre.append((before[1], now))
        return direction

    def _note_initial(self, direction: Direction) -> None:
        """Collect start values of states and discrete variables, and initial equations for their tangents."""
        plain = self.plain
        sought = set(plain.initial_unknowns)
        given = {slot for slot, _ in plain.start_values}
        held: list[Slot] = [("y", i) for i in range(self.n)]
        held += [row.slot for row in plain.discrete if row.kind == "assign"]
        rows = [*plain.start_values, *((slot, ZERO) for slot in dict.fromkeys(held) if slot not in given)]
        for slot, value in rows:
            tangent = direction.slot_of(slot)
            if tangent is not None and slot not in sought:
                self.starts.append((tangent, direction.tangent(value)))
        for slot, residual in zip(plain.initial_unknowns, plain.initial_residuals, strict=True):
            tangent = direction.slot_of(slot)
            if tangent is None:
                what = "an initial equation determines an algebraic variable"
                raise self.model.unsupported(f"no sensitivities: {what}")
            self.initial.append((tangent, direction.tangent(residual)))

    def _along_motion(self) -> Direction:
        """Return the derivatives along the motion in time, within a branch."""
        seeds = {TIME: ONE} | {
            ex.y(i): value for i, value in enumerate(self.plain.derivatives) if value != ZERO
        }
        direction = Direction("time", self.slots, seeds)
        direction.along_algebraics(self.plain.algebraics)
        return direction

    def _outputs(self, directions: Sequence[Direction]) -> Iterator[tuple[Declaration, Assignment]]:
        """Yield each requested sensitivity, unless it is a state, with its equation."""
        for variable in self.wanted.variables:
            slot = shifted(self.model.slots[variable.variable.name], self.n, self.n_more)
            if variable.variable.name in self.state_names:
                continue
            for parameter, direction in zip(self.wanted.parameters, directions, strict=True):
                name = _name(variable.variable.name, parameter)
                value = direction.seeds.get(leaf(slot), ZERO)
                new = self.slots.named("y", name)
                nominal = abs(variable.variable.nominal or 1.0)
                declaration = self._declaration(variable, parameter, new, "algebraic", nominal)
                yield declaration, Assignment(new[1], value)

    def _declared_states(self) -> Iterator[Declaration]:
        sizes = nominals(self.model)
        known = {s.variable.name: s for s in self.stored}
        for number, parameter in enumerate(self.wanted.parameters):
            for state, name in enumerate(self.state_names):
                slot: Slot = ("y", self._state(state, number))
                yield self._declaration(known[name], parameter, slot, "state", sizes.get(state, 1.0))

    def _declaration(
        self, of: StoredVariable, by: StoredVariable, slot: Slot, role: str, nominal: float
    ) -> Declaration:
        """The nominal value is that of the variable divided by the parameter's magnitude, as in CVODES."""
        size = abs(by.variable.start or by.variable.nominal or 1.0)
        return Declaration(
            name=_name(of.variable.name, by),
            slot=slot,
            role=role,
            description=f"Derivative of {of.variable.name} by {by.variable.name} along the run",
            unit=quotient_unit(of.variable.unit, by.variable.unit),
            nominal=nominal / size,
        )

    def _equations(
        self, directions: Sequence[Direction], along: Direction, outputs: Sequence[Assignment]
    ) -> Equations:
        plain = self.plain
        roots = (*plain.relations.roots, *plain.relations.time_roots)
        steps = chain.from_iterable(direction.steps for direction in (*directions, along))
        return replace(
            plain,
            n_states=self.n + self.n_more,
            n_p=self.slots.n_p,
            derivatives=(
                *plain.derivatives,
                *(d.tangent(value) for d in directions for value in plain.derivatives),
            ),
            algebraics=(*plain.algebraics, *steps, *outputs),
            discrete=(*plain.discrete, *self.discrete),
            pre=(*plain.pre, *self.pre),
            dependent_parameters=(
                *plain.dependent_parameters,
                *(row for direction in directions for row in direction.parameters),
            ),
            start_values=(*plain.start_values, *self.starts),
            initial_unknowns=(*plain.initial_unknowns, *(slot for slot, _ in self.initial)),
            initial_residuals=(*plain.initial_residuals, *(value for _, value in self.initial)),
            sensitivities=EventSensitivities(
                n_states=self.n,
                moves=tuple(self.moves),
                next_moves=tuple(self.next_moves),
                root_rates=tuple(d.tangent(root) for root in roots for d in (along, *directions)),
            ),
        )


def _name(variable: str, parameter: StoredVariable) -> str:
    return f"sensitivity.{variable}.{parameter.variable.name}"
