"""Refuse models with jumps that sensitivities would miss, or with event times that depend on an input."""

from __future__ import annotations

from collections.abc import Sequence

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import needed
from fmu_build.codegen.equations import Equations, acting_expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.variables import StoredVariable


def reject_without_sensitivities(
    model: LoweredModel, equations: Equations, stored: Sequence[StoredVariable]
) -> None:
    """Raise `UnsupportedModelError` for a model whose sensitivities would be silently wrong."""
    for node in ex.walk(*acting_expressions(equations)):
        if node.operator == "Sign" and ex.varies(node):
            raise model.unsupported(
                "no sensitivities: sign() of a variable jumps without an event; write it with relations"
            )
    inputs = {
        ex.p(s.index): s.variable.name
        for s in stored
        if s.variable.causality == "input" and s.variable.variability == "continuous"
    }
    roots = (*equations.relations.roots, *equations.relations.time_roots)
    steps = needed(equations.algebraics, roots)
    read = ex.leaves(*roots, *(value for step in steps for value in step.expressions))
    followed = sorted(name for input_leaf, name in inputs.items() if input_leaf in read)
    if followed:
        raise model.unsupported(
            f"no sensitivities: the time of an event depends on the input {followed[0]} directly, "
            "whose slope the importer may not give"
        )
