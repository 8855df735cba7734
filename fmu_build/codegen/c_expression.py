"""Write expressions as C text."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression

_CONDITIONAL, _OR, _AND, _EQUAL, _ORDER, _SUM, _PRODUCT, _UNARY, PRIMARY = range(9)

_INFIX = {
    "Add": ("+", _SUM),
    "Sub": ("-", _SUM),
    "Mul": ("*", _PRODUCT),
    "Div": ("/", _PRODUCT),
    "Lt": ("<", _ORDER),
    "Le": ("<=", _ORDER),
    "Gt": (">", _ORDER),
    "Ge": (">=", _ORDER),
    "Eq": ("==", _EQUAL),
    "Ne": ("!=", _EQUAL),
}
_FUNCTIONS = {
    "Abs": "fabs",
    "Sign": "sign",
    "Sqrt": "sqrt",
    "Exp": "exp",
    "Log": "log",
    "Log10": "log10",
    "Sin": "sin",
    "Cos": "cos",
    "Tan": "tan",
    "Asin": "asin",
    "Acos": "acos",
    "Atan": "atan",
    "Sinh": "sinh",
    "Cosh": "cosh",
    "Tanh": "tanh",
    "Floor": "floor",
    "Ceil": "ceil",
    "Trunc": "trunc",
    "Pow": "pow",
    "Atan2": "atan2",
    "Min": "fmin",
    "Max": "fmax",
}


def shared_nodes(roots: Iterable[Expression]) -> frozenset[Expression]:
    """Return the common subexpressions of `roots` that are worth a variable."""
    roots = tuple(roots)
    uses = Counter(argument for node in ex.walk(*roots) for argument in node.arguments)
    uses.update(roots)
    return frozenset(node for node, count in uses.items() if count > 1 and _is_worth_a_variable(node))


def _is_worth_a_variable(node: Expression) -> bool:
    if node.operator == "call":
        return True
    return bool(node.arguments) and not (node.operator in ("Neg", "Not") and not node.arguments[0].arguments)


class Writer:
    """Writes expressions as C; a node in `names` is written as its name."""

    def __init__(self, names: Mapping[Expression, str]) -> None:
        self._names = names

    def text(self, node: Expression) -> str:
        """Return `node` as a C expression of type double."""
        return self._text(node)[0]

    def _text(self, node: Expression) -> tuple[str, int]:
        name = self._names.get(node)
        if name is not None:
            return name, PRIMARY
        operator = node.operator
        if operator == "number":
            return _number(node.value)
        if operator in _INFIX:
            return self._infix(node)
        if operator in ("And", "Or", "Not"):
            return self._truth(node)
        if operator == "Neg":
            return f"-{self._within(node.arguments[0], _UNARY + 1)}", _UNARY
        if operator == "Select":
            return self._select(node)
        if operator in _FUNCTIONS:
            arguments = ", ".join(self.text(argument) for argument in node.arguments)
            return f"{_FUNCTIONS[operator]}({arguments})", PRIMARY
        raise AssertionError(f"no name for {operator} {node.payload}")

    def _within(self, node: Expression, level: int) -> str:
        text, own = self._text(node)
        return text if own >= level else f"({text})"

    def _infix(self, node: Expression) -> tuple[str, int]:
        symbol, level = _INFIX[node.operator]
        a, b = node.arguments
        # Floating-point addition and multiplication are not associative: the right operand keeps parentheses.
        return f"{self._within(a, level)} {symbol} {self._within(b, level + 1)}", level

    def _select(self, node: Expression) -> tuple[str, int]:
        condition, if_true, if_false = node.arguments
        return (
            f"{self._condition(condition, _OR)} ? {self._within(if_true, _OR)} "
            f": {self._within(if_false, _CONDITIONAL)}"
        ), _CONDITIONAL

    def _truth(self, node: Expression) -> tuple[str, int]:
        if node.operator == "Not":
            return f"!{self._condition(node.arguments[0], PRIMARY)}", _UNARY
        symbol, level = ("&&", _AND) if node.operator == "And" else ("||", _OR)
        # && inside || gets parentheses, because compilers warn without them.
        a, b = (self._condition(argument, _EQUAL) for argument in node.arguments)
        return f"{a} {symbol} {b}", level

    def _condition(self, node: Expression, level: int) -> str:
        """Write a truth value as a C condition: a comparison as it is, any other value compared with zero."""
        if node.operator in ex.TRUTH and node not in self._names:
            return self._within(node, level)
        text = f"{self._within(node, _EQUAL + 1)} != 0.0"
        return text if level <= _EQUAL else f"({text})"


def _number(value: float) -> tuple[str, int]:
    if math.isinf(value):
        return ("INFINITY", PRIMARY) if value > 0 else ("-INFINITY", _UNARY)
    if math.isnan(value):
        return "NAN", PRIMARY
    text = repr(value)
    return text, _UNARY if value < 0 else PRIMARY
