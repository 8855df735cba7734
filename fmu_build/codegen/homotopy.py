"""The homotopy() operator: initialization goes from the simplified expression to the actual one.

rumoca writes ``homotopy(a, s)`` as ``h*a + (1 - h)*s`` with a slot of p for h, whose value is up to the tool
(Modelica 3.6, section 3.7.4). The runtime keeps 1 - h in this slot. When it is 0, as after initialization,
only the actual expression is evaluated, because the simplified one may be undefined.
"""

from __future__ import annotations

from collections.abc import Mapping

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import ONE, Expression

_FACTORS = ("Mul", "Neg")


def deformable(rows: Mapping[int, Expression], slot: int) -> dict[int, Expression]:
    """Return the rows with rumoca's h replaced by 1 - h, the distance from the actual expressions.

    Args:
        rows: rows as written by rumoca
        slot: slot of h; the returned rows expect 1 - h there
    """
    return {number: _deformable(row, ex.p(slot)) for number, row in rows.items()}


def _deformable(row: Expression, h: Expression) -> Expression:
    if h not in ex.leaves(row):
        return row
    open_nodes = {h}
    done: dict[Expression, Expression] = {h: ex.binary("Sub", ONE, h)}

    def closed(node: Expression) -> Expression:
        if node not in open_nodes:
            return done[node]
        return ex.select(h, done[node], ex.substitute(node, {h: ONE}))

    for node in ex.walk(row):
        if node in done:
            continue
        if _is_part_of_sum(node, open_nodes):
            done[node] = ex.rebuild(node, tuple(done[argument] for argument in node.arguments))
            open_nodes.add(node)
        else:
            done[node] = ex.rebuild(node, tuple(closed(argument) for argument in node.arguments))
        if node.operator in ("Add", "Sub") and open_nodes.issuperset(node.arguments):
            done[node] = closed(node)
            open_nodes.discard(node)
    return closed(row)


def _is_part_of_sum(node: Expression, open_nodes: set[Expression]) -> bool:
    """Return whether a node belongs to ``h*a + (1 - h)*s`` in any form that simplification may leave."""
    if node.operator in _FACTORS:
        return not open_nodes.isdisjoint(node.arguments)
    if node.operator not in ("Add", "Sub"):
        return False
    return open_nodes.issuperset(node.arguments) or (
        ONE in node.arguments and not open_nodes.isdisjoint(node.arguments)
    )
