"""Start values of the variables."""

from __future__ import annotations

from collections.abc import Container
from functools import cached_property
from typing import Any

from fmu_build.codegen.dae_expression import plain_expression
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.support.description import EnumerationType


class StartValues:
    """Start values by slot, and the enumeration types of the model."""

    def __init__(self, model: LoweredModel) -> None:
        self._model = model
        self._values = self._read()

    def of(self, slot: Slot) -> float:
        """Return the start value of a slot; the default is 0 or the first literal of an enumeration."""
        return self._values.get(slot, 0.0)

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

    def _read(self) -> dict[Slot, float]:
        values: dict[Slot, float] = {}
        for variable in self._model.dae["variables"]:
            for number, name in enumerate(variable["scalar_names"]):
                if name in self._model.slots:
                    values[self._model.slots[name]] = self._start(variable, number)
        return values

    def _start(self, variable: dict[str, Any], number: int) -> float:
        attributes = variable["attributes"]
        is_parameter = variable["role"] in ("parameter", "constant")
        has_binding = is_parameter or variable["role"] == "input"
        for kind in ("binding", "start") if has_binding else ("start",):
            numbers = attributes[f"{kind}_values"]
            if numbers:
                return float(numbers[number] if len(numbers) > 1 else numbers[0])
            if attributes[kind] is not None:
                value = self._literal(attributes[kind], number)
                if value is not None:
                    return value
        is_computed = variable["name"] in self._model.computed_parameters
        if (
            is_parameter
            and not is_computed
            and variable["value_type"]["scalar"] in ("boolean", "enumeration")
        ):
            raise self._model.unsupported(
                f"the value of parameter {variable['name']} is not a literal", variable["declaration"]["span"]
            )
        return 1.0 if variable["value_type"]["scalar"] == "enumeration" else 0.0

    def _literal(self, number: int, element: int) -> float | None:
        """Return the value of a literal expression of the DAE, or of an element of an array of literals."""
        operation = self._model.dae["expressions"][number]["operation"]
        if operation["kind"] == "literal":
            ((kind, value),) = operation["value"].items()
            return float(value) if kind in ("real", "integer", "boolean", "enumeration") else None
        if operation["kind"] == "array" and "elements" in operation:
            return self._literal(operation["elements"][element], 0)
        return None


def starts_from_parameters(
    model: LoweredModel, n_states: int, sought: Container[Slot], without: Container[Slot]
) -> list[tuple[Slot, Expression]]:
    """Return start values that depend on parameters and that the Solve IR omits, except those of `without`.

    They belong to discrete variables, to states that are not fixed, and to the unknowns of algebraic loops
    and initial equations, whose slots are `sought`.
    """
    expressions = model.dae["expressions"]
    found: list[tuple[Slot, Expression]] = []
    for variable in model.dae["variables"]:
        start = variable["attributes"]["start"]
        if start is None or expressions[start]["variability"] != "parameter":
            continue
        is_array = bool(expressions[start]["value_type"]["dimensions"])
        for element, name in enumerate(variable["scalar_names"]):
            slot = model.slots.get(name)
            if slot is None:
                continue  # removed by the compiler
            is_state = slot[0] == "y" and slot[1] < n_states
            acts = is_state or slot in sought or variable["role"].startswith("discrete")
            if slot in without or not acts:
                continue
            value = plain_expression(model, start, element if is_array else 0)
            if value is None:
                raise model.unsupported(
                    f"the start value of {variable['name']} is not plain arithmetic",
                    variable["declaration"]["span"],
                )
            found.append((slot, value))
    return found
