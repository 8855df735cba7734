"""Periodic clocks, defined by ``sample()``, and the variables that they own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from fmu_build.codegen.expression import Slot
from fmu_build.codegen.lowered import LoweredModel


@dataclass(frozen=True, slots=True)
class Clock:
    """A periodic clock: ``p[activation]`` is 1 in the first pass at each tick.

    Period and phase are fractions of a second: (numerator, denominator). The phase counts from time 0 or from
    the start of the simulation.
    """

    activation: int
    period: tuple[int, int]
    phase: tuple[int, int]
    from_start: bool


def periodic_clocks(model: LoweredModel) -> tuple[Clock, ...]:
    """Return the clocks of the model; raises `UnsupportedModelError` if one starts at an unsupported time."""
    clocks = model.solve["clocks"]
    result = []
    for slot, schedule in zip(
        clocks["activation_parameter_indices"], clocks["periodic_event_schedules"], strict=True
    ):
        if schedule["anchor"] not in ("absolute", "simulation_start"):
            raise model.unsupported(f"a clock anchored at {schedule['anchor']} is not supported")
        from_start = schedule["anchor"] == "simulation_start"
        period, phase = schedule["lattice"]["period"], schedule["lattice"]["phase"]
        result.append(Clock(slot, (period["num"], period["den"]), (phase["num"], phase["den"]), from_start))
    return tuple(result)


def ticks_of_slots(model: LoweredModel) -> dict[Slot, int]:
    """Map the slot of each clocked variable, or state under a clocked reinit(), to its clock's activation.

    The Solve IR lacks this mapping; the DAE's clock ownerships and guarded actions provide it.
    """
    activations = model.solve["clocks"]["activation_parameter_indices"]
    systems = model.dae["systems"]
    variables = {variable["id"]: variable for variable in model.dae["variables"]}

    def slots(variable: int) -> list[Slot]:
        return [model.slots[name] for name in variables[variable]["scalar_names"]]

    owned: dict[Slot, int] = {}
    for ownership in systems["clocks"].get("ownerships", ()):
        owned |= dict.fromkeys(slots(ownership["variable"]), activations[ownership["clock"]])
    conditions = {c["id"]: c["operation"] for c in systems["conditions"]["conditions"]}
    for action in systems["events"]["actions"]:
        if action["operation"]["kind"] == "reinitialize":
            clock = _clock_in(conditions[action["guard"]], conditions)
            if clock is not None:
                owned |= dict.fromkeys(slots(action["operation"]["state"]), activations[clock])
    return owned


def _clock_in(operation: dict[str, Any], conditions: dict[int, dict[str, Any]]) -> int | None:
    """Return the clock in a condition, alone or combined with others; None if there is none."""
    if operation["kind"] == "clock":
        return int(operation["clock"])
    if operation["kind"] == "and":
        for operand in (operation[key] for key in ("lhs", "rhs") if key in operation):
            clock = _clock_in(conditions[operand], conditions)
            if clock is not None:
                return clock
    return None
