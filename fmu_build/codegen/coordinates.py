"""Index reduction: give the states that rumoca chooses in constrained models the names of variables.

For constraints such as ``phi_a = ratio*phi_b``, rumoca takes some of the variables as coordinates,
``$state_coordinates[i]``, and computes the others from them. If the constraints are linear, with parameters
as coefficients, the choice is valid for the whole motion; otherwise only near the start.
"""

from __future__ import annotations

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.lowered import LoweredModel

_COORDINATE = "$state_coordinates"


def with_named_states(model: LoweredModel, equations: Equations) -> LoweredModel:
    """Return the model with every state named after a variable.

    Raises `UnsupportedModelError` if the choice of states is not valid for the whole motion.
    """
    names = model.y_names
    coordinates = [i for i in range(equations.n_states) if names[i].startswith(_COORDINATE)]
    if not coordinates:
        return model
    if not _is_linear(model, equations):
        raise model.unsupported(
            "the model has constraints between its states (an index above one) that are not linear, and the "
            "states that rumoca selects are valid for part of the motion only; write the model in "
            "independent coordinates"
        )
    taken = {index: _variable_equal_to(index, model, equations) for index in coordinates}
    return _renamed(model, taken)


def _variable_equal_to(state: int, model: LoweredModel, equations: Equations) -> int:
    """Return the place of the first source variable that is a copy of a state."""
    names = model.y_names
    declared = {name for entry in model.dae["variables"] for name in entry["scalar_names"]}
    copies = {ex.y(state)}
    for step in equations.algebraics:
        if isinstance(step, Assignment) and step.value in copies:
            if names[step.unknown] in declared:
                return step.unknown
            copies.add(ex.y(step.unknown))
    raise model.unsupported("the model has constraints between its states, and one of them has no name")


def _renamed(model: LoweredModel, taken: dict[int, int]) -> LoweredModel:
    """Return the model in which the variables at the places `taken` are the states themselves."""
    names, slots = list(model.y_names), dict(model.slots)
    for index, place in taken.items():
        names[index], names[place] = names[place], names[index]
        slots[names[index]], slots[names[place]] = slots[names[place]], slots[names[index]]
    return model.with_slots(slots, names)


def _is_linear(model: LoweredModel, equations: Equations) -> bool:
    """Return whether the source's state variables are linear in the coordinates."""
    roles = {
        model.slots[name]: entry["role"]
        for entry in model.dae["variables"]
        for name in entry["scalar_names"]
        if name in model.slots
    }
    constant = {ex.leaf(slot) for slot, role in roles.items() if role in ("parameter", "constant")}
    waiting = [place for (store, place), role in roles.items() if store == "y" and role == "state"]
    steps = {unknown: step for step in equations.algebraics for unknown in step.unknowns}
    seen: set[int] = set()
    while waiting:
        index = waiting.pop()
        if index in seen or index not in steps:
            continue
        seen |= set(steps[index].unknowns)
        for expression in steps[index].expressions:
            if not _is_affine(expression, constant):
                return False
            waiting += ex.places("y", expression)
    return True


def _is_affine(expression: Expression, constant: set[Expression]) -> bool:
    """Return whether an expression is affine in y, with coefficients of numbers and `constant` leaves."""
    if not _reads_y(expression) or expression.operator == "y":
        return True
    first, *others = expression.arguments
    if expression.operator in ("Add", "Sub", "Neg"):
        return all(_is_affine(argument, constant) for argument in expression.arguments)
    if expression.operator == "Mul":
        factor, rest = (others[0], first) if _reads_y(first) else (first, others[0])
        return _is_constant(factor, constant) and _is_affine(rest, constant)
    return expression.operator == "Div" and _is_constant(others[0], constant) and _is_affine(first, constant)


def _reads_y(expression: Expression) -> bool:
    return bool(ex.places("y", expression))


def _is_constant(expression: Expression, constant: set[Expression]) -> bool:
    return constant.issuperset(ex.leaves(expression))
