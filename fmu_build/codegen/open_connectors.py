"""Remove unconnected connectors: they cost nothing, and those of the model itself leave no trace in the FMU.

The flow of such a connector is zero and is dropped from the equations. Connectors of the model itself cannot
be connected once the model is an FMU, and their potentials are aliases of internal variables. The FMU
therefore lists the same variables and performs the same operations in the same order as without the
connector.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, replace

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.compact import changed
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import ZERO, Expression
from fmu_build.codegen.lowered import LoweredModel


@dataclass(frozen=True, slots=True)
class _Member:
    """A variable of a connector: its name, its leaf, and whether it is a flow."""

    name: str
    leaf: Expression
    is_flow: bool


def without_open_connectors(model: LoweredModel, equations: Equations) -> tuple[Equations, frozenset[str]]:
    """Return the equations without flows of unconnected connectors, and the names of removed variables.

    A connector of the model itself is removed as a whole unless one of its variables carries information: a
    flow that the model determines, or a potential that is not an alias, such as a state.
    """
    values = {ex.y(step.unknown): step.value for step in equations.algebraics if isinstance(step, Assignment)}
    connectors = _connectors(model)
    replacements = {
        member.leaf: ZERO
        for members in connectors.values()
        for member in members
        if member.is_flow and values.get(member.leaf) == ZERO
    }
    left_out = [
        member
        for name in model.flat["top_level_connectors"]
        if all(_is_left_out(member, values) for member in connectors.get(name, ()))
        for member in connectors.get(name, ())
    ]
    replacements |= {member.leaf: values[member.leaf] for member in left_out}
    ends = {leaf: _end(value, replacements) for leaf, value in replacements.items()}
    dropped = {member.leaf for member in left_out}
    kept = tuple(
        step
        for step in equations.algebraics
        if not (isinstance(step, Assignment) and ex.y(step.unknown) in dropped)
    )
    shorter = changed(replace(equations, algebraics=kept), lambda value: ex.substitute(value, ends))
    return shorter, frozenset(member.name for member in left_out)


def _connectors(model: LoweredModel) -> dict[str, list[_Member]]:
    """Return the variables of each connector that has a flow."""
    found: dict[str, list[_Member]] = defaultdict(list)
    for name, variable in model.flat["variables"].items():
        connector, _, _ = name.rpartition(".")
        slot = model.slots.get(name)
        if slot is not None and slot[0] == "y":
            found[connector].append(_Member(name, ex.leaf(slot), variable["flow"]))
    return {name: members for name, members in found.items() if any(m.is_flow for m in members)}


def _is_left_out(member: _Member, values: Mapping[Expression, Expression]) -> bool:
    value = values.get(member.leaf)
    return value == ZERO if member.is_flow else value is not None and value.operator == "y"


def _end(value: Expression, replacements: Mapping[Expression, Expression]) -> Expression:
    """Return the value at the end of a chain of aliases."""
    while value in replacements:
        value = replacements[value]
    return value
