"""Comparisons within noEvent(), which trigger no event.

rumoca generates no zero crossing for comparisons of time and parameters, for those within another comparison,
and for those of a continuous variable with a discrete one that a clause with sample() sets: outside noEvent()
they are events, inside they are evaluated literally. Its Solve IR does not distinguish the two, but the DAE
does.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from fmu_build.codegen.dae_expression import plain_expression
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.calls import operands
from fmu_build.codegen.lowered import LoweredModel

_ORDER = frozenset({"less", "less_equal", "greater", "greater_equal"})
_CONTINUOUS = frozenset({"time", "state", "derivative", "algebraic", "input"})


def literal_comparisons(model: LoweredModel) -> frozenset[Expression]:
    """Return the comparisons of time and parameters that occur only within noEvent()."""
    operations = [entry["operation"] for entry in model.dae["expressions"]]
    guarded = [one for operation in operations if _is_no_event(operation) for one in operands(operation)]
    if not guarded:
        return frozenset()
    used = {one for operation in operations for one in operands(operation)}
    roots = (number for number in range(len(operations)) if number not in used)
    watched = _comparisons(model, _reached(operations, roots, into_no_event=False))
    return _comparisons(model, _reached(operations, guarded, into_no_event=True)) - watched


def inner_comparisons(model: LoweredModel) -> tuple[bool, bool]:
    """Return whether comparisons that trigger events contain others that do, and others that do not."""
    operations = [entry["operation"] for entry in model.dae["expressions"]]
    outer = [number for number, operation in enumerate(operations) if operation.get("operator") in _ORDER]
    inside = [one for number in outer for one in operands(operations[number])]
    watched = _reached(operations, inside, into_no_event=False)
    literal = _reached(operations, inside, into_no_event=True) - watched
    return bool(watched.intersection(outer)), bool(literal.intersection(outer))


def comparisons_with_discrete(model: LoweredModel) -> tuple[bool, bool]:
    """Whether comparisons of continuous with discrete variables occur that trigger events, and others."""
    operations = [entry["operation"] for entry in model.dae["expressions"]]
    used = {one for operation in operations for one in operands(operation)}
    roots = (number for number in range(len(operations)) if number not in used)
    watched = _reached(operations, roots, into_no_event=False)
    found = {number for number in range(len(operations)) if _mixes(operations, number)}
    return bool(found & watched), bool(found - watched)


def _mixes(operations: list[dict[str, Any]], number: int) -> bool:
    """Whether this is an order comparison that reads discrete variables and others that change."""
    if operations[number].get("operator") not in _ORDER:
        return False
    inside = (
        operations[one] for one in _reached(operations, operands(operations[number]), into_no_event=True)
    )
    kinds = {one["coordinate"]["kind"] for one in inside if one["kind"] == "coordinate"}
    return any("discrete" in kind for kind in kinds) and not kinds.isdisjoint(_CONTINUOUS)


def _is_no_event(operation: dict[str, Any]) -> bool:
    return operation.get("builtin") == "no_event"


def _reached(operations: list[dict[str, Any]], roots: Iterable[int], *, into_no_event: bool) -> set[int]:
    """Return the numbers of the expressions and of all their subexpressions."""
    reached: set[int] = set()
    pending = list(roots)
    while pending:
        number = pending.pop()
        if number in reached or (_is_no_event(operations[number]) and not into_no_event):
            continue
        reached.add(number)
        pending.extend(operands(operations[number]))
    return reached


def _comparisons(model: LoweredModel, numbers: Iterable[int]) -> frozenset[Expression]:
    entries = model.dae["expressions"]
    found = (plain_expression(model, n) for n in numbers if entries[n]["operation"].get("operator") in _ORDER)
    return frozenset(one for one in found if one is not None)
