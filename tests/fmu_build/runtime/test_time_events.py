"""Time events of a sampler with a period of 0.1 s: at their times, whatever the communication points."""

from __future__ import annotations

import ctypes as c

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import MODEL_EXCHANGE, OK, EventInfo, Instance

X, HELD, TICKS = range(3)


@pytest.mark.parametrize("size", [0.9, 0.3, 0.1, 0.07, 0.001])
def test_ticks_are_at_their_times(build: Build, size: float) -> None:
    """The ramp x = t is held as it is at the last tick; a tick at a communication point belongs to it."""
    instance = Instance(build("sampler"))
    instance.initialize()
    steps = round(0.9 / size)
    for i in range(steps):
        assert instance.step(i * size, size) == OK
        time = (i + 1) * size
        x, held, ticks = instance.get(X, HELD, TICKS)
        assert x == pytest.approx(time, abs=1e-14)
        passed = int(time * 10.0 + 1e-9)
        assert ticks == passed + 1
        assert held == pytest.approx(passed / 10.0, abs=1e-14)
    instance.free()


def test_many_events_are_no_crowd(build: Build) -> None:
    """A thousand events are too many only at practically the same time."""
    instance = Instance(build("sampler"))
    instance.initialize()
    instance.advance(0.0, 150.05)
    assert instance.get(TICKS) == [1501.0]
    instance.free()


def test_next_time_event_is_told_in_model_exchange(build: Build) -> None:
    instance = Instance(build("sampler"), MODEL_EXCHANGE)
    instance.initialize()
    info = EventInfo()
    instance.expect("fmi2NewDiscreteStates", c.byref(info))
    for tick in range(1, 8):
        assert info.next_event_time_defined
        assert info.next_event_time == tick / 10.0
        instance.expect("fmi2EnterContinuousTimeMode")
        instance.expect("fmi2SetTime", info.next_event_time)
        instance.expect("fmi2SetContinuousStates", (c.c_double * 1)(info.next_event_time), c.c_size_t(1))
        instance.expect("fmi2EnterEventMode")
        instance.expect("fmi2NewDiscreteStates", c.byref(info))
        assert instance.get(HELD, TICKS) == [tick / 10.0, tick + 1.0]
    instance.free()


def test_saved_state_holds_the_clock(build: Build) -> None:
    instance = Instance(build("sampler"))
    instance.initialize()
    assert instance.step(0.0, 0.25) == OK
    state = instance.save()
    assert instance.step(0.25, 0.5) == OK
    expected = instance.get(X, HELD, TICKS)
    instance.restore(state)
    assert instance.get(TICKS) == [3.0]
    assert instance.step(0.25, 0.5) == OK
    assert instance.get(X, HELD, TICKS) == expected
    instance.discard(state)
    instance.free()
