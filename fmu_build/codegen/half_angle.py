"""Compute sin(u) and cos(u) from t = tan(u/2) if the model computes this tangent anyway.

This saves calls of the C library. sin(u) = 2t/(1 + t^2) is as accurate as the tangent everywhere: its
relative error is at most that of t. The same bound holds for the absolute error of cos(u) = (1 - t^2)/(1 +
t^2); near its zeros this is no more than the effect of rounding u.
"""

from __future__ import annotations

from collections.abc import Iterable

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression

#: The C functions, by operator.
NAMES = {"Sin": "sin_from_half", "Cos": "cos_from_half"}
#: Their sources, for models that use them.
SOURCES = {
    NAMES["Sin"]: f"""\
/* sin(u) from t = tan(u/2) */
static double {NAMES["Sin"]}(double t) {{ return 2.0 * t / (1.0 + t * t); }}""",
    NAMES["Cos"]: f"""\
/* cos(u) from t = tan(u/2) */
static double {NAMES["Cos"]}(double t) {{ return (1.0 - t) * (1.0 + t) / (1.0 + t * t); }}""",
}

_TWO, _HALF = ex.number(2.0), ex.number(0.5)


def from_half(expressions: Iterable[Expression]) -> dict[Expression, Expression]:
    """Map each sine and cosine to the tangent of half its angle, if the expressions of a model contain it.

    All functions of the model must use the same map: two of them compute the zero crossings and must agree to
    the last bit.
    """
    nodes = set(ex.walk(*expressions))
    tangents = {}
    for node in nodes:
        if node.operator == "Tan" and (angle := _doubled(node.arguments[0])) is not None:
            tangents[angle] = node
    return {
        node: tangents[node.arguments[0]]
        for node in nodes
        if node.operator in NAMES and node.arguments[0] in tangents
    }


def _doubled(angle: Expression) -> Expression | None:
    """Return u if `angle` is written as u/2, u*0.5 or 0.5*u, else None."""
    match angle.operator, angle.arguments:
        case ("Div", (u, divisor)) if divisor == _TWO:
            return u
        case ("Mul", (u, factor)) if factor == _HALF:
            return u
        case ("Mul", (factor, u)) if factor == _HALF:
            return u
    return None
