"""C names for the slots of y and p, so that the generated code can be read."""

from __future__ import annotations

import re

from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import Slot
from fmu_build.codegen.lowered import LoweredModel


def slot_names(model: LoweredModel, equations: Equations) -> dict[Slot, str]:
    """A C identifier for every slot: ``Y_theta``, ``P_forward_returnSpring_k_s``, ``P_pre_v`` ..."""
    names: dict[Slot, str] = {}
    taken: set[str] = set()

    def name(slot: Slot, text: str) -> None:
        if slot in names:
            return
        base = f"{slot[0].upper()}_{_identifier(text)}"
        candidate, number = base, 2
        while candidate in taken:
            candidate, number = f"{base}_{number}", number + 1
        taken.add(candidate)
        names[slot] = candidate

    for index, text in enumerate(model.solve["solve_layout"]["solver_maps"]["names"]):
        name(("y", index), text)
    for variable in model.dae["variables"]:
        for scalar in variable["scalar_names"]:
            binding = model.solve["layout"]["bindings"].get(scalar, {})
            if "P" in binding:
                name(("p", binding["P"]["index"]), scalar)
    for index, source in equations.pre:
        name(("p", index), f"pre_{names[source][2:]}")
    for number, relation in enumerate((*equations.relations.crossings, *equations.relations.of_time)):
        name(("p", relation.memory), f"relation_{number}")
    for number, row in enumerate(equations.discrete):
        if row.kind == "condition":
            name(row.slot, f"condition_{number}")
    for number, clock in enumerate(equations.clocks):
        name(("p", clock.activation), f"tick_{number}")
    if equations.initial_event is not None:
        name(("p", equations.initial_event), "initial")
    for index in range(equations.n_p):
        name(("p", index), f"slot_{index}")
    return names


def _identifier(text: str) -> str:
    return re.sub(r"\W+", "_", text).strip("_")
