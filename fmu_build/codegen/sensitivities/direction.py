"""The tangents of a model's equations in one direction: along the motion in time, or by one parameter.

This is forward mode, as for the directional derivatives, but the tangents become equations of the model:
tangents of algebraic variables are algebraic variables, tangents of computed parameters are computed
parameters.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step, in_order
from fmu_build.codegen.differentiate import call_of_tangent, differentiate
from fmu_build.codegen.equations import DiscreteRow, Equations
from fmu_build.codegen.expression import ZERO, Expression, Slot, leaf, tangent_leaf
from fmu_build.codegen.sensitivities.slots import NewSlots


@dataclass
class Direction:
    """Tangents of the leaves of expressions, and the equations that compute these tangents."""

    name: str
    slots: NewSlots
    seeds: dict[Expression, Expression]
    """The nonzero tangents."""
    steps: list[Step] = field(default_factory=list)
    parameters: list[tuple[int, Expression]] = field(default_factory=list)
    """Equations for the tangents of computed parameters; these tangents are computed parameters themselves.
    """

    def tangent(self, value: Expression) -> Expression:
        """Return the tangent of a value; raises `NotDifferentiableError`."""
        return differentiate(value, self.seeds, call_of_tangent)

    def along_parameters(self, rows: Sequence[tuple[int, Expression]]) -> None:
        """Add the tangents of computed parameters."""
        for index, value in in_order(rows):
            tangent = self.tangent(value)
            if tangent.arguments:
                slot = self.slots.add(("p", index), self.name)
                self.parameters.append((slot[1], tangent))
                tangent = leaf(slot)
            self._seed(ex.p(index), tangent)

    def along_algebraics(self, steps: Iterable[Step]) -> None:
        """Add the tangents of algebraic variables; a tangent that equals another value gets no equation."""
        for step in steps:
            if isinstance(step, NewtonBlock):
                self._along_block(step)
                continue
            tangent = self.tangent(step.value)
            if tangent.arguments:
                slot = self.slots.add(("y", step.unknown), self.name)
                self.steps.append(Assignment(slot[1], tangent))
                tangent = leaf(slot)
            self._seed(ex.y(step.unknown), tangent)

    def _along_block(self, block: NewtonBlock) -> None:
        """Add the tangents of a loop's unknowns: they solve its linearization, with the same Jacobian."""
        if all(self.tangent(residual) == ZERO for residual in block.residuals):
            return
        slots = [self.slots.add(("y", unknown), self.name) for unknown in block.unknowns]
        self.seeds |= {ex.y(u): leaf(slot) for u, slot in zip(block.unknowns, slots, strict=True)}
        residuals = tuple(self.tangent(residual) for residual in block.residuals)
        self.steps.append(NewtonBlock(tuple(slot[1] for slot in slots), residuals, block.jacobian))

    def moving_slots(self, equations: Equations) -> list[Slot]:
        """Return, in order, the discrete variables and pre() values whose tangents can differ from zero."""
        found: dict[Slot, None] = {}
        starts = {slot for slot, value in equations.start_values if slot[0] == "p" and self._moves(value)}
        sought = {slot for slot in equations.initial_unknowns if slot[0] == "p"}
        while True:
            trial = Direction(self.name, self.slots, dict(self.seeds))
            trial.seeds |= {leaf(slot): tangent_leaf(slot) for slot in found}
            trial._mark(equations.algebraics)
            rows = [
                row.slot for row in equations.discrete if row.kind == "assign" and trial._moves(row.value)
            ]
            pre: list[Slot] = [("p", slot) for slot, source in equations.pre if leaf(source) in trial.seeds]
            new = [slot for slot in (*sorted(starts | sought), *rows, *pre) if slot not in found]
            if not new:
                return list(found)
            found |= dict.fromkeys(new)

    def _mark(self, steps: Iterable[Step]) -> None:
        """Seed the algebraic variables with nonzero tangents, without adding equations for them."""
        for step in steps:
            if any(self._moves(value) for value in step.expressions):
                self.seeds |= {ex.y(unknown): tangent_leaf(("y", unknown)) for unknown in step.unknowns}

    def _moves(self, value: Expression) -> bool:
        return self.tangent(value) != ZERO

    def discrete(self, rows: Iterable[DiscreteRow]) -> list[DiscreteRow]:
        """Return the tangents of discrete equations and of reinit(), which apply together with these."""
        return [
            DiscreteRow(row.kind, slot, self.tangent(row.value))
            for row in rows
            if row.kind != "condition" and (slot := self.slot_of(row.slot)) is not None
        ]

    def slot_of(self, slot: Slot) -> Slot | None:
        """Return the slot of the tangent of a state or of a moving slot of p; None if it is always zero."""
        seed = self.seeds.get(leaf(slot))
        if seed is None or seed.operator not in ("y", "p"):
            return None
        return ("y", seed.index) if seed.operator == "y" else ("p", seed.index)

    def _seed(self, value: Expression, tangent: Expression) -> None:
        if tangent != ZERO:
            self.seeds[value] = tangent
