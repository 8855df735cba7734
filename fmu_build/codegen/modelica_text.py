"""Expressions with the names that the Modelica source gives, for messages to people."""

from __future__ import annotations

from fmu_build.codegen import expression as ex
from fmu_build.codegen.c_expression import PRIMARY, Writer
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.lowered import LoweredModel


class _ModelicaWriter(Writer):
    """Calls have no name of their own in a message: they are written as they are called."""

    def _text(self, node: Expression) -> tuple[str, int]:
        if node.operator != "call":
            return super()._text(node)
        assert isinstance(node.payload, tuple)
        function, result = node.payload
        arguments = ", ".join(self.text(argument) for argument in node.arguments)
        return f"{function}({arguments})" + (f"[{result + 1}]" if result else ""), PRIMARY


def modelica_texts(model: LoweredModel, equations: Equations) -> Writer:
    """A writer that calls variables what they are called in the model; memories stay numbered."""
    names: dict[Expression, str] = {ex.TIME: "time"}
    names |= {ex.p(index): f"memory[{index}]" for index in range(equations.n_p)}
    for text, binding in model.solve["layout"]["bindings"].items():
        ((store, place),) = binding.items()
        names[ex.y(place["index"]) if store == "Y" else ex.p(place["index"])] = text
    return _ModelicaWriter(names)
