"""FMI 2.0: every function in every state, and every kind of variable in every state that sets something."""

from __future__ import annotations

import ctypes as c

import pytest

from tests.fmu_build.runtime.conformance import standard2
from tests.fmu_build.runtime.conformance.states2 import arguments, in_state
from tests.fmu_build.runtime.conformance.variables import LAG, VariableKind
from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    CO_SIMULATION,
    DISCARD,
    ERROR,
    MODEL_EXCHANGE,
    OK,
    Instance,
    live_blocks,
)

_NAMES = {
    "instantiated": "the instantiated state",
    "initialization": "Initialization Mode",
    "event": "Event Mode",
    "continuous": "Continuous-Time Mode",
    "complete": "the step complete state",
    "failed": "the step failed state",
    "terminated": "the terminated state",
    "error": "the error state",
}
_STATES = [
    *((MODEL_EXCHANGE, state) for state in standard2.MODEL_EXCHANGE),
    *((CO_SIMULATION, state) for state in standard2.CO_SIMULATION),
]
# Allowed beyond the standard, for importers that go by its earlier editions (2.0 to 2.0.4 allow both).
_ALSO_ALLOWED = {("fmi2SetTime", "event")}
# What only steps in the background would make known.
_DISCARDED = ("fmi2GetIntegerStatus", "fmi2GetStringStatus")
# Where it is absent, the description says so, and the call is refused for that reason alone.
_PERHAPS_ABSENT = ("fmi2GetDirectionalDerivative",)
# Nothing to be called on an instance.
_WITHOUT_INSTANCE = ("fmi2GetVersion", "fmi2GetTypesPlatform")


@pytest.mark.parametrize("function", standard2.FUNCTIONS)
@pytest.mark.parametrize(("kind", "state"), _STATES)
def test_function_in_state(build: Build, kind: int, state: str, function: str) -> None:
    instance = in_state(build, kind, state)
    saved = instance.save()
    data = instance.serialize(saved)
    mark = standard2.mark(function, kind == MODEL_EXCHANGE, state)
    # Pure discrete-time FMUs alone could fulfill condition 8 of Model Exchange.
    allowed = mark != "." and (kind, mark) != (MODEL_EXCHANGE, "8")
    if function in _WITHOUT_INSTANCE:
        ask = instance.library[function]
        ask.restype = c.c_char_p
        assert ask() in (b"2.0", b"default")
    elif allowed or (function, state) in _ALSO_ALLOWED:
        status = instance.call(function, *arguments(function, saved, data))
        if function in _PERHAPS_ABSENT:
            assert "not allowed" not in instance.text
        else:
            assert status == (DISCARD if function in _DISCARDED else OK), instance.text
    else:
        assert instance.call(function, *arguments(function, saved, data)) == ERROR
        name = "Co-Simulation" if kind == CO_SIMULATION else "Model Exchange"
        assert instance.text == f"{function} is not allowed in {_NAMES[state]} of {name}."
        assert instance.serialize(instance.save()) == data, "a refused call has no effect"
    instance.discard(saved)
    instance.free()


def _set(instance: Instance, reference: int, kind: VariableKind) -> int:
    if kind.type == "Real":
        return instance.set({reference: kind.value})
    return instance.set_one("Boolean" if kind.type == "Boolean" else "Integer", reference, int(kind.value))


@pytest.mark.parametrize("variable", LAG, ids=lambda variable: variable.name)
@pytest.mark.parametrize(("kind", "state"), [s for s in _STATES if s[1] not in ("failed", "error")])
def test_variable_in_state(build: Build, kind: int, state: str, variable: VariableKind) -> None:
    instance = in_state(build, kind, state, "lag")
    function = "fmi2Set" + {"Enumeration": "Integer"}.get(variable.type, variable.type)
    condition = standard2.mark(function, kind == MODEL_EXCHANGE, state)
    allowed = standard2.may_set(variable, condition)
    if condition == "1":
        # The standard leaves inputs out since 2.0.1; importers set their start values here all the same.
        allowed = allowed or variable.causality == "input"
    status = _set(instance, LAG.index(variable), variable)
    assert status == (OK if allowed else ERROR), instance.text
    if not allowed and condition != ".":
        assert f'"{variable.name}"' in instance.text
    instance.free()


@pytest.mark.parametrize(("kind", "state"), _STATES)
def test_instances_are_freed_in_every_state(build: Build, kind: int, state: str) -> None:
    before = live_blocks(build("growth"))
    instance = in_state(build, kind, state)
    assert live_blocks(build("growth")) > before
    instance.free()
    assert live_blocks(build("growth")) == before
