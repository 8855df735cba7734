"""The variables that an FMU exposes, with their attributes and where their values are stored."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.annotations import is_to_be_shown
from fmu_build.codegen.equations import Equations, acting_expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.start_values import StartValues
from fmu_build.support.description import (
    Causality,
    EnumerationType,
    Initial,
    ValueType,
    Variability,
    Variable,
)

Store = Literal["y", "p", "derivative", "time"]

_TYPES: dict[str, ValueType] = {
    "real": "Real",
    "integer": "Integer",
    "boolean": "Boolean",
    "enumeration": "Enumeration",
}


@dataclass(frozen=True, slots=True)
class StoredVariable:
    """A variable of the FMU with its position in the runtime's arrays."""

    variable: Variable
    store: Store
    index: int


@dataclass(frozen=True, slots=True)
class _Role:
    causality: Causality
    variability: Variability
    initial: Initial | None


class VariableReader:
    """Reads the variables of one model in the order of their declaration."""

    def __init__(
        self,
        model: LoweredModel,
        equations: Equations,
        starts: StartValues,
        baked: frozenset[str],
        left_out: frozenset[str] = frozenset(),
    ) -> None:
        self._model = model
        self._equations = equations
        self._starts = starts
        self._computed = {index for index, _ in equations.dependent_parameters}
        self._started = {slot for slot, _ in equations.start_values} | set(equations.initial_unknowns)
        self._tunable = self._parameters_in_use()
        self._given = _given_by_when(equations)
        self._baked = baked
        self._left_out = left_out
        self._copies = {
            step.unknown: step.value
            for step in equations.algebraics
            if isinstance(step, Assignment) and not step.value.arguments
        }

    def _parameters_in_use(self) -> frozenset[int]:
        """Return the indices of parameters that matter after initialization, directly or through others."""
        used = ex.places("p", *acting_expressions(self._equations))
        for index, value in reversed(self._equations.dependent_parameters):
            if index in used:
                used |= ex.places("p", value)
        return frozenset(used)

    def read(self) -> tuple[StoredVariable, ...]:
        """Return all visible variables: time, those of the model, and the derivatives of the states."""
        time = Variable("time", "Real", "independent", "continuous", None, None, "Simulation time", unit="s")
        stored = [StoredVariable(time, "time", 0)]
        for entry in self._model.dae["variables"]:
            if self._is_visible(entry):
                stored.extend(self._scalars(entry))
        return (*stored, *self._derivatives(stored))

    def _is_visible(self, entry: dict[str, Any]) -> bool:
        """Return whether FMI lists the variable.

        Protected ones are hidden, except for states and variables annotated with ``HideResult = false``.
        Parameters of type String are hidden too, because numbers that depend on one are already constants.
        """
        is_string = entry["value_type"]["scalar"] == "string" and entry["role"] in ("parameter", "constant")
        if entry["name"] in self._left_out or is_string:
            return False
        flat = self._model.flat["variables"].get(entry["name"])
        if entry["attributes"]["origin"] != "source":
            return False
        is_protected = flat is not None and flat["is_protected"] and entry["role"] != "state"
        if is_protected and entry["role"] not in ("parameter", "constant"):
            return is_to_be_shown(self._model, entry["name"], entry["declaration"]["span"])
        return not is_protected

    def _scalars(self, entry: dict[str, Any]) -> Iterator[StoredVariable]:
        if entry["value_type"]["scalar"] not in _TYPES:
            raise self._model.unsupported(
                f"variable {entry['name']} of type {entry['value_type']['scalar']}",
                entry["declaration"]["span"],
            )
        for number, name in enumerate(entry["scalar_names"]):
            slot = self._model.slots.get(name)
            if slot is None:
                continue  # removed by the compiler, e.g. an array of size zero
            variable = self._variable(entry, name, number, slot)
            yield StoredVariable(variable, *self._place(slot))

    def _place(self, slot: ex.Slot) -> tuple[Store, int]:
        """Return store and index of a value; an algebraic variable equal to a derivative is read from there.

        Importers read it as often as the states, and derivatives cost less than evaluating all algebraic
        variables.
        """
        if slot[0] == "y" and slot[1] >= self._equations.n_states:
            value = self._resolved(ex.y(slot[1]))
            derivatives = [self._resolved(derivative) for derivative in self._equations.derivatives]
            is_state = value.operator == "y" and value.index < self._equations.n_states
            if value in derivatives and not is_state:
                return "derivative", derivatives.index(value)
        return slot

    def _resolved(self, value: ex.Expression) -> ex.Expression:
        """Return the value at the end of a chain of aliases."""
        while value.operator == "y" and value.index in self._copies:
            value = self._copies[value.index]
        return value

    def _variable(self, entry: dict[str, Any], name: str, number: int, slot: ex.Slot) -> Variable:
        attributes = entry["attributes"]
        flat = self._model.flat["variables"].get(entry["name"], {})
        kind = _TYPES[entry["value_type"]["scalar"]]
        role = self._role(entry, slot)
        start = (
            self._starts.of(slot)
            if role.initial in ("exact", "approx") or role.causality == "input"
            else None
        )
        return Variable(
            name=name,
            type=kind,
            causality=role.causality,
            variability=role.variability,
            initial=role.initial,
            start=_typed(start, kind),
            description=attributes["description"] or "",
            unit=attributes["unit"] or "",
            display_unit=flat.get("display_unit") or "",
            quantity=flat.get("quantity") or "",
            minimum=_element(attributes["minimum_values"], number),
            maximum=_element(attributes["maximum_values"], number),
            nominal=_element(attributes["nominal_values"], number),
            reinit=any(row.kind == "reinit" and row.slot == slot for row in self._equations.discrete),
            enumeration=self._enumeration(entry["name"]) if kind == "Enumeration" else None,
        )

    def _role(self, entry: dict[str, Any], slot: ex.Slot) -> _Role:
        """Return causality, variability and initial, in a combination that FMI 2.0 allows."""
        if entry["role"] in ("parameter", "constant"):
            return self._parameter_role(entry, slot)
        if entry["role"] == "input" and "." not in entry["name"]:
            return _Role(
                "input", "continuous" if entry["value_type"]["scalar"] == "real" else "discrete", None
            )
        is_output = entry["attributes"]["causality"] == "output" and "." not in entry["name"]
        causality: Causality = "output" if is_output else "local"
        if slot[0] == "y":
            return _Role(causality, "continuous", self._state_initial(slot))
        return _Role(causality, "discrete", self._discrete_initial(slot))

    def _parameter_role(self, entry: dict[str, Any], slot: ex.Slot) -> _Role:
        variability: Variability = "tunable" if slot[1] in self._tunable else "fixed"
        if slot in self._equations.initial_unknowns or slot[1] in self._computed:
            return _Role("calculatedParameter", variability, "calculated")
        is_final = self._model.flat.get("variable_final_flags", {}).get(entry["name"], False)
        is_settable = entry["attributes"]["tunable"] and entry["name"] not in self._baked
        if entry["role"] == "constant" or is_final or not is_settable:
            return _Role("local", "constant", "exact")
        return _Role("parameter", variability, "exact")

    def _state_initial(self, slot: ex.Slot) -> Initial:
        if slot[1] >= self._equations.n_states or slot in self._started:
            return "calculated"
        return "exact"

    def _discrete_initial(self, slot: ex.Slot) -> Initial:
        return "exact" if slot in self._given and slot not in self._started else "calculated"

    def _enumeration(self, name: str) -> EnumerationType:
        type_name = self._model.flat["variable_type_names"].get(name, "")
        found = self._starts.enumeration_of(type_name)
        if found is None:
            raise self._model.unsupported(f"the enumeration type {type_name!r} of {name} is not known")
        return found

    def _derivatives(self, stored: list[StoredVariable]) -> Iterator[StoredVariable]:
        """Yield der(state) for every state: FMI's ModelStructure requires a variable for each derivative."""
        references = {s.index: n for n, s in enumerate(stored) if s.store == "y"}
        names = self._model.y_names
        for index in range(self._equations.n_states):
            if index not in references:
                raise self._model.unsupported(f"the state {names[index]} is not a variable of the model")
            state = stored[references[index]].variable
            derivative = Variable(
                name=f"der({names[index]})",
                type="Real",
                causality="local",
                variability="continuous",
                initial="calculated",
                start=None,
                description=f"Time derivative of {names[index]}",
                unit=_per_second(state.unit),
                derivative_of=references[index],
            )
            yield StoredVariable(derivative, "derivative", index)


