"""Simple expressions of the DAE stage: those that start values are given by."""

from __future__ import annotations

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.lowered import LoweredModel

_OPERATORS = {"add": "Add", "subtract": "Sub", "multiply": "Mul", "divide": "Div", "power": "Pow"}


def parameter_expression(model: LoweredModel, number: int) -> Expression | None:
    """Expression `number` of the DAE in terms of scalar parameters; None for anything else."""
    operation = model.dae["expressions"][number]["operation"]
    kind = operation["kind"]
    if kind == "literal":
        ((_, value),) = operation["value"].items()
        return ex.number(value) if isinstance(value, (bool, int, float)) else None
    if kind == "coordinate":
        return _parameter(model, operation["coordinate"])
    if kind == "unary" and operation["operator"] in ("negate", "not"):
        operand = parameter_expression(model, operation["operand"])
        name = "Neg" if operation["operator"] == "negate" else "Not"
        return None if operand is None else ex.unary(name, operand)
    if kind == "binary" and operation["operator"] in _OPERATORS:
        left, right = (parameter_expression(model, operation[side]) for side in ("lhs", "rhs"))
        if left is not None and right is not None:
            return ex.binary(_OPERATORS[operation["operator"]], left, right)
    return None


def _parameter(model: LoweredModel, coordinate: dict[str, object]) -> Expression | None:
    if coordinate["kind"] not in ("parameter", "constant"):
        return None
    variable = next(v for v in model.dae["variables"] if v["id"] == coordinate["id"])
    binding = model.solve["layout"]["bindings"].get(variable["name"], {})
    return (
        ex.p(binding["P"]["index"]) if "P" in binding and not variable["value_type"]["dimensions"] else None
    )
