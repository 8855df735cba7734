"""FMI 2 instances in each of the standard's states, and arguments with which a call should succeed."""

from __future__ import annotations

import ctypes as c

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    CO_SIMULATION,
    DISCARD,
    DO_STEP_STATUS,
    ERROR,
    LAST_SUCCESSFUL_TIME,
    OK,
    PENDING_STATUS,
    TERMINATED,
    EventInfo,
    Instance,
)

# The model "growth": one state, parameters that end it or make it fail at x = 2, two relations.
X, END, LIMIT = 0, 3, 5


def in_state(build: Build, kind: int, phase: str, model: str = "growth") -> Instance:
    """An instance in a state; only "growth" fails or has an error."""
    instance = Instance(build(model), kind)
    if phase == "instantiated":
        return instance
    if phase in ("failed", "error"):
        assert instance.set({END if phase == "failed" else LIMIT: 2.0}) == OK
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    if phase == "initialization":
        return instance
    instance.expect("fmi2ExitInitializationMode")
    if phase == "continuous":
        instance.expect("fmi2EnterContinuousTimeMode")
    elif phase == "terminated":
        instance.expect("fmi2Terminate")
    elif phase == "failed":
        assert instance.step(0.0, 1.0) == DISCARD
    elif phase == "error" and kind == CO_SIMULATION:
        assert instance.step(0.0, 1.0) == ERROR
    elif phase == "error":
        instance.expect("fmi2EnterContinuousTimeMode")
        instance.expect("fmi2SetContinuousStates", (c.c_double * 1)(3.0), c.c_size_t(1))
        assert (
            instance.call("fmi2CompletedIntegratorStep", 1, c.byref(c.c_int()), c.byref(c.c_int())) == ERROR
        )
    instance.messages.clear()
    return instance


def arguments(function: str, state: c.c_void_p, data: bytes) -> tuple[object, ...]:
    """Valid arguments for a function."""
    none, one, x = c.c_size_t(0), c.c_size_t(1), (c.c_uint * 1)(X)
    real, order, empty = (c.c_double * 2)(), (c.c_int * 1)(1), c.c_void_p()
    length = c.c_size_t(len(data))
    arguments: dict[str, tuple[object, ...]] = {
        "fmi2SetDebugLogging": (0, none, None),
        "fmi2SetupExperiment": (1, 1e-6, 0.0, 0, 0.0),
        "fmi2GetReal": (x, one, real),
        "fmi2GetFMUstate": (c.byref(empty),),
        "fmi2SetFMUstate": (state,),
        "fmi2FreeFMUstate": (c.byref(empty),),
        "fmi2SerializedFMUstateSize": (state, c.byref(c.c_size_t())),
        "fmi2SerializeFMUstate": (state, c.create_string_buffer(len(data)), length),
        "fmi2DeSerializeFMUstate": (data, length, c.byref(empty)),
        "fmi2NewDiscreteStates": (c.byref(EventInfo()),),
        "fmi2CompletedIntegratorStep": (1, c.byref(c.c_int()), c.byref(c.c_int())),
        "fmi2SetTime": (0.0,),
        "fmi2SetContinuousStates": ((c.c_double * 1)(1.0), one),
        "fmi2GetDerivatives": (real, one),
        "fmi2GetEventIndicators": (real, c.c_size_t(2)),
        "fmi2GetContinuousStates": (real, one),
        "fmi2GetNominalsOfContinuousStates": (real, one),
        "fmi2SetRealInputDerivatives": (None, none, None, None),
        "fmi2GetRealOutputDerivatives": (x, one, order, real),
        "fmi2DoStep": (0.0, 0.1, 1),
        "fmi2GetStatus": (DO_STEP_STATUS, c.byref(c.c_int())),
        "fmi2GetRealStatus": (LAST_SUCCESSFUL_TIME, c.byref(c.c_double())),
        "fmi2GetBooleanStatus": (TERMINATED, c.byref(c.c_int())),
        "fmi2GetIntegerStatus": (DO_STEP_STATUS, c.byref(c.c_int())),
        "fmi2GetStringStatus": (PENDING_STATUS, c.byref(c.c_char_p())),
        "fmi2GetDirectionalDerivative": (None, none, None, none, None, None),
    }
    sets_or_gets = function[4:7] in ("Get", "Set") and function[7:] in (
        "Real",
        "Integer",
        "Boolean",
        "String",
    )
    return arguments.get(function, (None, none, None) if sets_or_gets else ())
