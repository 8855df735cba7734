"""Tangents of expressions, and the order of the steps that compute them."""

from __future__ import annotations

import math

import pytest

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.differentiate import differentiate
from fmu_build.codegen.equations import DiscreteRow, Equations
from fmu_build.codegen.expression import Expression, binary, number, p, select, y
from fmu_build.codegen.relations import Relations
from fmu_build.codegen.tangents import NoTangentsError, Tangent, Tangents
from fmu_build.codegen.variables import StoredVariable
from fmu_build.support.description import Variable


def _parameter(index: int) -> StoredVariable:
    return StoredVariable(Variable(f"p{index}", "Real", "parameter", "tunable", "exact", 1.0), "p", index)


def _equations(*steps: Assignment, discrete: tuple[DiscreteRow, ...] = ()) -> Equations:
    return Equations(
        n_states=1,
        n_y=3,
        n_p=4,
        derivatives=(y(1),),
        algebraics=steps,
        relations=Relations(4),
        discrete=discrete,
        clocks=(),
        pre=(),
        actions=(),
        dependent_parameters=((1, binary("Mul", number(2.0), p(0))),),
        start_values=((("y", 0), p(1)),),
        initial_unknowns=(),
        initial_residuals=(),
        initial_event=None,
    )


def _tangent(tangents: Tangents, store: str, index: int) -> Expression:
    slots = {t.slot: t.value for t in (*tangents.parameters, *tangents.steps) if isinstance(t, Tangent)}
    return slots[store, index]  # type: ignore[index]


def _value(node: Expression, values: dict[Expression, float]) -> float:
    """Of the few operators that occur here."""
    if node.is_number:
        return node.value
    if node in values:
        return values[node]
    arguments = [_value(argument, values) for argument in node.arguments if node.operator != "Select"]
    match node.operator:
        case "Add":
            return arguments[0] + arguments[1]
        case "Sub":
            return arguments[0] - arguments[1]
        case "Mul":
            return arguments[0] * arguments[1]
        case "Pow":
            return math.pow(*arguments)
        case "Log":
            return math.log(arguments[0])
        case "Ne":
            return float(arguments[0] != arguments[1])
        case "Select":
            condition, a, b = node.arguments
            return _value(a if _value(condition, values) else b, values)
    raise AssertionError(node.operator)


def test_through_computed_parameters_and_algebraic_variables() -> None:
    tangents = Tangents.of(_equations(Assignment(1, binary("Mul", p(1), y(0)))), [_parameter(0)])
    values = {p(0): 3.0, p(1): 6.0, y(0): 5.0, _d("p", 0): 1.0, _d("p", 1): 2.0, _d("y", 0): 10.0}
    assert _value(_tangent(tangents, "p", 1), values) == 2.0
    assert _value(_tangent(tangents, "y", 1), values) == 2.0 * 5.0 + 6.0 * 10.0
    assert tangents.derivatives == (_d("y", 1),)
    assert tangents.starts == (Tangent(("y", 0), _d("p", 1)),)
    assert tangents.cover_initialization


def _d(store: str, index: int) -> Expression:
    return Expression(f"d{store}", payload=index)


def test_what_does_not_move_has_no_tangent() -> None:
    steps = (Assignment(1, number(2.0)), Assignment(2, binary("Mul", p(3), y(1))))
    assert not Tangents.of(_equations(*steps), [_parameter(0)]).steps


def test_discrete_variables_that_follow_come_before_what_reads_them() -> None:
    follows = DiscreteRow("assign", ("p", 2), select(p(3), p(0), number(1.0)))
    equations = _equations(Assignment(1, binary("Mul", p(2), y(0))), discrete=(follows,))
    steps = Tangents.of(equations, [_parameter(0)]).steps
    assert [step.slot for step in steps if isinstance(step, Tangent)] == [("p", 2), ("y", 1)]


def test_discrete_variables_that_a_when_clause_sets_stay() -> None:
    holds = DiscreteRow("assign", ("p", 2), select(p(3), p(0), p(2)))
    equations = _equations(Assignment(1, binary("Mul", p(2), y(0))), discrete=(holds,))
    steps = Tangents.of(equations, [_parameter(0)]).steps
    assert [step.slot for step in steps if isinstance(step, Tangent)] == [("y", 1)]


def test_a_circle_has_no_order() -> None:
    follows = DiscreteRow("assign", ("p", 2), binary("Add", y(1), p(0)))
    equations = _equations(Assignment(1, binary("Mul", p(2), y(0))), discrete=(follows,))
    with pytest.raises(NoTangentsError, match="form a cycle"):
        Tangents.of(equations, [_parameter(0)])


@pytest.mark.parametrize("base", [-2.0, 0.0])
def test_an_exponent_that_stays_takes_no_logarithm(base: float) -> None:
    power = binary("Pow", y(0), p(0))
    tangent = differentiate(power, {y(0): _d("y", 0), p(0): _d("p", 0)})
    values = {y(0): base, p(0): 3.0, _d("y", 0): 1.0, _d("p", 0): 0.0}
    assert _value(tangent, values) == 3.0 * base**2
    assert ex.leaves(tangent) == {y(0), p(0)}
