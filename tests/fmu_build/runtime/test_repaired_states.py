"""Serialized states that were changed and given the right checksum again: refused, or harmless.

`test_sanitizers.py` runs this too, where harmless includes every access to memory.
"""

from __future__ import annotations

import ctypes as c
import random
import struct

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, Instance
from tests.fmu_build.runtime.library3 import Instance3

HEADER, CHECKSUM = 96, 24
PLAIN = HEADER
"""Where the plain data begins, with the phase."""
_NUMBERS = (float("nan"), float("inf"), -float("inf"), -1.0, 1e300, -1e300, 5e-324, 0.5, 1e16)


def _repaired(data: bytes) -> bytes:
    """The bytes with the checksum (FNV-1a, of what follows the header) that belongs to them."""
    value = 14695981039346656037
    for byte in data[HEADER:]:
        value = (value ^ byte) * 1099511628211 % 2**64
    return data[:CHECKSUM] + struct.pack("=Q", value) + data[CHECKSUM + 8 :]


def _started(build: Build, model: str, kind: int = CO_SIMULATION) -> Instance:
    instance = Instance(build(model), kind)
    instance.initialize(stop=1.0)
    if kind == CO_SIMULATION:
        instance.advance(0.0, 0.05)
    else:
        instance.expect("fmi2EnterContinuousTimeMode")
    return instance


def _data(instance: Instance) -> bytes:
    state = instance.save()
    data = instance.serialize(state)
    instance.discard(state)
    return data


def _with(data: bytes, place: int, part: bytes) -> bytes:
    return _repaired(data[:place] + part + data[place + len(part) :])


def test_fmi_3_has_no_error_state(build3: Build) -> None:
    """There an error terminates. What would be in such a state could not free its saved states."""
    instance = Instance3(build3("oscillator"))
    instance.initialize(stop=1.0)
    instance.advance(0.0, 0.05)
    state = instance.save()
    data = instance.serialize(state)
    instance.discard(state)
    assert instance.deserialize(_with(data, PLAIN, struct.pack("=i", 8)))[0] == ERROR
    assert "phase" in instance.text
    instance.free()


def test_the_checksum_here_is_the_runtimes(build: Build) -> None:
    instance = _started(build, "oscillator")
    data = _data(instance)
    assert _repaired(data) == data
    instance.free()


@pytest.mark.parametrize("phase", [2, 3, 6, 9, 64, -1, 2**31 - 1])
def test_a_phase_that_the_instance_cannot_have_is_refused(build: Build, phase: int) -> None:
    instance = _started(build, "oscillator")
    data = _data(instance)
    assert struct.unpack_from("=i", data, PLAIN) == (4,), "the step complete state"
    assert instance.deserialize(_with(data, PLAIN, struct.pack("=i", phase)))[0] == ERROR
    assert "phase" in instance.text
    instance.advance(0.05, 0.05)
    instance.free()


@pytest.mark.parametrize("kind", [CO_SIMULATION, MODEL_EXCHANGE])
def test_every_truth_value_is_checked(build: Build, kind: int) -> None:
    """Each byte that can be one is made 0x10; the message tells which of them are."""
    instance = _started(build, "oscillator", kind)
    data = _data(instance)
    refused = set()
    for place in range(PLAIN, PLAIN + 120):
        instance.messages.clear()
        if data[place] <= 1:
            status, state = instance.deserialize(_with(data, place, b"\x10"))
            if "truth value" in instance.text:
                refused.add(place)
            if status == OK:
                instance.discard(state)
    # co_simulation; what changed (3); what is up to date (3); event_pending; ended_at_event
    assert len(refused) >= 9
    instance.free()


@pytest.mark.parametrize("model", ["growth", "ball", "sampler", "lag"])
@pytest.mark.parametrize("kind", [CO_SIMULATION, MODEL_EXCHANGE])
def test_random_changes_are_refused_or_harmless(build: Build, model: str, kind: int) -> None:
    instance = _started(build, model, kind)
    data = _data(instance)
    chance = random.Random(f"{model}{kind}")
    accepted = 0
    for _ in range(150):
        changed = bytearray(data)
        for _ in range(chance.randint(1, 3)):
            place = chance.randrange(PLAIN, len(data))
            match chance.randrange(3):
                case 0:
                    changed[place] ^= 1 << chance.randrange(8)
                case 1:
                    changed[place] = chance.choice((0, 1, 2, 16, 255))
                case _:
                    place -= place % 8
                    changed[place : place + 8] = struct.pack("=d", chance.choice(_NUMBERS))
        status, state = instance.deserialize(_repaired(bytes(changed)))
        if status == OK:
            accepted += 1
            instance.restore(state)
            _use(instance, kind)
            instance.restore(state)
            assert len(_data(instance)) == len(data)
            instance.discard(state)
    assert accepted > 5, "most values may be any number"
    instance.free()


def _use(instance: Instance, kind: int) -> None:
    """Calls whose status does not matter."""
    values, none = (c.c_double * 8)(), c.c_size_t(0)
    for reference in range(6):
        instance.call("fmi2GetReal", (c.c_uint * 1)(reference), c.c_size_t(1), values)
        instance.call("fmi2GetInteger", (c.c_uint * 1)(reference), c.c_size_t(1), values)
    time = c.c_double()
    instance.call("fmi2GetRealStatus", 2, c.byref(time))
    if kind == CO_SIMULATION:
        instance.step(time.value, 1e-3)
        instance.step(time.value + 1e-3, 0.0)
    else:
        instance.call("fmi2GetDerivatives", values, c.c_size_t(1))
        instance.call("fmi2EnterEventMode")
        instance.call("fmi2CompletedIntegratorStep", 1, c.byref(c.c_int()), c.byref(c.c_int()))
    instance.call("fmi2SetDebugLogging", 1, none, None)
    instance.call("fmi2Terminate")


def test_a_state_in_event_mode_is_for_instances_with_it(build3: Build) -> None:
    with_events, without = (Instance3(build3("ball"), event_mode=mode) for mode in (True, False))
    with_events.initialize()
    state = with_events.save()
    data = with_events.serialize(state)
    with_events.discard(state)
    assert without.deserialize(data)[0] == ERROR
    assert "phase" in without.text
    with_events.free()
    without.free()


@pytest.mark.parametrize("zero", [-1e300, 1.0, float("inf")])
def test_clocks_count_from_time_0_or_the_start_of_the_simulation(build: Build, zero: float) -> None:
    """The second clock's start is the only value in the block, behind the plain data, that is 2 here."""
    instance = Instance(build("sampler"))
    instance.initialize(start=2.0, stop=3.0)
    instance.advance(2.0, 0.05)
    data = _data(instance)
    place = data.rindex(struct.pack("=d", 2.0))
    assert instance.deserialize(_with(data, place, struct.pack("=d", zero)))[0] == ERROR
    assert "times, steps and events" in instance.text
    status, state = instance.deserialize(_with(data, place, struct.pack("=d", 0.0)))
    assert status == OK, "as before the initialization"
    instance.discard(state)
    assert instance.deserialize(_with(data, place - 8, struct.pack("=d", 2.0)))[0] == ERROR, (
        "the first clock's"
    )
    instance.free()
