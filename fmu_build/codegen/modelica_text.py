"""Expressions with the names that the Modelica source gives, for messages to people."""

from __future__ import annotations

from fmu_build.codegen import expression as ex
from fmu_build.codegen.c_expression import Writer
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.lowered import LoweredModel


def modelica_texts(model: LoweredModel, equations: Equations) -> Writer:
    """A writer that calls variables what they are called in the model; memories stay numbered."""
    names: dict[Expression, str] = {ex.TIME: "time"}
    names |= {ex.p(index): f"memory[{index}]" for index in range(equations.n_p)}
    for text, binding in model.solve["layout"]["bindings"].items():
        ((store, place),) = binding.items()
        names[ex.y(place["index"]) if store == "Y" else ex.p(place["index"])] = text
    return Writer(names)
