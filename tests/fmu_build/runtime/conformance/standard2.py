"""FMI 2.0.5: the tables of allowed calls of sections 3.2.3 and 4.2.4, and the conditions beneath them.

A mark a state: ``x`` allowed, a digit allowed on that condition, ``.`` not allowed. The states "step in
progress" and "step canceled" are left out: an FMU that computes its steps at once never reaches them.
"""

from __future__ import annotations

from tests.fmu_build.runtime.conformance.variables import VariableKind

MODEL_EXCHANGE = ("instantiated", "initialization", "event", "continuous", "terminated", "error")
CO_SIMULATION = ("instantiated", "initialization", "complete", "failed", "terminated", "error")

_COMMON = {
    "fmi2GetTypesPlatform": ("xxxxxx", "xxxxxx"),
    "fmi2GetVersion": ("xxxxxx", "xxxxxx"),
    "fmi2SetDebugLogging": ("xxxxxx", "xxxxxx"),
    "fmi2SetupExperiment": ("x.....", "x....."),
    "fmi2EnterInitializationMode": ("x.....", "x....."),
    "fmi2ExitInitializationMode": (".x....", ".x...."),
    "fmi2Terminate": ("..xx..", "..xx.."),
    "fmi2Reset": ("xxxxxx", "xxxxxx"),
    "fmi2GetReal": (".2xxx7", ".2x8x7"),
    "fmi2GetInteger": (".2xxx7", ".2x8x7"),
    "fmi2GetBoolean": (".2xxx7", ".2x8x7"),
    "fmi2GetString": (".2xxx7", ".2x8x7"),
    "fmi2SetReal": ("1345..", "136..."),
    "fmi2SetInteger": ("134...", "136..."),
    "fmi2SetBoolean": ("134...", "136..."),
    "fmi2SetString": ("134...", "136..."),
    "fmi2GetFMUstate": ("xxxxx7", "xxx8x7"),
    "fmi2SetFMUstate": ("xxxxxx", "xxxxxx"),
    "fmi2FreeFMUstate": ("xxxxxx", "xxxxxx"),
    "fmi2SerializedFMUstateSize": ("xxxxxx", "xxxxxx"),
    "fmi2SerializeFMUstate": ("xxxxxx", "xxxxxx"),
    "fmi2DeSerializeFMUstate": ("xxxxxx", "xxxxxx"),
    "fmi2GetDirectionalDerivative": (".xxxx7", ".xx8x7"),
}
_MODEL_EXCHANGE_ALONE = {
    "fmi2EnterEventMode": "..xx..",
    "fmi2NewDiscreteStates": "..x...",
    "fmi2EnterContinuousTimeMode": "..x...",
    "fmi2CompletedIntegratorStep": "...x..",
    "fmi2SetTime": "..8x..",
    "fmi2SetContinuousStates": "...x..",
    "fmi2GetEventIndicators": ".xxxx7",
    "fmi2GetContinuousStates": ".xxxx7",
    "fmi2GetDerivatives": ".xxxx7",
    "fmi2GetNominalsOfContinuousStates": "xxxxx7",
}
_CO_SIMULATION_ALONE = {
    "fmi2SetRealInputDerivatives": "xxx...",
    "fmi2GetRealOutputDerivatives": "..x8x7",
    "fmi2DoStep": "..x...",
    "fmi2CancelStep": "......",
    "fmi2GetStatus": "..xxx.",
    "fmi2GetRealStatus": "..xxx.",
    "fmi2GetIntegerStatus": "..xxx.",
    "fmi2GetBooleanStatus": "..xxx.",
    "fmi2GetStringStatus": "..xxx.",
}
FUNCTIONS = (*_COMMON, *_MODEL_EXCHANGE_ALONE, *_CO_SIMULATION_ALONE)


def mark(function: str, model_exchange: bool, state: str) -> str:
    """The mark of a function in a state; those of the other kind of FMU are allowed nowhere."""
    columns = MODEL_EXCHANGE if model_exchange else CO_SIMULATION
    if function in _COMMON:
        row = _COMMON[function][0 if model_exchange else 1]
    else:
        row = (_MODEL_EXCHANGE_ALONE if model_exchange else _CO_SIMULATION_ALONE).get(function, "......")
    return row[columns.index(state)]


def may_set(kind: VariableKind, condition: str) -> bool:
    """Whether a variable of that kind may be set on a condition, "." for no state to set anything in."""
    initial, causality, variability, is_state = kind.initial, kind.causality, kind.variability, kind.is_state
    return {
        "1": variability != "constant" and initial in ("exact", "approx"),
        "3": (variability != "constant" and initial == "exact") or causality == "input",
        "4": causality == "input" or (causality, variability) == ("parameter", "tunable"),
        "5": (causality, variability) == ("input", "continuous") or is_state,
        "6": causality == "input" or (causality, variability) == ("parameter", "tunable"),
        ".": False,
    }[condition]
