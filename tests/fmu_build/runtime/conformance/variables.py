"""The properties of the hand-written models' variables, by value reference."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class VariableKind:
    """The attributes that decide when a variable may be set, and a value that it can have."""

    name: str
    type: str
    causality: str
    variability: str
    initial: str | None
    value: float = 1.0
    is_state: bool = False
    reinit: bool = False


LAG = (
    VariableKind("time", "Real", "independent", "continuous", None),
    VariableKind("x", "Real", "output", "continuous", "exact", is_state=True),
    VariableKind("der(x)", "Real", "local", "continuous", "calculated"),
    VariableKind("y", "Real", "output", "continuous", "calculated"),
    VariableKind("u", "Real", "input", "continuous", None),
    VariableKind("gear", "Integer", "input", "discrete", None),
    VariableKind("on", "Boolean", "input", "discrete", None),
    VariableKind("tau", "Real", "parameter", "tunable", "exact"),
    VariableKind("gain", "Real", "parameter", "fixed", "exact"),
    VariableKind("half", "Real", "calculatedParameter", "tunable", "calculated"),
    VariableKind("high", "Boolean", "output", "discrete", "calculated"),
    VariableKind("lastGear", "Integer", "output", "discrete", "calculated"),
    VariableKind("mode", "Enumeration", "parameter", "fixed", "exact"),
)
BALL = (
    VariableKind("h", "Real", "output", "continuous", "exact", is_state=True),
    VariableKind("v", "Real", "output", "continuous", "exact", is_state=True, reinit=True),
)
