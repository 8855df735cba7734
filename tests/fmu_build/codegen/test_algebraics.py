"""Systems of equations that one step of Newton's method solves."""

from __future__ import annotations

import pytest

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import NewtonBlock
from fmu_build.codegen.expression import Expression, binary, negate

U, V, HELD = ex.y(3), ex.y(4), ex.y(0)
ANGLE = Expression("Sin", (HELD,))


def _is_linear(*residuals: Expression) -> bool:
    return NewtonBlock((3, 4), residuals, ()).is_linear


def _choice(condition: Expression) -> Expression:
    return Expression("Select", (condition, binary("Mul", ex.p(1), U), V))


@pytest.mark.parametrize(
    "residual",
    [
        binary("Sub", binary("Add", U, V), HELD),
        negate(binary("Mul", ANGLE, U)),
        binary("Div", binary("Mul", U, ex.p(0)), binary("Add", ANGLE, ex.TIME)),
        _choice(Expression("Gt", (HELD, ex.p(2)))),
        ANGLE,
    ],
)
def test_linear(residual: Expression) -> None:
    assert _is_linear(residual, V)


@pytest.mark.parametrize(
    "residual",
    [
        binary("Mul", U, V),
        binary("Add", U, binary("Mul", V, V)),
        binary("Div", HELD, U),
        Expression("Sin", (U,)),
        # Piecewise linear, but not known before which piece it is.
        _choice(Expression("Gt", (U, ex.p(2)))),
        Expression("Max", (U, HELD)),
        Expression("Floor", (V,)),
        Expression("call", (HELD, U), ("f", 0)),
    ],
)
def test_not_linear(residual: Expression) -> None:
    assert not _is_linear(V, residual)
