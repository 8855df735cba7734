"""Names for slots: C identifiers in the generated code, Modelica names in messages."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from fmu_build.codegen import expression as ex
from fmu_build.codegen.c_expression import PRIMARY, Writer
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import ONE, Expression, Slot
from fmu_build.codegen.lowered import LoweredModel


def slot_names(model: LoweredModel, equations: Equations, parts: Mapping[Expression, int]) -> dict[Slot, str]:
    """Return a C identifier for every slot: ``Y_theta``, ``P_forward_returnSpring_k_s``, ``P_pre_y_3``."""
    names: dict[Slot, str] = {}
    taken: set[str] = set()
    for slot, text in (*_variables(model), *_memories(equations), *_parts(model, parts), *_others(equations)):
        if slot in names:
            continue
        base = f"{slot[0].upper()}_{_identifier(text)}"
        names[slot] = base
        while names[slot] in taken:
            names[slot] = f"{base}_{slot[1]}" if names[slot] == base else f"{names[slot]}_"
        taken.add(names[slot])
    return names


def _variables(model: LoweredModel) -> Iterator[tuple[Slot, str]]:
    for index, text in enumerate(model.y_names):
        yield ("y", index), text
    for variable in model.dae["variables"]:
        for scalar in variable["scalar_names"]:
            slot = model.slots.get(scalar)
            if slot is not None and slot[0] == "p":
                yield slot, scalar


def _memories(equations: Equations) -> Iterator[tuple[Slot, str]]:
    for number, relation in enumerate((*equations.relations.crossings, *equations.relations.of_time)):
        yield ("p", relation.memory), f"relation_{number}"
    for number, memory in enumerate(equations.relations.floors.values()):
        yield ("p", memory), f"step_{number}"
    for number, row in enumerate(equations.discrete):
        if row.kind == "condition":
            yield row.slot, f"condition_{number}"
    for number, clock in enumerate(equations.clocks):
        yield ("p", clock.activation), f"tick_{number}"
    for index, (store, source) in equations.pre:
        yield ("p", index), f"pre_{store}_{source}"


def _parts(model: LoweredModel, parts: Mapping[Expression, int]) -> Iterator[tuple[Slot, str]]:
    """Name the expressions hoisted from the right-hand side: ``inverse_J`` for 1/J, ``part_3`` for others."""
    texts = dict(_variables(model))
    for number, (part, slot) in enumerate(parts.items()):
        text = f"part_{number}"
        if part.operator == "Div" and part.arguments[0] == ONE and part.arguments[1].operator == "p":
            text = f"inverse_{texts[('p', part.arguments[1].index)]}"
        yield ("p", slot), text


def _others(equations: Equations) -> Iterator[tuple[Slot, str]]:
    if equations.initial_event is not None:
        yield ("p", equations.initial_event), "initial"
    if equations.homotopy is not None:
        yield ("p", equations.homotopy), "homotopy"
    for index in range(equations.n_p):
        yield ("p", index), f"slot_{index}"


def _identifier(text: str) -> str:
    return re.sub(r"\W+", "_", text).strip("_")


class _ModelicaWriter(Writer):
    """Writes function calls under their Modelica name, with their arguments."""

    def _text(self, node: Expression) -> tuple[str, int]:
        if node.operator != "call":
            return super()._text(node)
        assert isinstance(node.payload, tuple)
        function, result = node.payload
        arguments = ", ".join(self.text(argument) for argument in node.arguments)
        return f"{function}({arguments})" + (f"[{result + 1}]" if result else ""), PRIMARY


def modelica_texts(model: LoweredModel, equations: Equations) -> Writer:
    """Return a writer that uses the Modelica names of variables; memories are numbered."""
    names: dict[Expression, str] = {ex.TIME: "time"}
    names |= {ex.p(index): f"memory[{index}]" for index in range(equations.n_p)}
    names |= {ex.leaf(slot): text for text, slot in model.slots.items()}
    return _ModelicaWriter(names)
