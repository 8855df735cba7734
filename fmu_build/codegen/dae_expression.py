"""Simple expressions of the DAE stage: start values and comparisons of time."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any, Final

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.builtins import OPERATORS, UNARY_FUNCTIONS
from fmu_build.codegen.lowered import LoweredModel

_OF_MATH: Final = (
    *("Sqrt", "Exp", "Log", "Log10", "Floor", "Ceil", "Trunc", "Sin", "Cos", "Tan"),
    *("Asin", "Acos", "Atan", "Atan2", "Sinh", "Cosh", "Tanh", "Pow"),
)
_NUMBERS: Final[Mapping[str, Callable[..., float]]] = {
    **{name: getattr(math, name.lower()) for name in _OF_MATH},
    "Abs": abs,
    "Add": operator.add,
    "And": lambda a, b: a and b,
    "Div": operator.truediv,
    "Eq": operator.eq,
    "Ge": operator.ge,
    "Gt": operator.gt,
    "Le": operator.le,
    "Lt": operator.lt,
    "Max": max,
    "Min": min,
    "Mul": operator.mul,
    "Ne": operator.ne,
    "Neg": operator.neg,
    "Not": operator.not_,
    "Or": lambda a, b: a or b,
    "Select": lambda condition, a, b: a if condition else b,
    "Sign": lambda a: (a > 0) - (a < 0),
    "Sub": operator.sub,
}


def plain_expression(model: LoweredModel, number: int, element: int = 0) -> Expression | None:
    """Return one element, by row-major offset, of the DAE's expression `number` in parameters and time.

    Returns None for anything but plain arithmetic, such as a call of a Modelica function.
    """
    entry = model.dae["expressions"][number]
    operation = entry["operation"]

    def value(operand: int) -> Expression | None:
        is_array = bool(model.dae["expressions"][operand]["value_type"]["dimensions"])
        return plain_expression(model, operand, element if is_array else 0)

    match operation["kind"]:
        case "literal":
            ((_, content),) = operation["value"].items()
            return ex.number(content) if isinstance(content, (bool, int, float)) else None
        case "coordinate":
            return _coordinate(model, operation["coordinate"], element)
        case "index" if not entry["value_type"]["dimensions"]:
            place = _place(model, operation)
            return None if place is None else plain_expression(model, operation["base"], place)
        case "builtin" if operation["builtin"] == "fill":
            return value(operation["arguments"][0])
        case "array" if "elements" in operation:
            part, inside = divmod(element, math.prod(entry["value_type"]["dimensions"][1:]))
            return plain_expression(model, operation["elements"][part], inside)
    name, numbers = _operator(model, operation)
    operands = [found for found in map(value, numbers) if found is not None]
    return _applied(name, operands) if name and len(operands) == len(numbers) else None


def number_of(expression: Expression, start_of: Callable[[int], float]) -> float:
    """Return the value of an expression; `start_of` gives that of a parameter by its place in p.

    Raises:
        ArithmeticError, ValueError: it has none, as 1/0
        KeyError: it depends on something else, or has an operator that is not known here
    """
    if expression.is_number:
        return expression.value
    if expression.operator == "p":
        return start_of(expression.index)
    operands = [number_of(one, start_of) for one in expression.arguments]
    return float(_NUMBERS[expression.operator](*operands))


def _operator(model: LoweredModel, operation: dict[str, Any]) -> tuple[str, list[int]]:
    """Return the name and operands of an element-wise operation; for any other, the name is ""."""
    match operation["kind"]:
        case "conditional":
            return "Select", operation["operands"]
        case "unary":
            return {"negate": "Neg", "not": "Not"}.get(operation["operator"], ""), [operation["operand"]]
        case "binary" if not _is_matrix_product(model, operation):
            name = OPERATORS.get(operation["operator"].removeprefix("elementwise_"), "")
            return name, [operation["lhs"], operation["rhs"]]
        case "builtin" if operation["builtin"] in UNARY_FUNCTIONS:
            return UNARY_FUNCTIONS[operation["builtin"]], operation["arguments"]
        case "builtin" if (
            operation["builtin"] in ("min", "max", "atan2") and len(operation["arguments"]) == 2
        ):
            return operation["builtin"].capitalize(), operation["arguments"]
    return "", []


def _applied(name: str, operands: list[Expression]) -> Expression:
    if name == "Select":
        *arms, result = operands
        for condition, chosen in reversed(list(zip(arms[::2], arms[1::2], strict=True))):
            result = ex.select(condition, chosen, result)
        return result
    if name in ex.COMPARE:
        return Expression(name, tuple(operands))
    return ex.unary(name, *operands) if len(operands) == 1 else ex.binary(name, *operands)


def _place(model: LoweredModel, operation: dict[str, Any]) -> int | None:
    """Return the row-major offset of the element that an index selects; None if it is not constant."""
    place = 0
    dimensions = model.dae["expressions"][operation["base"]]["value_type"]["dimensions"]
    for size, subscript in zip(dimensions, operation["subscripts"], strict=True):
        index = plain_expression(model, subscript["expression"]) if subscript["kind"] == "index" else None
        if index is None or not index.is_number:
            return None
        place = place * size + round(index.value) - 1
    return place


def _is_matrix_product(model: LoweredModel, operation: dict[str, Any]) -> bool:
    sides = (model.dae["expressions"][operation[side]]["value_type"] for side in ("lhs", "rhs"))
    return operation["operator"] in ("multiply", "power") and all(side["dimensions"] for side in sides)


def _coordinate(model: LoweredModel, coordinate: dict[str, Any], element: int) -> Expression | None:
    if coordinate["kind"] == "time":
        return ex.TIME
    if coordinate["kind"] not in ("parameter", "constant"):
        return None
    variable = next(v for v in model.dae["variables"] if v["id"] == coordinate["id"])
    slot = model.slots.get(variable["scalar_names"][element])
    if slot is not None:
        return ex.leaf(slot) if slot[0] == "p" else None
    binding = variable["attributes"]["binding"]  # of a constant, which is a number in the Solve IR
    return None if binding is None else plain_expression(model, binding, element)
