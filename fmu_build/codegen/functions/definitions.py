"""Definitions of an algorithm: the values they read, which of them are live, and equality of algorithms."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from fmu_build.codegen.functions.calls import operands

Statement = Mapping[str, Any]
Expressions = Mapping[int, Mapping[str, Any]]
"""The expressions of the DAE by id."""


def flattened(statements: Sequence[Statement]) -> Iterator[Statement]:
    """Yield all statements, including those inside loops and groups."""
    for statement in statements:
        yield statement
        yield from flattened(statement.get("statements", ()))


def assertions(function: Mapping[str, Any]) -> int:
    """Return the number of assert statements; each adds a truth value to the results of the function."""
    return sum(statement["kind"] == "assertion" for statement in flattened(function["statements"]))


def reads(expressions: Expressions, roots: Iterable[int]) -> set[tuple[int, int]]:
    """Return the variables that expressions read, each with its definition."""
    found: set[tuple[int, int]] = set()
    waiting = list(roots)
    seen = set(waiting)
    while waiting:
        operation = expressions[waiting.pop()]["operation"]
        if operation["kind"] == "function_value":
            found.add((operation["value"], operation["definition"]))
        new = set(operands(operation)) - seen
        seen |= new
        waiting.extend(new)
    return found


def live_definitions(function: Mapping[str, Any], expressions: Expressions) -> frozenset[int]:
    """Return the live definitions: those on which a result or an assertion depends."""
    conditions = [s["condition"] for s in flattened(function["statements"]) if s["kind"] == "assertion"]
    waiting = [*function["results"], *(definition for _, definition in reads(expressions, conditions))]
    carried = _carried(function["folds"])
    live: set[int] = set()
    while waiting:
        definition = waiting.pop()
        if definition in live:
            continue
        live.add(definition)
        if definition in carried:
            waiting.extend(carried[definition])
        else:
            rhs = function["definitions"][definition]["rhs"]
            waiting.extend(read for _, read in reads(expressions, [rhs]))
    return frozenset(live)


def _carried(folds: Iterable[Mapping[str, Any]]) -> dict[int, tuple[int, int]]:
    """Map a definition at the start of an iteration or after a loop to its two sources."""
    carried: dict[int, tuple[int, int]] = {}
    for fold in folds:
        starts, updates = fold["initial_definitions"], fold["update_definitions"]
        for place, ends in enumerate(zip(starts, updates, strict=True)):
            carried[fold["parameter_definitions"][place]] = ends
            carried[fold["output_definitions"][place]] = ends
    return carried


def are_equal(expressions: Expressions, a: int, b: int) -> bool:
    """Return whether two expressions are structurally equal."""
    if a == b:
        return True
    one, other = expressions[a]["operation"], expressions[b]["operation"]
    inner = list(operands(one)), list(operands(other))
    return (
        _head(one) == _head(other)
        and len(inner[0]) == len(inner[1])
        and all(are_equal(expressions, x, y) for x, y in zip(*inner, strict=True))
    )


def _head(operation: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of an operation other than its operands."""
    names = (
        "kind",
        "operator",
        "builtin",
        "function",
        "output",
        "coordinate",
        "definition",
        "domain",
        "field",
    )
    head = {name: operation.get(name) for name in names}
    if operation["kind"] in ("literal", "function_value"):
        head["value"] = operation["value"]
    head["subscripts"] = [subscript["kind"] for subscript in operation.get("subscripts", ())]
    return head


def bodies(dae: Mapping[str, Any]) -> object:
    """Return the algorithms of all functions without source positions and expression ids.

    Two models have equal functions if these compare equal.
    """
    expressions = {expression["id"]: expression for expression in dae["expressions"]}
    loops = {domain["id"]: domain["domain"]["binders"] for domain in dae["domains"]}
    numbers: dict[int, int] = {}
    operations: list[object] = []

    def number(expression: int) -> int:
        if expression not in numbers:
            operation = expressions[expression]["operation"]
            inner = [number(operand) for operand in operands(operation)]
            operations.append((_head(operation), loops.get(operation.get("domain", -1)), inner))
            numbers[expression] = len(numbers)
        return numbers[expression]

    functions = [
        (
            function["name"],
            function["results"],
            [(definition["target"], number(definition["rhs"])) for definition in function["definitions"]],
            [(s["kind"], s.get("definition"), s.get("fold")) for s in flattened(function["statements"])],
            [loops[fold["domain"]] for fold in function["folds"]],
        )
        for function in dae["functions"]
    ]
    return functions, operations
