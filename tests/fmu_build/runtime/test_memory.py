"""Memory: every allocation may fail, instances are freed completely, states replace each other."""

from __future__ import annotations

import ctypes as c
from collections.abc import Callable

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    CO_SIMULATION,
    ERROR,
    MODEL_EXCHANGE,
    OK,
    EventInfo,
    Instance,
    fail_after,
    live_blocks,
)
from tests.fmu_build.runtime.library3 import Instance3

_ONE, _X = c.c_size_t(1), (c.c_uint * 1)(0)
Life = Callable[[c.CDLL, int], "Instance | Instance3"]


def _life2(library: c.CDLL, kind: int) -> Instance:
    """A life with everything that allocates; no call's status matters."""
    instance = Instance(library, kind)
    if instance.handle is None:
        return instance
    value, state, data = (c.c_double * 2)(), c.c_void_p(), c.create_string_buffer(20_000)
    instance.call("fmi2SetupExperiment", 1, 1e-6, 0.0, 0, 0.0)
    instance.call("fmi2EnterInitializationMode")
    instance.call("fmi2GetDirectionalDerivative", _X, _ONE, _X, _ONE, value, value)
    instance.call("fmi2ExitInitializationMode")
    if kind == CO_SIMULATION:
        instance.step(0.0, 0.1)
        instance.call("fmi2GetRealOutputDerivatives", _X, _ONE, (c.c_int * 1)(1), value)
    else:
        instance.call("fmi2NewDiscreteStates", c.byref(EventInfo()))
        instance.call("fmi2EnterContinuousTimeMode")
        instance.call("fmi2CompletedIntegratorStep", 1, c.byref(c.c_int()), c.byref(c.c_int()))
    instance.call("fmi2GetDirectionalDerivative", _X, _ONE, _X, _ONE, value, value)
    if instance.call("fmi2GetFMUstate", c.byref(state)) == OK:
        size = c.c_size_t()
        instance.call("fmi2SerializedFMUstateSize", state, c.byref(size))
        instance.call("fmi2SerializeFMUstate", state, data, size)
        instance.call("fmi2DeSerializeFMUstate", data, size, c.byref(state))
        instance.call("fmi2FreeFMUstate", c.byref(state))
    instance.free()
    return instance


def _life3(library: c.CDLL, kind: int) -> Instance3:
    """The same with FMI 3; what it shares with FMI 2 is left out."""
    intermediate = (0,) if kind == CO_SIMULATION else ()
    instance = Instance3(library, kind, intermediate=intermediate, on_update=lambda _: None)
    if instance.handle is None:
        return instance
    if instance.enter_initialization() == OK:
        instance.call("fmi3ExitInitializationMode")
    instance.free()
    return instance


@pytest.mark.parametrize("kind", [CO_SIMULATION, MODEL_EXCHANGE])
@pytest.mark.parametrize(("version", "model"), [(2, "growth"), (2, "loop"), (3, "growth")])
def test_every_allocation_may_fail(build: Build, build3: Build, version: int, model: str, kind: int) -> None:
    """It is told of, nothing leaks, and with memory the next instance is as good as any."""
    library, life = ((build, _life2), (build3, _life3))[version - 2]
    loaded = library(model)
    before = live_blocks(loaded)
    expected = life(loaded, kind).text
    assert "emory" not in expected
    failures = 0
    while True:
        fail_after(loaded, failures)
        instance = life(loaded, kind)
        assert live_blocks(loaded) == before
        if instance.text == expected:
            break
        assert "emory" in instance.text, failures
        failures += 1
    fail_after(loaded, -1)
    assert failures >= 4
    assert life(loaded, kind).text == expected


def test_reading_a_state_replaces_the_one_before(build: Build) -> None:
    library = build("oscillator")
    instance = Instance(library)
    instance.initialize()
    state = instance.save()
    data = instance.serialize(state)
    before = live_blocks(library)
    arguments = (data, c.c_size_t(len(data)), c.byref(state))
    instance.expect("fmi2DeSerializeFMUstate", *arguments)
    assert live_blocks(library) == before
    instance.restore(state)
    damaged = (data[:-1] + bytes([data[-1] ^ 1]), *arguments[1:])
    assert instance.call("fmi2DeSerializeFMUstate", *damaged) == ERROR
    assert live_blocks(library) == before
    instance.restore(state)
    instance.discard(state)
    assert live_blocks(library) == before - 1
    instance.free()