def nominals(model: LoweredModel) -> dict[int, float]:
    """Return the nominal values that the model gives for variables in y, visible or not, by index."""
    found = {}
    for entry in model.dae["variables"]:
        for number, name in enumerate(entry["scalar_names"]):
            slot = model.slots.get(name)
            nominal = _element(entry["attributes"]["nominal_values"], number)
            if slot is not None and slot[0] == "y" and nominal:
                found[slot[1]] = abs(nominal)
    return found


def _given_by_when(equations: Equations) -> frozenset[ex.Slot]:
    """Return the discrete variables that keep their start value until a when-clause sets them."""
    return frozenset(row.slot for row in equations.discrete if row.kind == "assign" and row.holds)


def _per_second(unit: str) -> str:
    if not unit:
        return ""
    numerator, slash, denominator = unit.partition("/")
    if not slash:
        return "1/s" if unit == "1" else f"{unit}/s"
    if denominator == "s":
        return f"{numerator}/s2"
    return f"{numerator}/({denominator.strip('()')}.s)"


def _element(values: list[float] | None, number: int) -> float | None:
    """Return the attribute of one array element; a single value applies to all, 1e60 or more to none."""
    if not values:
        return None
    value = values[number] if len(values) > 1 else values[0]
    return None if value is None or not math.isfinite(value) or abs(value) >= 1e60 else float(value)


def _typed(value: float | None, kind: ValueType) -> float | int | bool | None:
    if value is None or kind == "Real":
        return value
    return bool(value) if kind == "Boolean" else int(value)
