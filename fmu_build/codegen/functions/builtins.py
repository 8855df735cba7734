"""Translate operators and built-in functions in bodies of Modelica functions, element by element."""

from __future__ import annotations

from collections.abc import Callable

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.dae import FunctionDae, Operation
from fmu_build.codegen.functions.index import Position
from fmu_build.codegen.functions.loops import REDUCTIONS, ArrayLoops
from fmu_build.codegen.functions.subscripts import Subscripts

OPERATORS = {
    "add": "Add",
    "subtract": "Sub",
    "multiply": "Mul",
    "divide": "Div",
    "power": "Pow",
    "and": "And",
    "or": "Or",
    "less": "Lt",
    "less_equal": "Le",
    "greater": "Gt",
    "greater_equal": "Ge",
    "equal": "Eq",
    "not_equal": "Ne",
}
UNARY_FUNCTIONS = {name.lower(): name for name in ex.UNARY - {"Neg", "Not", "Trunc"}} | {"integer": "Floor"}

At = tuple[Position, ...]


class Builtins:
    """Applies operators; `element` returns an element of an operand."""

    def __init__(
        self,
        dae: FunctionDae,
        subscripts: Subscripts,
        loops: ArrayLoops,
        element: Callable[[int, At], Expression],
    ) -> None:
        self._dae = dae
        self._subscripts = subscripts
        self._loops = loops
        self._element = element

    def unary(self, number: int, operation: Operation, at: At) -> Expression:
        """Apply ``+a``, ``-a`` or ``not a``."""
        name = {"negate": "Neg", "not": "Not", "plus": None}.get(operation["operator"], "")
        if name == "":
            raise self._dae.unsupported(f"operator {operation['operator']}", number)
        operand = self._element(operation["operand"], at)
        return operand if name is None else ex.unary(name, operand)

    def binary(self, number: int, operation: Operation, at: At) -> Expression:
        """Apply an operator with broadcasting of scalars, or multiply matrices."""
        operator, a, b = operation["operator"], operation["lhs"], operation["rhs"]
        if operator == "multiply" and self._dae.dimensions(a) and self._dae.dimensions(b):
            return self._matrix_product(a, b, at)
        name = OPERATORS.get(operator.removeprefix("elementwise_"))
        if name is None or (operator == "power" and at):
            raise self._dae.unsupported(f"operator {operator} of {len(at)}-dimensional operands", number)
        operands = self._broadcast((a, b), at)
        return Expression(name, operands) if name in ex.COMPARE else ex.binary(name, *operands)

    def _broadcast(self, numbers: tuple[int, int], at: At) -> tuple[Expression, Expression]:
        a, b = (self._element(number, at if self._dae.dimensions(number) else ()) for number in numbers)
        return a, b

    def _matrix_product(self, a: int, b: int, at: At) -> Expression:
        """Return an element of the matrix product: the sum over a's last and b's first axis."""
        outer = len(self._dae.dimensions(a)) - 1
        left, right = at[:outer], at[outer:]
        return self._loops.reduced(
            "sum",
            self._dae.dimensions(a)[-1:],
            lambda k: ex.binary("Mul", self._element(a, (*left, *k)), self._element(b, (*k, *right))),
        )

    def builtin(self, number: int, operation: Operation, at: At) -> Expression:
        """Apply a built-in function of Modelica, scalar or array."""
        name, arguments = operation["builtin"], operation["arguments"]
        if name in UNARY_FUNCTIONS:
            return ex.unary(UNARY_FUNCTIONS[name], self._element(arguments[0], at))
        if len(arguments) == 2 and name in ("min", "max", "atan2"):
            a, b = arguments
            return ex.binary(name.capitalize(), *self._broadcast((a, b), at))
        if name in ("div", "mod", "rem"):
            a, b = arguments
            return _division(name, *self._broadcast((a, b), at))
        if name in REDUCTIONS:
            (array,) = arguments
            return self._loops.reduced(name, self._dae.dimensions(array), lambda k: self._element(array, k))
        if name in ("no_event", "smooth"):
            return self._element(arguments[-1], at)
        return self._of_array(number, operation, at)

    def _of_array(self, number: int, operation: Operation, at: At) -> Expression:
        """Apply a built-in function that constructs or transposes an array, or returns its size."""
        match operation["builtin"]:
            case "zeros" | "ones":
                return ex.number(operation["builtin"] == "ones")
            case "fill":
                return self._element(operation["arguments"][0], ())
            case "transpose":
                return self._element(operation["arguments"][0], (at[1], at[0], *at[2:]))
            case "identity":
                return equal(*(self._subscripts.value(position) for position in at))
            case "size" if (size := self._subscripts.integer(number, at)) is not None:
                return ex.number(size.constant)
        raise self._dae.unsupported(f"{operation['builtin']}()", number)


def equal(a: Expression, b: Expression) -> Expression:
    """Return ``a == b``, evaluated here if both are numbers."""
    return ex.number(a.value == b.value) if a.is_number and b.is_number else Expression("Eq", (a, b))


def _division(name: str, a: Expression, b: Expression) -> Expression:
    """Return an integer division or its remainder (Modelica 3.6, section 3.7.2)."""
    quotient = ex.binary("Div", a, b)
    if name == "div":
        return ex.unary("Trunc", quotient)
    rounded = ex.unary("Floor" if name == "mod" else "Trunc", quotient)
    return ex.binary("Sub", a, ex.binary("Mul", rounded, b))
