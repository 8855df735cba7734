"""Write assignments in bodies of Modelica functions as C statements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from fmu_build.codegen.functions.code import FunctionCode
from fmu_build.codegen.functions.dae import FunctionDae
from fmu_build.codegen.functions.definitions import are_equal, reads
from fmu_build.codegen.functions.expressions import FunctionExpressions
from fmu_build.codegen.functions.index import Index, positions


@dataclass(frozen=True, slots=True)
class Assignment:
    """``target := rhs``: the number of a variable and the id of an expression."""

    target: int
    rhs: int


class AssignmentWriter:
    """Writes assignments to variables that have been declared."""

    def __init__(self, dae: FunctionDae, expressions: FunctionExpressions, code: FunctionCode) -> None:
        self._dae = dae
        self._expressions = expressions
        self._code = code

    def write(self, assignments: Sequence[Assignment]) -> None:
        """Write simultaneous assignments: none reads a value that another one sets."""
        pending = [assignment for assignment in assignments if not self._keeps_value(assignment)]
        if len(pending) > 1 and all(map(self.is_if, pending)) and self._have_same_conditions(pending):
            self._if(pending)
            return
        while pending:
            free = next((a for a in pending if not self._is_needed(a, pending)), None)
            if free is not None:
                pending.remove(free)
                self._assign(free)
            else:
                first, *pending = pending
                self._assign_last(first, pending)
                return

    def is_if(self, assignment: Assignment) -> bool:
        """Return whether to write an if-statement: the source has one, or arrays are selected."""
        if self._dae.operation(assignment.rhs)["kind"] != "conditional":
            return False
        return bool(self._dae.dimensions(assignment.rhs)) or self._dae.is_generated(assignment.rhs)

    def _keeps_value(self, assignment: Assignment) -> bool:
        operation = self._dae.operation(assignment.rhs)
        return bool(
            operation["kind"] == "function_value"
            and operation["value"] == assignment.target
            and operation["definition"] == self._expressions.current.get(assignment.target)
        )

    def _is_needed(self, assignment: Assignment, pending: Sequence[Assignment]) -> bool:
        """Return whether another pending assignment reads the old value of the target."""
        others = [other.rhs for other in pending if other is not assignment]
        return self._reads(others, assignment.target)

    def _reads(self, roots: Sequence[int], target: int) -> bool:
        return any(value == target for value, _ in reads(self._dae.by_id, roots))

    def _assign(self, assignment: Assignment) -> None:
        if self.is_if(assignment):
            self._if([assignment])
        elif self._dae.dimensions(assignment.rhs):
            self._assign_array(assignment)
        else:
            name = self._expressions.variables[assignment.target]
            self._code.assign(name, self._expressions.scalar(assignment.rhs))

    def _assign_last(self, assignment: Assignment, others: Sequence[Assignment]) -> None:
        """Break a cycle of assignments that need each other's old values: hold one new value back."""
        if self._dae.dimensions(assignment.rhs):
            copy = self._copy_of(assignment)
            self.write(others)
            self._copy_back(copy, assignment)
        else:
            copy = self._code.name("new")
            self._code.define(copy, self._expressions.scalar(assignment.rhs))
            self.write(others)
            self._code.assign(self._expressions.variables[assignment.target], self._code.variable(copy))

    # if

    def _have_same_conditions(self, pending: Sequence[Assignment]) -> bool:
        first, *others = (self._dae.operation(a.rhs)["operands"] for a in pending)
        return all(
            len(operands) == len(first)
            and all(
                are_equal(self._dae.by_id, a, b) for a, b in zip(first[:-1:2], operands[:-1:2], strict=True)
            )
            for operands in others
        )

    def _if(self, pending: Sequence[Assignment]) -> None:
        operands = [self._dae.operation(assignment.rhs)["operands"] for assignment in pending]
        conditions = [self._code.condition(self._expressions.scalar(c)) for c in operands[0][:-1:2]]
        values = [*range(1, len(operands[0]) - 1, 2), -1]
        branches = [
            [Assignment(a.target, choices[place]) for a, choices in zip(pending, operands, strict=True)]
            for place in values
        ]
        self._code.open(f"if ({conditions[0]})")
        for number, branch in enumerate(branches[:-1]):
            if number:
                self._code.close(f"else if ({conditions[number]}) {{")
            self.write(branch)
        if not all(map(self._keeps_value, branches[-1])):
            self._code.close("else {")
            self.write(branches[-1])
        self._code.close()

    # arrays

    def _assign_array(self, assignment: Assignment) -> None:
        name = self._expressions.variables[assignment.target]
        if self._dae.operation(assignment.rhs)["kind"] == "array_update":
            self._update(assignment, name)
        elif self._reads([assignment.rhs], assignment.target):
            self._copy_back(self._copy_of(assignment), assignment)
        else:
            self._fill(name, assignment.rhs)

    def _copy_of(self, assignment: Assignment) -> str:
        """Declare a new array with the value of the right-hand side and return its name."""
        name = self._code.name("new")
        self._code.declare(name, self._dae.size(assignment.rhs))
        updates, base = self._updates(assignment.rhs)
        self._fill(name, base)
        for update in updates:
            self._store_update(name, update)
        return name

    def _copy_back(self, copy: str, assignment: Assignment) -> None:
        name = self._expressions.variables[assignment.target]
        self._expressions.loops.copy(name, copy, self._dae.size(assignment.rhs))

    def _fill(self, name: str, rhs: int) -> None:
        """Set all elements of a C array; the right-hand side must not read it."""
        dimensions = self._dae.dimensions(rhs)
        if self._expressions.is_only_result(rhs):
            self._expressions.call_into(rhs, name)
            return

        def store(at: tuple[Index, ...]) -> None:
            value = self._expressions.element(rhs, at)
            self._expressions.subscripts.store(name, dimensions, at, value)

        if self._expressions.is_list(rhs):
            for at in positions(dimensions):
                store(at)
        else:
            self._expressions.loops.for_each(dimensions, store)

    def _updates(self, rhs: int) -> tuple[list[dict[str, Any]], int]:
        """Return the chain of element assignments in the right-hand side, in order, and their base array."""
        updates: list[dict[str, Any]] = []
        while (operation := self._dae.operation(rhs))["kind"] == "array_update":
            updates.insert(0, operation)
            rhs = operation["base"]
        return updates, rhs

    def _update(self, assignment: Assignment, name: str) -> None:
        """Assign to elements, in place unless an assignment reads an element that an earlier one sets."""
        updates, base = self._updates(assignment.rhs)
        late = updates if self._dae.dimensions(updates[0]["value"]) else updates[1:]
        inputs = [number for update in late for number in _inputs(update)]
        is_in_place = self._keeps_value(Assignment(assignment.target, base))
        if self._reads(inputs, assignment.target) or (
            not is_in_place and self._reads([assignment.rhs], assignment.target)
        ):
            self._copy_back(self._copy_of(assignment), assignment)
            return
        if not is_in_place:
            self._fill(name, base)
        for update in updates:
            self._store_update(name, update)

    def _store_update(self, name: str, update: dict[str, Any]) -> None:
        dimensions = self._dae.dimensions(update["base"])

        def store(at: tuple[Index, ...]) -> None:
            where = self._expressions.subscripts.base_positions(update["subscripts"], dimensions, at)
            value = self._expressions.element(update["value"], at)
            self._expressions.subscripts.store(name, dimensions, where, value)

        self._expressions.loops.for_each(self._dae.dimensions(update["value"]), store)


def _inputs(update: dict[str, Any]) -> list[int]:
    """Return the expressions that an element assignment reads besides the array itself."""
    return [update["value"], *(s["expression"] for s in update["subscripts"] if "expression" in s)]
