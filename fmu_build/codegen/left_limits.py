"""``pre(y)`` of an algebraic variable: its left limit, for which the runtime solves for y as an event begins.

By then the importer may have set new inputs, so a ``y`` that follows an input is refused.
"""

from __future__ import annotations

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import needed
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.lowered import LoweredModel


def left_limits(equations: Equations) -> list[int]:
    """Return the places in y of the algebraic variables with a pre()."""
    return [index for _, (store, index) in equations.pre if store == "y" and index >= equations.n_states]


def reject_left_limits_of_inputs(model: LoweredModel, equations: Equations) -> None:
    """Raise `UnsupportedModelError` for the first pre() of an algebraic variable that follows an input."""
    inputs = {
        ex.leaf(model.slots[name]): name
        for variable in model.dae["variables"]
        if variable["role"] == "input"
        for name in variable["scalar_names"]
        if name in model.slots
    }
    for index in left_limits(equations):
        steps = needed(equations.algebraics, [ex.y(index)])
        read = ex.leaves(*(value for step in steps for value in step.expressions))
        followed = sorted(inputs[leaf] for leaf in read if leaf in inputs)
        if followed:
            raise model.unsupported(
                f"pre({model.y_names[index]}) is not supported, because it follows the input {followed[0]}, "
                "of which an event knows only the new value; keep the old one in a discrete variable"
            )
