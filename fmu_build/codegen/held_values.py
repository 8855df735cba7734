"""Discrete variables keep the value from before an event unless a when-clause sets them.

rumoca writes the present value for the value that a variable keeps. While the equations of an event settle,
a condition can be true in passing, until another equation has its new value, as ``edge(tick) and n == 0``
beside ``n = if edge(tick) then pre(n) + 1 else pre(n)``. What its when-clause has set by then must be undone.
"""

from __future__ import annotations

from dataclasses import replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.equations import DiscreteRow, Equations


def with_values_from_before(equations: Equations) -> Equations:
    """Return the equations with pre(v) in place of a held v; adds slots for values of pre() that lack one."""
    previous = {source: slot for slot, source in equations.pre}
    n_p = equations.n_p
    rows: list[DiscreteRow] = []
    for row in equations.discrete:
        if row.kind == "assign" and row.holds:
            if row.slot not in previous:
                previous[row.slot] = n_p
                n_p += 1
            held = {ex.leaf(row.slot): ex.p(previous[row.slot])}
            rows.append(replace(row, value=ex.substitute(row.value, held)))
        else:
            rows.append(row)
    return replace(
        equations,
        n_p=n_p,
        discrete=tuple(rows),
        pre=tuple((slot, source) for source, slot in previous.items()),
        relations=replace(equations.relations, n_p=n_p),
    )
