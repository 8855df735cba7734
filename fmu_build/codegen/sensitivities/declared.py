"""Declare the added variables as if the Modelica source had declared them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from fmu_build.codegen.expression import Slot
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.sensitivities.shift import shifted


@dataclass(frozen=True, slots=True)
class Declaration:
    """A sensitivity that the FMU exposes: of a state, or of a requested variable."""

    name: str
    slot: Slot
    role: str
    """``state`` or ``algebraic``, as in rumoca's data."""
    description: str
    unit: str
    nominal: float


def declare(
    model: LoweredModel,
    n_states: int,
    names: Mapping[Slot, str],
    declarations: tuple[Declaration, ...],
    n_more: int,
) -> LoweredModel:
    """Return the model with `n_more` additional states, and with names for all new slots of y and p."""
    slots = {name: shifted(slot, n_states, n_more) for name, slot in model.slots.items()}
    slots |= {name: slot for slot, name in names.items()}
    slots |= {one.name: one.slot for one in declarations}
    old = model.y_names
    new = {slot[1]: name for slot, name in names.items() if slot[0] == "y"}
    texts = [*old[:n_states], *(new.pop(n_states + i) for i in range(n_more)), *old[n_states:]]
    texts += [new[index] for index in sorted(new)]
    shown = {one.name for one in declarations}
    hidden = [_hidden(name) for slot, name in names.items() if slot[0] == "p" and name not in shown]
    variables = [*model.dae["variables"], *map(_entry, declarations), *hidden]
    return replace(model.with_slots(slots, texts), dae={**model.dae, "variables": variables})


def _entry(one: Declaration) -> dict[str, Any]:
    entry = _hidden(one.name)
    attributes = {
        **entry["attributes"],
        "origin": "source",
        "description": one.description,
        "unit": one.unit,
        "nominal_values": [one.nominal],
    }
    return {**entry, "role": one.role, "attributes": attributes}


def _hidden(name: str) -> dict[str, Any]:
    empty = ("start", "binding", "minimum", "maximum", "nominal")
    attributes = {f"{attribute}_values": None for attribute in empty} | {
        "origin": "sensitivity",
        "causality": "local",
        "description": "",
        "unit": "",
        "start": None,
        "binding": None,
        "tunable": False,
    }
    return {
        "name": name,
        "role": "algebraic",
        "value_type": {"scalar": "real", "dimensions": []},
        "scalar_names": [name],
        "declaration": {"span": None},
        "attributes": attributes,
    }


def quotient_unit(numerator: str, denominator: str) -> str:
    """Return the unit of a derivative, with equal factors cancelled; "" if the variable has none."""
    if not numerator or not denominator:
        return numerator
    above, below = _factors(numerator)
    more_below, more_above = _factors(denominator)
    above, below = above + more_above, below + more_below
    common = above & below
    above, below = above - common, below - common
    top = ".".join(sorted(above.elements())) or "1"
    if not below:
        return top
    bottom = ".".join(sorted(below.elements()))
    return f"{top}/({bottom})" if below.total() > 1 else f"{top}/{bottom}"


def _factors(unit: str) -> tuple[Counter[str], Counter[str]]:
    """Return the factors above and below the slash; a unit with several slashes counts as one factor."""
    above, _, below = unit.partition("/")
    if "/" in below:
        return Counter([f"({unit})"]), Counter()
    sides = [Counter(side.strip("()").split(".")) for side in (above, below)]
    for side in sides:
        del side["1"], side[""]
    return sides[0], sides[1]
