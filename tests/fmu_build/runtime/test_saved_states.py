"""Saved states continue exactly like the original, also after serialization and in another instance."""

from __future__ import annotations

import ctypes as c
from collections.abc import Callable

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, Instance
from tests.fmu_build.runtime.saved_runs import check_detours, steps


@pytest.mark.parametrize("model", ["joystick", "ball", "oscillator"])
def test_restored_run_is_bit_identical(build: Build, model: str) -> None:
    check_detours(Instance(build(model)), "fmi2Reset", 1)


def test_serialized_state_continues_in_another_instance(build: Build) -> None:
    first, second = Instance(build("joystick")), Instance(build("joystick"))
    assert first.set({8: 0.012}) == OK
    first.initialize(1e-9, stop=2.0)
    steps(first, 0, 37)
    state = first.save()
    data = first.serialize(state)
    assert data == first.serialize(state)
    status, copy = second.deserialize(data)
    assert status == OK
    second.restore(copy)
    assert steps(first, 37, 200) == steps(second, 37, 200)
    assert first.get(3, 4, 5, 6, 8) == second.get(3, 4, 5, 6, 8)
    first.discard(state)
    second.discard(copy)
    assert first.statistics() == second.statistics()
    first.free()
    second.free()


def test_state_is_overwritten_in_place(build: Build) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize()
    state = instance.save()
    address = state.value
    steps(instance, 0, 10)
    instance.expect("fmi2GetFMUstate", c.byref(state))
    assert state.value == address
    expected = steps(instance, 10, 20)
    instance.restore(state)
    assert steps(instance, 10, 20) == expected
    instance.discard(state)
    instance.free()


def test_state_holds_inputs_and_their_derivatives(build: Build) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.set({4: 1.0}) == OK
    assert instance.set_slope(4, 0.5) == OK
    state = instance.save()
    assert instance.step(0.0, 0.5) == OK
    expected = instance.get(1, 4)
    assert expected[1] == 1.25
    instance.restore(state)
    assert instance.get(4) == [1.0]
    assert instance.step(0.0, 0.5) == OK
    assert instance.get(1, 4) == expected
    instance.discard(state)
    instance.free()


def test_state_holds_what_was_changed_since_the_last_step(build: Build) -> None:
    """The integrator is ahead of the importer; a new input or parameter has it start anew from the point."""
    instance = Instance(build("lag"))
    instance.initialize()
    instance.advance(0.0, 0.3)
    assert instance.set({4: 1.0, 7: 2.0}) == OK
    state = instance.save()
    instance.advance(0.3, 0.05)
    expected = instance.get(1, 2, 9)
    instance.restore(state)
    instance.advance(0.3, 0.05)
    assert instance.get(1, 2, 9) == expected
    assert expected[2] == 1.0, "the computed parameter"
    instance.discard(state)
    instance.free()


def test_what_is_up_to_date_is_restored_too(build: Build) -> None:
    """The energy is computed at a later point, and was not yet where the state was saved."""
    instance = Instance(build("oscillator"))
    instance.initialize()
    instance.advance(0.0, 0.3)
    state = instance.save()
    instance.advance(0.3, 0.3)
    instance.get(2)
    instance.restore(state)
    x, v, energy = instance.get(0, 1, 2)
    assert energy == 0.5 * (x * x + v * v)
    instance.discard(state)
    instance.free()


def test_state_brings_a_failed_instance_back(build: Build) -> None:
    instance = Instance(build("slide"))
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    state = instance.save()
    assert instance.step(0.5, 1.0) == ERROR
    instance.restore(state)
    assert instance.step(0.5, 0.25) == OK
    assert instance.get(0)[0] == pytest.approx(0.25, abs=1e-14)
    instance.discard(state)
    instance.free()


def test_model_exchange_state(build: Build) -> None:
    instance = Instance(build("ball"), MODEL_EXCHANGE)
    instance.initialize()
    instance.expect("fmi2EnterContinuousTimeMode")
    state = instance.save()
    instance.expect("fmi2SetTime", 3.0)
    instance.expect("fmi2SetContinuousStates", (c.c_double * 2)(5.0, 6.0), c.c_size_t(2))
    instance.expect("fmi2EnterEventMode")
    instance.restore(state)
    assert instance.get(0, 1) == [1.0, 0.0]
    instance.expect("fmi2CompletedIntegratorStep", 1, c.byref(c.c_int()), c.byref(c.c_int()))
    instance.discard(state)
    instance.free()


def _damaged(data: bytes, where: int) -> bytes:
    return data[:where] + bytes([data[where] ^ 0x10]) + data[where + 1 :]


@pytest.mark.parametrize(
    ("spoil", "why"),
    [
        (lambda data: data[:-1], "size is wrong"),
        (lambda data: data + b"x", "size is wrong"),
        (lambda data: data[:10], "too short"),
        (lambda data: b"", "too short"),
        (lambda data: _damaged(data, 3), "not a saved FMU state"),
        (lambda data: _damaged(data, 8), "another version"),
        (lambda data: _damaged(data, 40), "another model"),
        (lambda data: _damaged(data, len(data) - 5), "damaged"),
        (lambda data: _damaged(data, 130), "damaged"),
    ],
)
def test_spoilt_bytes_are_refused(build: Build, spoil: Callable[[bytes], bytes], why: str) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize()
    state = instance.save()
    data = instance.serialize(state)
    instance.discard(state)
    status, nothing = instance.deserialize(spoil(data))
    assert status == ERROR
    assert not nothing.value
    assert why in instance.text
    assert instance.step(0.0, 0.1) == OK
    instance.free()


def test_bytes_of_another_kind_of_instance_are_refused(build: Build) -> None:
    exchange, slave = (
        Instance(build("oscillator"), MODEL_EXCHANGE),
        Instance(build("oscillator"), CO_SIMULATION),
    )
    state = exchange.save()
    status, _ = slave.deserialize(exchange.serialize(state))
    assert status == ERROR
    assert "Model Exchange" in slave.text
    assert slave.call("fmi2SetFMUstate", state) == ERROR
    exchange.discard(state)
    exchange.free()
    slave.free()
