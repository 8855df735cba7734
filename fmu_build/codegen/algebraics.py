"""Algebraic equations in topological order.

rumoca provides residuals and the order of its blocks. Most blocks have one unknown that enters linearly:
these are solved symbolically, so that the C code assigns the unknown. All others are left to Newton's method.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.differentiate import NotDifferentiableError, call_of_tangent, linear_root, partial
from fmu_build.codegen.expression import ZERO, Expression, binary, negate
from fmu_build.codegen.lowered import LoweredModel


@dataclass(frozen=True, slots=True)
class Assignment:
    """``y[unknown] = value``."""

    unknown: int
    value: Expression

    @property
    def unknowns(self) -> tuple[int, ...]:
        """The unknown that the step computes, as an index of y."""
        return (self.unknown,)

    @property
    def expressions(self) -> tuple[Expression, ...]:
        """The expressions that the step evaluates."""
        return (self.value,)


@dataclass(frozen=True, slots=True)
class NewtonBlock:
    """An algebraic loop: residuals that are zero at the solution ``y[unknowns]``, and their Jacobian."""

    unknowns: tuple[int, ...]
    residuals: tuple[Expression, ...]
    jacobian: tuple[tuple[Expression, ...], ...]

    @property
    def expressions(self) -> tuple[Expression, ...]:
        """The expressions that the step evaluates."""
        return self.residuals

    @property
    def is_linear(self) -> bool:
        """Whether the residuals are linear in the unknowns, so that one Newton step solves them."""
        unknowns = {ex.y(index) for index in self.unknowns}
        return all(_is_linear(residual, unknowns) for residual in self.residuals)


Step = Assignment | NewtonBlock


def _is_linear(value: Expression, unknowns: set[Expression]) -> bool:
    moving = set(unknowns)
    for node in ex.walk(value):
        moves = [argument in moving for argument in node.arguments]
        if any(moves):
            if not _keeps_linear(node.operator, moves):
                return False
            moving.add(node)
    return True


def _keeps_linear(operator: str, moves: Sequence[bool]) -> bool:
    """Return whether an operator is linear in those arguments that depend on the unknowns."""
    match operator:
        case "Add" | "Sub" | "Neg":
            return True
        case "Mul":
            return not all(moves)
        case "Div":
            return not moves[1]
        case "Select":
            return not moves[0]
        case _:
            return False


def order(model: LoweredModel, rows: dict[int, Expression], plan: dict[str, Any]) -> tuple[Step, ...]:
    """Solve the algebraic equations `rows` (by row number) block by block, in the order of the plan."""
    steps: list[Step] = []
    for block in plan["blocks"]:
        unknowns = tuple(block["y_indices"])
        residuals = tuple(rows[row] for row in block["rows"])
        if len(unknowns) != len(residuals):
            raise model.unsupported(
                f"an algebraic block has {len(residuals)} equations for {len(unknowns)} unknowns"
            )
        steps.append(_solve(model, unknowns, residuals))
    return _after_what_they_read(model, steps)


def _after_what_they_read(model: LoweredModel, steps: Sequence[Step]) -> tuple[Step, ...]:
    """Return the steps in an order in which each reads only what earlier steps have computed.

    rumoca's order ignores arguments that do not affect the result of a function. The C code, however,
    computes each shared argument once, at its first use, and everything that the argument reads must be known
    there.
    """
    computing = {unknown: step for step in steps for unknown in step.unknowns}
    before = {
        step.unknowns: {
            computing[place].unknowns
            for place in ex.places("y", *step.expressions) - set(step.unknowns)
            if place in computing
        }
        for step in steps
    }
    known: set[tuple[int, ...]] = set()
    for step in steps:
        if not before[step.unknowns] <= known:
            break
        known.add(step.unknowns)
    else:
        return tuple(steps)
    try:
        ordered = tuple(TopologicalSorter(before).static_order())
    except CycleError as error:
        names = model.y_names
        which = ", ".join(sorted({names[unknown] for unknowns in error.args[1] for unknown in unknowns}))
        raise model.unsupported(
            f"an algebraic loop for {which} that only leads through arguments of functions without an effect "
            "is not supported"
        ) from error
    return tuple(computing[unknowns[0]] for unknowns in ordered)


def _solve(model: LoweredModel, unknowns: tuple[int, ...], residuals: tuple[Expression, ...]) -> Step:
    if len(unknowns) == 1:
        value = isolate(residuals[0], ex.y(unknowns[0]))
        if value is not None:
            return Assignment(unknowns[0], value)
    try:
        jacobian = tuple(tuple(partial(r, ex.y(u), call_of_tangent) for u in unknowns) for r in residuals)
    except NotDifferentiableError as error:
        names = model.y_names
        which = ", ".join(names[u] for u in unknowns)
        raise model.unsupported(
            f"the algebraic loop for {which} contains a {error}, which has no derivative"
        ) from error
    return NewtonBlock(unknowns, residuals, jacobian)


def isolate(residual: Expression, unknown: Expression) -> Expression | None:
    """Return the value of `unknown` at which `residual` is zero, or None if it does not enter linearly."""
    value = _undo(residual, unknown, ZERO)
    return linear_root(residual, unknown) if value is None else value


def _undo(node: Expression, unknown: Expression, target: Expression) -> Expression | None:
    """Solve ``node = target`` by inverting one operation after another; the unknown must occur once."""
    while node != unknown:
        holders = [a for a in node.arguments if unknown in ex.leaves(a)]
        if len(holders) != 1 or node.operator not in ("Add", "Sub", "Mul", "Neg"):
            return None
        inner = holders[0]
        if node.operator == "Neg":
            target = negate(target)
        else:
            a, b = node.arguments
            other = b if inner is a else a
            if node.operator == "Mul":
                target = binary("Div", target, other)
            elif node.operator == "Add":
                target = binary("Sub", target, other)
            else:
                target = binary("Add", target, b) if inner is a else binary("Sub", a, target)
        node = inner
    return target


def needed(steps: Sequence[Step], roots: Iterable[Expression]) -> tuple[Step, ...]:
    """Return the steps, in order, on which the expressions depend directly or through other steps."""
    wanted = ex.places("y", *roots)
    kept: list[Step] = []
    for step in reversed(steps):
        if wanted.intersection(step.unknowns):
            kept.append(step)
            wanted |= ex.places("y", *step.expressions)
    return tuple(reversed(kept))


def in_order(rows: Sequence[tuple[int, Expression]]) -> list[tuple[int, Expression]]:
    """Return computed parameters in topological order: each after those that it reads."""
    values = dict(rows)
    ordered: list[tuple[int, Expression]] = []
    visited: set[int] = set()

    def visit(index: int) -> None:
        if index in visited or index not in values:
            return
        visited.add(index)
        for place in sorted(ex.places("p", values[index])):
            visit(place)
        ordered.append((index, values[index]))

    for index, _ in rows:
        visit(index)
    return ordered
