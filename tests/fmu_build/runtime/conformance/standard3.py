"""FMI 3.0.2: the functions that the states of sections 2.3, 3.2 and 4.2 allow, and what may be set in them.

A mark a state: ``x`` allowed, ``v`` allowed for the variables of `may_set`, ``.`` not allowed. For an FMU
without clocks, structural parameters, Scheduled Execution and dependencies of single elements.
"""

from __future__ import annotations

from tests.fmu_build.runtime.conformance.variables import VariableKind

MODEL_EXCHANGE = ("instantiated", "initialization", "event", "continuous", "terminated")
CO_SIMULATION = ("instantiated", "initialization", "event", "step", "update", "terminated")

TYPES = ("Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")
TYPES += ("Boolean", "String", "Binary")
# The super state in which the whole state of an FMU can be set has no intermediate updates.
_SETTABLE = ("xxxxx", "xxxx.x")

_ROWS = {
    "SetDebugLogging": _SETTABLE,
    "Reset": _SETTABLE,
    "GetFMUState": _SETTABLE,
    "SetFMUState": _SETTABLE,
    "FreeFMUState": _SETTABLE,
    "SerializedFMUStateSize": _SETTABLE,
    "SerializeFMUState": _SETTABLE,
    "DeserializeFMUState": _SETTABLE,
    "EnterConfigurationMode": (".....", "......"),
    "ExitConfigurationMode": (".....", "......"),
    "EnterInitializationMode": ("x....", "x....."),
    "ExitInitializationMode": (".x...", ".x...."),
    "EnterEventMode": ("...x.", "...x.."),
    "Terminate": ("..xx.", "..xx.."),
    **{f"Get{name}": ("xxxxx", "xxxxxx") for name in TYPES},
    **{f"Set{name}": ("vvvv.", "vvvvv.") for name in TYPES},
    "GetClock": ("..x..", "..x..."),
    "SetClock": ("..x..", "..x..."),
    "GetIntervalDecimal": (".xx..", ".xx..."),
    "GetIntervalFraction": (".xx..", ".xx..."),
    "GetShiftDecimal": (".x...", ".x...."),
    "GetShiftFraction": (".x...", ".x...."),
    "SetIntervalDecimal": (".x...", ".x...."),
    "SetIntervalFraction": (".x...", ".x...."),
    "SetShiftDecimal": (".x...", ".x...."),
    "SetShiftFraction": (".x...", ".x...."),
    "GetNumberOfVariableDependencies": (".....", "......"),
    "GetVariableDependencies": (".....", "......"),
    "GetDirectionalDerivative": (".xxxx", ".xxx.x"),
    "GetAdjointDerivative": (".xxxx", ".xxx.x"),
    "EvaluateDiscreteStates": ("..x..", "..x..."),
    "UpdateDiscreteStates": ("..x..", "..x..."),
    "EnterContinuousTimeMode": ("..x..", "......"),
    "CompletedIntegratorStep": ("...x.", "......"),
    "SetTime": ("...x.", "......"),
    "SetContinuousStates": ("...x.", "......"),
    "GetContinuousStateDerivatives": (".xxxx", "......"),
    "GetEventIndicators": (".xxxx", "......"),
    "GetContinuousStates": (".xxxx", "......"),
    "GetNominalsOfContinuousStates": (".xxxx", "......"),
    "GetNumberOfEventIndicators": ("x.x..", "......"),
    "GetNumberOfContinuousStates": ("x.x..", "......"),
    "EnterStepMode": (".....", "..x..."),
    "GetOutputDerivatives": (".....", "...xxx"),
    "DoStep": (".....", "...x.."),
    "ActivateModelPartition": (".....", "......"),
}
FUNCTIONS = tuple(f"fmi3{name}" for name in _ROWS)


def mark(function: str, model_exchange: bool, state: str) -> str:
    """The mark of a function in a state."""
    row = _ROWS[function.removeprefix("fmi3")][0 if model_exchange else 1]
    return row[(MODEL_EXCHANGE if model_exchange else CO_SIMULATION).index(state)]


def may_set(kind: VariableKind, state: str) -> bool:
    """Whether a variable of that kind may be set in a state; inputs have `initial` exact in FMI 3."""
    causality, variability = kind.causality, kind.variability
    initial = "exact" if causality == "input" else kind.initial
    tunable = (causality, variability) == ("parameter", "tunable")
    return {
        "instantiated": variability != "constant" and initial in ("exact", "approx"),
        "initialization": variability != "constant" and initial == "exact",
        "event": causality == "input" or tunable or (kind.is_state and not kind.reinit),
        "continuous": (causality, variability) == ("input", "continuous") or kind.is_state,
        "step": causality == "input" or tunable,
        "update": (causality, variability) == ("input", "continuous"),
        "terminated": False,
    }[state]
