"""Compute sin(u) = 2t/(1 + t^2) from t = tan(u/2) where the model computes that tangent anyway.

This saves a call of the C library. The quotient is as accurate as the tangent everywhere: the relative error
of the sine is at most that of t.
"""

from __future__ import annotations

from collections.abc import Iterable

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression

NAME = "sin_from_half"
#: The C function, for models that use it.
SOURCE = f"""\
/* sin(u) from t = tan(u/2) */
static double {NAME}(double t) {{ return 2.0 * t / (1.0 + t * t); }}"""

_TWO, _HALF = ex.number(2.0), ex.number(0.5)


def sines_from_half(expressions: Iterable[Expression]) -> dict[Expression, Expression]:
    """Map each sine to the tangent of half its angle, if the expressions of a model contain both.

    A sine next to the cosine of the same angle is left alone: C compilers merge the two into one call. All
    functions of the model must use the same map: two of them compute the zero crossings and must agree to the
    last bit.
    """
    nodes = set(ex.walk(*expressions))
    tangents = {}
    for node in nodes:
        if node.operator == "Tan" and (angle := _doubled(node.arguments[0])) is not None:
            tangents[angle] = node
    return {
        node: tangents[node.arguments[0]]
        for node in nodes
        if node.operator == "Sin"
        and node.arguments[0] in tangents
        and Expression("Cos", node.arguments) not in nodes
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
