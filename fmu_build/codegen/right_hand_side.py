"""Hoist costly expressions of parameters out of the right-hand side, the hot path of every simulation.

A division takes several times as long as a product, and the next stage of the integrator waits for it. A
division by an expression of parameters becomes a product with its reciprocal. Reciprocals and other costly
expressions of parameters become slots of p ("parts"), computed together with the dependent parameters.

Divisions that a zero crossing reads are kept: ``x/L >= 1`` must hold where x equals L.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, Step, needed
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import ONE, Expression, binary

_CHEAP = {"Add", "Sub", "Mul", "Neg", "Not", "Abs", "Sign", "Min", "Max", "And", "Or", "Select"} | ex.COMPARE


@dataclass(frozen=True)
class RightHandSide:
    """The derivatives, and the steps that they and the zero crossings need."""

    derivatives: tuple[Expression, ...]
    for_derivatives: tuple[Step, ...]
    """The algebraic equations that the derivatives need, in topological order."""
    for_roots: tuple[Step, ...]
    """The additional ones that the zero crossings need."""
    parts: Mapping[Expression, int]
    """The hoisted expressions of parameters, and their slots of p."""


def arrange(equations: Equations, changing: Collection[int]) -> RightHandSide:
    """Return the right-hand side of a model; `changing` are the slots of p that are not parameters."""
    roots = equations.relations.roots
    read_by_roots = needed(equations.algebraics, roots)
    for_derivatives = tuple(
        replace(step, value=_with_reciprocals(step.value, changing))
        if isinstance(step, Assignment) and step not in read_by_roots
        else step
        for step in needed(equations.algebraics, equations.derivatives)
    )
    computed = {unknown for step in for_derivatives for unknown in step.unknowns}
    for_roots = tuple(step for step in read_by_roots if computed.isdisjoint(step.unknowns))
    derivatives = tuple(_with_reciprocals(e, changing) for e in equations.derivatives)
    steps = [step for step in (*for_derivatives, *for_roots) if isinstance(step, Assignment)]
    parts = _costly_parts([*(step.value for step in steps), *derivatives, *roots], changing)
    return RightHandSide(
        derivatives,
        for_derivatives,
        for_roots,
        {part: equations.n_p + number for number, part in enumerate(parts)},
    )


def with_parts(equations: Equations, parts: Mapping[Expression, int]) -> Equations:
    """Append the parts to the dependent parameters and to p."""
    rows = tuple((slot, part) for part, slot in parts.items())
    return replace(
        equations,
        n_p=equations.n_p + len(parts),
        dependent_parameters=(*equations.dependent_parameters, *rows),
    )


def _with_reciprocals(value: Expression, changing: Collection[int]) -> Expression:
    constant = _constants([value], changing)
    done: dict[Expression, Expression] = {}
    for node in ex.walk(value):
        arguments = tuple(done[argument] for argument in node.arguments)
        if node.operator == "Div" and node.arguments[1] in constant and node not in constant:
            done[node] = binary("Mul", arguments[0], binary("Div", ONE, node.arguments[1]))
        else:
            done[node] = ex.rebuild(node, arguments)
    return done[value]


def _constants(expressions: Iterable[Expression], changing: Collection[int]) -> set[Expression]:
    """Return the nodes that depend only on parameters and literals; calls are excluded."""
    found: set[Expression] = set()
    for node in ex.walk(*expressions):
        if node.operator == "p":
            if node.index not in changing:
                found.add(node)
        elif (
            node.operator != "call"
            and not found.isdisjoint(node.arguments)
            and all(argument in found or argument.is_number for argument in node.arguments)
        ):
            found.add(node)
    return found


def _costly_parts(expressions: Iterable[Expression], changing: Collection[int]) -> list[Expression]:
    """Return the largest subexpressions of parameters that contain an operation not in `_CHEAP`."""
    expressions = list(expressions)
    constant = _constants(expressions, changing)
    found: dict[Expression, None] = {}
    seen: set[Expression] = set()
    waiting = expressions[::-1]
    while waiting:
        node = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        if node not in constant:
            waiting.extend(reversed(node.arguments))
        elif any(inner.arguments and inner.operator not in _CHEAP for inner in ex.walk(node)):
            found[node] = None
    return list(found)
