"""What the definitions of an algorithm read, which of them matter, and what makes two algorithms equal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from fmu_build.codegen.functions.calls import operands

Statement = Mapping[str, Any]
Expressions = Mapping[int, Mapping[str, Any]]
"""The expressions of the DAE by their ids."""


def flattened(statements: Sequence[Statement]) -> Iterator[Statement]:
    """All statements with those inside loops and groups."""
    for statement in statements:
        yield statement
        yield from flattened(statement.get("statements", ()))


def assertions(function: Mapping[str, Any]) -> int:
    """How many assert statements a function has, each of which gives a truth value beside the results."""
    return sum(statement["kind"] == "assertion" for statement in flattened(function["statements"]))


def reads(expressions: Expressions, roots: Iterable[int]) -> set[tuple[int, int]]:
    """The variables that expressions read, each with the definition that is meant."""
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
    """Definitions that a result or an assertion depends on."""
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
    """Values at the start of a turn and after a loop stem from before the loop and from the last turn."""
    carried: dict[int, tuple[int, int]] = {}
    for fold in folds:
        starts, updates = fold["initial_definitions"], fold["update_definitions"]
        for place, ends in enumerate(zip(starts, updates, strict=True)):
            carried[fold["parameter_definitions"][place]] = ends
            carried[fold["output_definitions"][place]] = ends
    return carried


def are_equal(expressions: Expressions, a: int, b: int) -> bool:
    """Whether two expressions are written alike."""
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
    """What an operation has beside the expressions that it reads."""
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
    """The algorithms of all functions, without places in the source and numbers of expressions.

    Two models have equal functions where this compares equal.
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
