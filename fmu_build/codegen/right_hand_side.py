"""What the integrator computes thousands of times a run, without what can be computed once.

A division takes several times as long as a product, and the next stage of the integrator waits for it: where
only parameters decide the divisor, the derivatives are multiplied by its reciprocal. The reciprocal, and
other costly parts that only parameters decide, become slots of p, computed with the dependent parameters.

What a zero crossing reads is left as it stands: ``x/L >= 1`` must hold where x equals L.
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
    """The derivatives and, in addition, the zero crossings."""

    derivatives: tuple[Expression, ...]
    for_derivatives: tuple[Step, ...]
    """The algebraic equations that the derivatives need, in order."""
    for_roots: tuple[Step, ...]
    """Those that the zero crossings need beside them."""
    parts: Mapping[Expression, int]
    """What only parameters decide, and its slot of p."""


def arrange(equations: Equations, changing: Collection[int]) -> RightHandSide:
    """The right-hand side of a model; `changing` has the slots of p that are no parameters."""
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
    """The equations with the parts as dependent parameters at the end of p."""
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
    """The nodes that parameters decide, and nothing but parameters and literals."""
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
    """The largest parts that parameters decide, of those that more than a few products and sums go into."""
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
