"""FMI 3 instances in each of the standard's states, and arguments with which a call should succeed."""

from __future__ import annotations

import ctypes as c
from collections.abc import Callable

from tests.fmu_build.runtime.conformance.standard3 import TYPES
from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, OK
from tests.fmu_build.runtime.library3 import Instance3

Call = Callable[[Instance3], None]


def in_state(
    build: Build, kind: int, state: str, call: Call, model: str = "growth", output: int = 0, x: int = 0
) -> Instance3:
    """Brings an instance into a state and makes a call there; "update" is within a communication step.

    `output` and `x` are what may be accessed in intermediate updates: inputs would be asked for all the time.
    """
    called: list[bool] = []

    def once(_: object) -> None:
        if not called:
            called.append(True)
            call(instance)

    attended = state == "update"
    instance = Instance3(
        build(model),
        kind,
        event_mode=kind == CO_SIMULATION and not attended,
        intermediate=tuple({output, x}) if attended else (),
        on_update=once if attended else None,
    )
    if attended:
        instance.initialize()
        instance.messages.clear()
        instance.step(0.0, 0.01)
        assert called
        return instance
    _bring(instance, kind, state)
    instance.messages.clear()
    call(instance)
    return instance


def _bring(instance: Instance3, kind: int, state: str) -> None:
    if state == "instantiated":
        return
    assert instance.enter_initialization() == OK
    if state == "initialization":
        return
    instance.expect("fmi3ExitInitializationMode")
    if state in ("continuous", "step"):
        assert instance.update().status == OK
        instance.expect("fmi3EnterStepMode" if kind == CO_SIMULATION else "fmi3EnterContinuousTimeMode")
    elif state == "terminated":
        instance.expect("fmi3Terminate")


def arguments(function: str, state: c.c_void_p, data: bytes) -> tuple[object, ...]:
    """Valid arguments for a function; those for variables are for none of them."""
    none, one = c.c_size_t(0), c.c_size_t(1)
    real, count, empty = (c.c_double * 2)(), c.c_size_t(), c.c_void_p()
    flags = [c.byref(c.c_bool()) for _ in range(5)]
    length = c.c_size_t(len(data))
    name = function.removeprefix("fmi3")
    known: dict[str, tuple[object, ...]] = {
        "SetDebugLogging": (True, none, None),
        "EnterInitializationMode": (True, 1e-6, 0.0, False, 0.0),
        "GetBinary": (None, none, None, None, none),
        "SetBinary": (None, none, None, None, none),
        "GetFMUState": (c.byref(empty),),
        "SetFMUState": (state,),
        "FreeFMUState": (c.byref(empty),),
        "SerializedFMUStateSize": (state, c.byref(count)),
        "SerializeFMUState": (state, c.create_string_buffer(len(data)), length),
        "DeserializeFMUState": (data, length, c.byref(empty)),
        "GetDirectionalDerivative": (None, none, None, none, None, none, None, none),
        "GetAdjointDerivative": (None, none, None, none, None, none, None, none),
        "GetNumberOfVariableDependencies": (0, c.byref(count)),
        "GetVariableDependencies": (0, None, None, None, None, none),
        "UpdateDiscreteStates": (*flags, c.byref(c.c_double())),
        "CompletedIntegratorStep": (True, *flags[:2]),
        "SetTime": (0.0,),
        "SetContinuousStates": ((c.c_double * 1)(1.0), one),
        "GetContinuousStateDerivatives": (real, one),
        "GetEventIndicators": (real, c.c_size_t(2)),
        "GetContinuousStates": (real, one),
        "GetNominalsOfContinuousStates": (real, one),
        "GetNumberOfEventIndicators": (c.byref(count),),
        "GetNumberOfContinuousStates": (c.byref(count),),
        "GetOutputDerivatives": (None, none, None, None, none),
        "DoStep": (0.0, 0.1, True, *flags[:3], c.byref(c.c_double())),
        "ActivateModelPartition": (0, 0.0),
    }
    if name in known:
        return known[name]
    if name[3:] in TYPES:
        return (None, none, None, none)
    clocks = ("Clock", "Interval", "Shift")
    return (None, none, None, None, None) if name[3:].startswith(clocks) else ()
