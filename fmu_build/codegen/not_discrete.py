"""Discrete variables and conditions of when-clauses whose expressions change between events.

They are invalid (Modelica 3.6, section 3.8.4): a relation triggers an event, but not within a function or
noEvent(). rumoca reports a variable only if the model reads it. Otherwise the variable would keep its first
value, and the clause would never become active.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fmu_build.codegen.functions.calls import operands
from fmu_build.codegen.lowered import LoweredModel

_RELATIONS = frozenset({"less", "less_equal", "greater", "greater_equal", "equal", "not_equal"})
_WITH_EVENTS = frozenset({"integer", "floor", "ceil", "div"})
_VALUES_OF_EVENTS = frozenset({"pre", "previous", "edge", "change", "sample", "initial", "terminal", "hold"})
_OF_SIZES = frozenset({"size", "ndims"})
_CONTINUOUS = frozenset({"state", "derivative", "algebraic", "input"})


def reject_continuous_definitions(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first discrete expression that changes between events."""
    for what, number, provenance in _discrete_expressions(model):
        if (changing := _changing(model, number)) is not None:
            raise model.unsupported(
                f"{what} depends on {changing} without an event; relations within functions and noEvent() "
                "trigger none: compare outside of them, or compute it in a when-clause",
                provenance["span"],
            )


def _discrete_expressions(model: LoweredModel) -> Iterator[tuple[str, int, dict[str, Any]]]:
    """Yield each expression that must not change between events: what it defines, its number, its place."""
    variables = {entry["id"]: entry["name"] for entry in model.dae["variables"]}
    systems = model.dae["systems"]
    for owner in systems["discrete_values"]["owners"]:
        names = ", ".join(variables[target] for target in owner["targets"])
        for branch in owner["branches"]:
            if branch["activation"]["kind"] == "always":
                for value in branch["values"]:
                    yield f"the discrete variable {names}", value["expression"], value["provenance"]
    for row in systems["discrete_real"]["residuals"]:
        if row["activation"]["kind"] == "always":
            yield "the value of a discrete Real", row["residual"], row["provenance"]
    for condition in _conditions_of_clauses(systems):
        if condition["operation"]["kind"] == "discrete":
            expression = condition["operation"]["expression"]
            yield "the condition of a when-clause", expression, condition["provenance"]


def _conditions_of_clauses(systems: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the conditions of when-clauses and their parts, but not those of if-equations inside them."""
    conditions = {entry["id"]: entry for entry in systems["conditions"]["conditions"]}
    branches = [branch for owner in systems["discrete_values"]["owners"] for branch in owner["branches"]]
    activations = [entry["activation"] for entry in (*branches, *systems["discrete_real"]["residuals"])]
    pending = [activation["trigger"] for activation in activations if activation["kind"] == "when"]
    actions = systems["events"]["actions"]
    pending += [action["guard"] for action in actions if action["operation"]["kind"] != "assert"]
    while pending:
        condition = conditions.pop(pending.pop(), None)
        if condition is None:
            continue
        yield condition
        operation = condition["operation"]
        parts = [operation[name] for name in ("condition", "lhs", "rhs") if name in operation]
        is_inside = operation["kind"] == "and" and condition["provenance"]["origin"] != "source"
        pending += parts[:1] if is_inside else parts


def _changing(model: LoweredModel, number: int, *, literal: bool = False) -> str | None:
    """Return the name of a variable through which an expression changes between events, or None.

    Args:
        model: the model
        number: of the expression
        literal: whether the expression is within noEvent(), where relations make no events
    """
    operation = model.dae["expressions"][number]["operation"]
    if operation["kind"] == "coordinate":
        return _continuous(model, operation["coordinate"])
    builtin = operation.get("builtin")
    if builtin in _VALUES_OF_EVENTS or builtin in _OF_SIZES:
        return None
    if not literal and (operation.get("operator") in _RELATIONS or builtin in _WITH_EVENTS):
        return None
    literal = literal or builtin == "no_event"
    found = (_changing(model, operand, literal=literal) for operand in operands(operation))
    return next((name for name in found if name is not None), None)


def _continuous(model: LoweredModel, coordinate: dict[str, Any]) -> str | None:
    if coordinate["kind"] == "time":
        return "time"
    if coordinate["kind"] not in _CONTINUOUS:
        return None
    variable = next(entry for entry in model.dae["variables"] if entry["id"] == coordinate["id"])
    return variable["name"] if variable["variability"] == "continuous" else None
