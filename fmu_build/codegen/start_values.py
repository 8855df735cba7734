"""Start values of the variables."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from functools import cached_property
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.dae_expression import number_of, plain_expression
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.support.description import EnumerationType


class StartValues:
    """Start values by slot, and the enumeration types of the model."""

    def __init__(self, model: LoweredModel) -> None:
        self._model = model
        self._elements = {
            model.slots[name]: (variable, number)
            for variable in model.dae["variables"]
            for number, name in enumerate(variable["scalar_names"])
            if name in model.slots
        }
        self._values: dict[Slot, float] = {}
        for slot in self._elements:
            self.of(slot)

    def of(self, slot: Slot) -> float:
        """Return the start value of a slot; the default is 0 or the first literal of an enumeration."""
        if slot not in self._values:
            self._values[slot] = math.nan  # until it is known
            self._values[slot] = self._start(*self._elements[slot]) if slot in self._elements else 0.0
        return self._values[slot]

    @cached_property
    def enumerations(self) -> tuple[EnumerationType, ...]:
        """All enumeration types of the model, longest name first."""
        literals: dict[str, dict[int, str]] = {}
        for qualified, ordinal in self._model.flat["enum_literal_ordinals"].items():
            type_name, _, literal = qualified.rpartition(".")
            if type_name not in ("StateSelect", "AssertionLevel") and not literal.startswith("'"):
                literals.setdefault(type_name, {})[ordinal] = literal
        return tuple(
            EnumerationType(name, tuple((members[i], "") for i in sorted(members)))
            for name, members in sorted(literals.items(), key=lambda item: -len(item[0]))
        )

    def enumeration_of(self, type_name: str) -> EnumerationType | None:
        """Return the enumeration with this name, with or without the enclosing packages."""
        for enumeration in self.enumerations:
            if enumeration.name == type_name or enumeration.name.endswith(f".{type_name}"):
                return enumeration
        return None

    def _start(self, variable: dict[str, Any], number: int) -> float:
        """Return the start value of an element of a variable, which its binding or attribute gives.

        A binding holds even if the attribute, perhaps of the declaration, has another value.
        """
        attributes = variable["attributes"]
        is_constant = variable["role"] in ("parameter", "constant")
        decides = is_constant or variable["role"] == "input"
        is_bound = attributes["binding"] is not None and decides
        kind = "binding" if is_bound else "start"
        default = 1.0 if variable["value_type"]["scalar"] == "enumeration" else 0.0
        if attributes[kind] is None:
            return default
        value = self.given(variable, kind, number)
        is_text = variable["value_type"]["scalar"] == "string"
        is_computed = variable["name"] in self._model.computed_parameters
        if value is None and decides and not (is_text or is_computed):
            raise self._model.unsupported(
                f"the value of {variable['name']} is not plain arithmetic", variable["declaration"]["span"]
            )
        return default if value is None else value

    def given(self, variable: Mapping[str, Any], kind: str, element: int) -> float | None:
        """Return what the binding or start attribute gives to an element; None if it is not known."""
        attributes = variable["attributes"]
        numbers, number = attributes[f"{kind}_values"], attributes[kind]
        if numbers:
            return float(numbers[element] if len(numbers) > 1 else numbers[0])
        is_array = bool(self._model.dae["expressions"][number]["value_type"]["dimensions"])
        found = plain_expression(self._model, number, element if is_array else 0)
        if found is None:
            return None
        try:
            return number_of(found, lambda index: self.of(("p", index)))
        except (ArithmeticError, KeyError, ValueError):
            return None


def reject_late_starts(
    model: LoweredModel,
    starts: Iterable[tuple[Slot, Expression]],
    dependent: Iterable[tuple[int, Expression]],
    unknowns: Iterable[Slot],
) -> None:
    """Raise an error for a start value that depends on an unknown of the initial equations, solved later.

    Args:
        model: the model
        starts: the start values
        dependent: the parameters that depend on others, in the order in which they are computed
        unknowns: the unknowns
    """
    late = {ex.leaf(slot) for slot in unknowns}
    for index, value in dependent:
        if late & ex.leaves(value):
            late.add(ex.p(index))
    names = {slot: name for name, slot in model.slots.items()}
    for slot, value in starts:
        for leaf in late & ex.leaves(value):
            source = names.get(("p" if leaf.operator == "p" else "y", leaf.index), "another variable")
            what = f"the start value of {names.get(slot, 'a variable')} depends on {source}"
            raise model.unsupported(f"{what}, which initial equations determine: that is not supported")


def starts_from_parameters(
    model: LoweredModel,
    given: StartValues,
    n_states: int,
    sought: Container[Slot],
    without: Container[Slot],
) -> list[tuple[Slot, Expression]]:
    """Return start values that the Solve IR omits, except those of `without`.

    They depend on parameters, or are not known as numbers.

    They belong to discrete variables, to states that are not fixed, and to the unknowns of algebraic loops
    and initial equations, whose slots are `sought`.
    """
    expressions = model.dae["expressions"]
    found: list[tuple[Slot, Expression]] = []
    for variable in model.dae["variables"]:
        start = variable["attributes"]["start"]
        if start is None:
            continue
        depends = expressions[start]["variability"] == "parameter"
        is_array = bool(expressions[start]["value_type"]["dimensions"])
        for element, name in enumerate(variable["scalar_names"]):
            slot = model.slots.get(name)
            if slot is None:
                continue  # removed by the compiler
            is_state = slot[0] == "y" and slot[1] < n_states
            acts = is_state or slot in sought or variable["role"].startswith("discrete")
            is_known = not depends and given.given(variable, "start", element) is not None
            if slot in without or not acts or is_known:
                continue
            value = plain_expression(model, start, element if is_array else 0)
            if value is None:
                raise model.unsupported(
                    f"the start value of {variable['name']} is not plain arithmetic",
                    variable["declaration"]["span"],
                )
            found.append((slot, value))
    return found
