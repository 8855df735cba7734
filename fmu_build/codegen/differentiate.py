"""Symbolic derivatives of expressions, exact within a branch: relations and conditions count as constant."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import ONE, ZERO, Expression, binary, negate, number, unary

CallTangent = Callable[[Expression, tuple[Expression, ...]], Expression]
"""Maps a function call and the tangents of its arguments to the tangent of its result."""


class NotDifferentiableError(Exception):
    """The expression contains an operation without a known derivative, such as a function call."""


def differentiate(
    root: Expression, seeds: Mapping[Expression, Expression], call_tangent: CallTangent | None = None
) -> Expression:
    """Return the forward-mode tangent of `root` for the leaf tangents in `seeds`; other leaves are constant.

    Raises `NotDifferentiableError` for a function call that depends on a seeded leaf if there is no
    `call_tangent`.
    """
    tangents: dict[Expression, Expression] = {}
    for node in ex.walk(root):
        if node in seeds:
            tangents[node] = seeds[node]
        elif all(tangents[argument] == ZERO for argument in node.arguments):
            tangents[node] = ZERO
        elif node.operator == "call" and call_tangent is not None:
            tangents[node] = call_tangent(node, tuple(tangents[argument] for argument in node.arguments))
        else:
            tangents[node] = _tangent(node, tuple(tangents[argument] for argument in node.arguments))
    return tangents[root]


def partial(root: Expression, leaf: Expression, call_tangent: CallTangent | None = None) -> Expression:
    """Return the derivative of `root` with respect to one leaf."""
    return differentiate(root, {leaf: ONE}, call_tangent)


def linear_root(expression: Expression, leaf: Expression) -> Expression | None:
    """Return the value of a leaf at which an expression is zero; None unless it is linear in the leaf."""
    try:
        slope = partial(expression, leaf)
    except NotDifferentiableError:
        return None
    if slope == ZERO or leaf in ex.leaves(slope):
        return None
    return binary("Div", negate(ex.substitute(expression, {leaf: ZERO})), slope)


def call_of_tangent(call: Expression, tangents: tuple[Expression, ...]) -> Expression:
    """Return the tangent of a call of a Modelica function: a call of the C function that computes it."""
    assert isinstance(call.payload, tuple)
    function, result = call.payload
    return Expression("call", (*call.arguments, *tangents), (f"d{function}", result))


def _tangent(node: Expression, tangents: tuple[Expression, ...]) -> Expression:
    operator = node.operator
    if operator == "Select":
        return ex.select(node.arguments[0], tangents[1], tangents[2])
    if operator == "Neg":
        return negate(tangents[0])
    if operator in ex.TRUTH or operator in ("Sign", "Floor", "Ceil", "Trunc"):
        return ZERO
    if operator in _UNARY:
        return binary("Mul", _UNARY[operator](node), tangents[0])
    if operator in _BINARY:
        return _BINARY[operator](node, *tangents)
    raise NotDifferentiableError(operator)


def _square(a: Expression) -> Expression:
    return binary("Mul", a, a)


def _over(a: Expression, b: Expression) -> Expression:
    return binary("Div", a, b)


# f'(a) of each function of one argument; the node f(a) is passed in for reuse.
_UNARY: dict[str, Callable[[Expression], Expression]] = {
    "Abs": lambda n: unary("Sign", n.arguments[0]),
    "Sqrt": lambda n: _over(number(0.5), n),
    "Exp": lambda n: n,
    "Log": lambda n: _over(ONE, n.arguments[0]),
    "Log10": lambda n: _over(number(1.0 / math.log(10.0)), n.arguments[0]),
    "Sin": lambda n: unary("Cos", n.arguments[0]),
    "Cos": lambda n: negate(unary("Sin", n.arguments[0])),
    "Tan": lambda n: binary("Add", ONE, _square(n)),
    "Asin": lambda n: _over(ONE, unary("Sqrt", binary("Sub", ONE, _square(n.arguments[0])))),
    "Acos": lambda n: _over(number(-1.0), unary("Sqrt", binary("Sub", ONE, _square(n.arguments[0])))),
    "Atan": lambda n: _over(ONE, binary("Add", ONE, _square(n.arguments[0]))),
    "Sinh": lambda n: unary("Cosh", n.arguments[0]),
    "Cosh": lambda n: unary("Sinh", n.arguments[0]),
    "Tanh": lambda n: binary("Sub", ONE, _square(n)),
}


def _product(node: Expression, da: Expression, db: Expression) -> Expression:
    a, b = node.arguments
    return binary("Add", binary("Mul", da, b), binary("Mul", a, db))


def _quotient(node: Expression, da: Expression, db: Expression) -> Expression:
    b = node.arguments[1]
    return _over(binary("Sub", da, binary("Mul", node, db)), b)


def _power(node: Expression, da: Expression, db: Expression) -> Expression:
    a, b = node.arguments
    by_base = binary("Mul", binary("Mul", b, binary("Pow", a, binary("Sub", b, ONE))), da)
    if db == ZERO:
        return by_base
    by_exponent = binary("Mul", binary("Mul", node, unary("Log", a)), db)
    if not db.is_number and not a.is_number:
        # With a constant exponent, a negative or zero base must not lead to its logarithm.
        by_exponent = ex.select(Expression("Ne", (db, ZERO)), by_exponent, ZERO)
    return binary("Add", by_base, by_exponent)


def _arc_tangent(node: Expression, dy: Expression, dx: Expression) -> Expression:
    y, x = node.arguments
    change = binary("Sub", binary("Mul", x, dy), binary("Mul", y, dx))
    return _over(change, binary("Add", _square(x), _square(y)))


def _chosen(comparison: str) -> Callable[[Expression, Expression, Expression], Expression]:
    return lambda node, da, db: ex.select(Expression(comparison, node.arguments), da, db)


_BINARY: dict[str, Callable[[Expression, Expression, Expression], Expression]] = {
    "Add": lambda n, da, db: binary("Add", da, db),
    "Sub": lambda n, da, db: binary("Sub", da, db),
    "Mul": _product,
    "Div": _quotient,
    "Pow": _power,
    "Atan2": _arc_tangent,
    "Min": _chosen("Lt"),
    "Max": _chosen("Gt"),
}
