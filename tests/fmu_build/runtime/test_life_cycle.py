"""Which function is allowed when: FMI 2.0.4, the tables of sections 3.2.3 and 4.2.4."""

from __future__ import annotations

import ctypes as c

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    CO_SIMULATION,
    DISCARD,
    DO_STEP_STATUS,
    ERROR,
    LAST_SUCCESSFUL_TIME,
    MODEL_EXCHANGE,
    OK,
    PENDING_STATUS,
    TERMINATED,
    TOKEN,
    EventInfo,
    Instance,
)

# The model "growth": one state, parameters that end it or make it fail at x = 2, two relations.
X, END, LIMIT = 0, 3, 5

_PHASES = {
    MODEL_EXCHANGE: ("instantiated", "initialization", "event", "continuous", "terminated", "error"),
    CO_SIMULATION: ("instantiated", "initialization", "complete", "discarded", "terminated", "error"),
}
_NAMES = {
    "instantiated": "instantiated state",
    "initialization": "Initialization Mode",
    "event": "Event Mode",
    "continuous": "Continuous-Time Mode",
    "complete": "step complete state",
    "discarded": "step failed state",
    "terminated": "terminated state",
    "error": "error state",
}
_EVERYWHERE = "instantiated initialization event continuous complete discarded terminated error"
_READING = "initialization event continuous complete discarded terminated error"
_SETTING = "instantiated initialization event complete"
_COMMON = {
    "fmi2SetDebugLogging": _EVERYWHERE,
    "fmi2SetupExperiment": "instantiated",
    "fmi2EnterInitializationMode": "instantiated",
    "fmi2ExitInitializationMode": "initialization",
    "fmi2Terminate": "event continuous complete discarded",
    "fmi2Reset": _EVERYWHERE,
    "fmi2GetReal": _READING,
    "fmi2GetInteger": _READING,
    "fmi2GetBoolean": _READING,
    "fmi2GetString": _READING,
    "fmi2SetReal": _SETTING + " continuous",
    "fmi2SetInteger": _SETTING,
    "fmi2SetBoolean": _SETTING,
    "fmi2SetString": _SETTING,
    "fmi2GetFMUstate": _EVERYWHERE,
    "fmi2SetFMUstate": _EVERYWHERE,
    "fmi2FreeFMUstate": _EVERYWHERE,
    "fmi2SerializedFMUstateSize": _EVERYWHERE,
    "fmi2SerializeFMUstate": _EVERYWHERE,
    "fmi2DeSerializeFMUstate": _EVERYWHERE,
}
_ALLOWED = {
    MODEL_EXCHANGE: _COMMON
    | {
        "fmi2EnterEventMode": "event continuous",
        "fmi2NewDiscreteStates": "event",
        "fmi2EnterContinuousTimeMode": "event",
        "fmi2CompletedIntegratorStep": "continuous",
        "fmi2SetTime": "event continuous",
        "fmi2SetContinuousStates": "continuous",
        "fmi2GetDerivatives": _READING,
        "fmi2GetEventIndicators": _READING,
        "fmi2GetContinuousStates": _READING,
        "fmi2GetNominalsOfContinuousStates": _EVERYWHERE,
    },
    CO_SIMULATION: _COMMON
    | {
        "fmi2SetRealInputDerivatives": "instantiated initialization complete",
        "fmi2GetRealOutputDerivatives": "complete discarded terminated error",
        "fmi2DoStep": "complete",
        "fmi2GetStatus": "complete discarded terminated",
        "fmi2GetRealStatus": "complete discarded terminated",
        "fmi2GetBooleanStatus": "complete discarded terminated",
    },
}
_EVERY_FUNCTION = sorted(_ALLOWED[MODEL_EXCHANGE] | _ALLOWED[CO_SIMULATION])


def _in_phase(build: Build, kind: int, phase: str) -> Instance:
    instance = Instance(build("growth"), kind)
    if phase == "instantiated":
        return instance
    if phase in ("discarded", "error"):
        assert instance.set({END if phase == "discarded" else LIMIT: 2.0}) == OK
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    if phase == "initialization":
        return instance
    instance.expect("fmi2ExitInitializationMode")
    if phase == "continuous":
        instance.expect("fmi2EnterContinuousTimeMode")
    elif phase == "terminated":
        instance.expect("fmi2Terminate")
    elif phase == "discarded":
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


def _arguments(function: str, state: c.c_void_p, data: bytes) -> tuple[object, ...]:
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
    }
    sets_or_gets = function[4:7] in ("Get", "Set") and function[7:] in (
        "Real",
        "Integer",
        "Boolean",
        "String",
    )
    return arguments.get(function, (None, none, None) if sets_or_gets else ())


