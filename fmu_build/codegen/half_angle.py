"""Sines of angles whose half has its tangent computed anyway: sin(u) = 2t/(1 + t^2) with t = tan(u/2).

The quotient is as accurate as the tangent, everywhere: a relative error of t makes at most the same one of
the sine. It saves a call of the C library.
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
    """From each sine to the tangent of half its angle, where the expressions, those of a model, contain both.

    A sine beside the cosine of the same angle is left alone: C compilers make one call of the two. Every
    function of the model must go by the same answer: the zero crossings are computed in two of them, to the
    same last digit.
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
    """The angle u where `angle` is written as u/2, u*0.5 or 0.5*u."""
    match angle.operator, angle.arguments:
        case ("Div", (u, divisor)) if divisor == _TWO:
            return u
        case ("Mul", (u, factor)) if factor == _HALF:
            return u
        case ("Mul", (factor, u)) if factor == _HALF:
            return u
    return None