@pytest.mark.parametrize("function", _EVERY_FUNCTION)
@pytest.mark.parametrize(
    ("kind", "phase"), [(kind, phase) for kind, phases in _PHASES.items() for phase in phases]
)
def test_function_in_phase(build: Build, kind: int, phase: str, function: str) -> None:
    instance = _in_phase(build, kind, phase)
    state = instance.save()
    data = instance.serialize(state)
    status = instance.call(function, *_arguments(function, state, data))
    if phase in _ALLOWED[kind].get(function, ""):
        assert status == OK, instance.text
    else:
        assert status == ERROR
        kind_name = "Co-Simulation" if kind == CO_SIMULATION else "Model Exchange"
        assert instance.text == f"{function} is not allowed in {_phase_text(phase)} of {kind_name}."
        assert instance.serialize(instance.save()) == data, "a refused call has no effect"
    instance.discard(state)
    instance.free()


def _phase_text(phase: str) -> str:
    name = _NAMES[phase]
    return name if "Mode" in name else f"the {name}"


def test_cancel_step_is_never_allowed(build: Build) -> None:
    for phase in _PHASES[CO_SIMULATION]:
        instance = _in_phase(build, CO_SIMULATION, phase)
        assert instance.call("fmi2CancelStep") == ERROR
        instance.free()


def test_status_that_a_synchronous_slave_has_not_is_discarded(build: Build) -> None:
    instance = _in_phase(build, CO_SIMULATION, "complete")
    text, number = c.c_char_p(), c.c_int()
    assert instance.call("fmi2GetStringStatus", PENDING_STATUS, c.byref(text)) == DISCARD
    assert instance.call("fmi2GetIntegerStatus", DO_STEP_STATUS, c.byref(number)) == DISCARD
    assert instance.call("fmi2GetStatus", PENDING_STATUS, c.byref(number)) == DISCARD
    assert instance.call("fmi2GetRealStatus", TERMINATED, c.byref(c.c_double())) == DISCARD
    assert instance.call("fmi2GetBooleanStatus", LAST_SUCCESSFUL_TIME, c.byref(number)) == DISCARD
    instance.free()


def test_last_step_is_known(build: Build) -> None:
    instance = _in_phase(build, CO_SIMULATION, "discarded")
    status = c.c_int()
    instance.expect("fmi2GetStatus", DO_STEP_STATUS, c.byref(status))
    assert status.value == DISCARD
    instance.free()


@pytest.mark.parametrize(
    ("kind", "token", "name", "why"),
    [
        (CO_SIMULATION, "{other}", "test", "GUID"),
        (CO_SIMULATION, TOKEN, "", "no name"),
        (7, TOKEN, "test", "neither"),
    ],
)
def test_impossible_instances_are_refused(build: Build, kind: int, token: str, name: str, why: str) -> None:
    instance = Instance(build("growth"), kind, token=token, name=name)
    assert instance.handle is None
    assert why in instance.text


def test_null_pointers_are_refused(build: Build) -> None:
    library = build("growth")
    assert library.fmi2DoStep(None, c.c_double(0.0), c.c_double(0.1), 1) == ERROR
    instance = _in_phase(build, CO_SIMULATION, "complete")
    assert instance.call("fmi2GetReal", None, c.c_size_t(1), None) == ERROR
    assert "null pointer" in instance.text
    assert instance.call("fmi2GetFMUstate", None) == ERROR
    assert instance.call("fmi2SetFMUstate", None) == ERROR
    instance.expect("fmi2FreeFMUstate", None)
    instance.free()
    library.fmi2FreeInstance(None)


def test_version_and_platform(build: Build) -> None:
    library = build("growth")
    for name, expected in (("fmi2GetVersion", b"2.0"), ("fmi2GetTypesPlatform", b"default")):
        function = library[name]
        function.restype = c.c_char_p
        assert function() == expected


def test_log_categories(build: Build) -> None:
    instance = Instance(build("growth"))
    names = (c.c_char_p * 1)(b"logEvents")
    instance.expect("fmi2SetDebugLogging", 1, c.c_size_t(1), names)
    assert instance.set({END: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 1.0) == DISCARD
    assert {category for _, category, _ in instance.messages} == {"logEvents", "logStatusDiscard"}
    instance.expect("fmi2Reset")
    instance.messages.clear()
    instance.expect(
        "fmi2SetDebugLogging", 0, c.c_size_t(2), (c.c_char_p * 2)(b"logEvents", b"logStatusDiscard")
    )
    assert instance.set({END: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 1.0) == DISCARD
    assert not instance.messages
    assert instance.step(1.0, 1.0) == ERROR
    assert instance.messages, "errors are always told"
    assert instance.call("fmi2SetDebugLogging", 1, c.c_size_t(1), (c.c_char_p * 1)(b"logNonsense")) == ERROR
    assert "log category" in instance.text
    instance.free()


def test_only_the_standards_functions_are_exported(build: Build) -> None:
    library = build("growth")
    for name in ("model", "instance_create", "integrator_step", "event_update", "block_solve"):
        with pytest.raises(AttributeError):
            library[name]
