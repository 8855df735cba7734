"""Model Exchange: a minimal importer runs the models through every mode."""

from __future__ import annotations

import ctypes as c
import math

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import ERROR, MODEL_EXCHANGE, OK, EventInfo, Instance

H, V, BOUNCES = range(3)


def _doubles(instance: Instance, function: str, n: int) -> list[float]:
    values = (c.c_double * n)()
    instance.expect(function, values, c.c_size_t(n))
    return list(values)


def _put(instance: Instance, time: float, states: list[float]) -> None:
    n = len(states)
    instance.expect("fmi2SetTime", time)
    instance.expect("fmi2SetContinuousStates", (c.c_double * n)(*states), c.c_size_t(n))


def _event(instance: Instance) -> EventInfo:
    info = EventInfo()
    instance.expect("fmi2EnterEventMode")
    instance.expect("fmi2NewDiscreteStates", c.byref(info))
    instance.expect("fmi2EnterContinuousTimeMode")
    return info


def _started(build: Build, model: str) -> Instance:
    instance = Instance(build(model), MODEL_EXCHANGE)
    instance.initialize()
    info = EventInfo()
    instance.expect("fmi2NewDiscreteStates", c.byref(info))
    assert not info.new_discrete_states_needed
    assert not info.next_event_time_defined
    instance.expect("fmi2EnterContinuousTimeMode")
    return instance


def test_derivatives_and_states(build: Build) -> None:
    instance = _started(build, "oscillator")
    _put(instance, 0.5, [0.25, -2.0])
    assert _doubles(instance, "fmi2GetContinuousStates", 2) == [0.25, -2.0]
    assert _doubles(instance, "fmi2GetDerivatives", 2) == [-2.0, -0.25]
    assert _doubles(instance, "fmi2GetNominalsOfContinuousStates", 2) == [1.0, 1.0]
    assert instance.get(2) == [0.5 * (0.25**2 + 4.0)]
    instance.free()


def test_bounce_changes_the_states(build: Build) -> None:
    instance = _started(build, "ball")
    speed = math.sqrt(20.0)
    _put(instance, 0.4472, [-1e-9, -speed])
    info = _event(instance)
    assert info.states_changed
    assert not info.terminate
    assert _doubles(instance, "fmi2GetContinuousStates", 2) == [-1e-9, 0.5 * speed]
    assert instance.get(BOUNCES) == [1.0]
    _put(instance, 0.5, [0.1, 1.0])
    assert not _event(instance).states_changed
    instance.free()


def test_indicators_have_a_hysteresis_about_the_memory(build: Build) -> None:
    """Positive down to h = -1e-12 while the ball is above; once it is below, negative up to h = 1e-12."""
    instance = _started(build, "ball")
    for height, sign in ((1e-3, 1), (0.0, 1), (-0.9e-12, 1), (-1.1e-12, -1)):
        _put(instance, 0.4, [height, -1.0])
        assert math.copysign(1, _doubles(instance, "fmi2GetEventIndicators", 1)[0]) == sign, height
    _event(instance)
    for height, sign in ((-1.1e-12, -1), (0.0, 1), (0.9e-12, -1), (1.1e-12, 1)):
        _put(instance, 0.4, [height, 1.0])
        assert math.copysign(1, _doubles(instance, "fmi2GetEventIndicators", 1)[0]) == sign, height
    instance.free()


def test_relations_stay_as_they_are_between_events(build: Build) -> None:
    """The derivative of "slide" changes its sign with x only when the importer carries out the event."""
    instance = _started(build, "slide")
    _put(instance, 1.5, [-0.5])
    assert _doubles(instance, "fmi2GetDerivatives", 1) == [-1.0]
    _event(instance)
    assert _doubles(instance, "fmi2GetDerivatives", 1) == [1.0]
    instance.free()


def test_terminate_and_assertions(build: Build) -> None:
    instance = Instance(build("growth"), MODEL_EXCHANGE)
    assert instance.set({3: 2.0, 5: 4.0}) == OK
    instance.initialize()
    instance.expect("fmi2EnterContinuousTimeMode")
    _put(instance, 0.7, [2.1])
    info = _event(instance)
    assert info.terminate
    _put(instance, 1.5, [4.5])
    assert instance.call("fmi2CompletedIntegratorStep", 1, c.byref(c.c_int()), c.byref(c.c_int())) == ERROR
    assert "x is above its limit: 4.5" in instance.text
    instance.free()


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_time_and_states_must_be_finite(build: Build, value: float) -> None:
    instance = _started(build, "oscillator")
    assert instance.call("fmi2SetTime", value) == ERROR
    assert instance.call("fmi2SetContinuousStates", (c.c_double * 2)(1.0, value), c.c_size_t(2)) == ERROR
    assert _doubles(instance, "fmi2GetContinuousStates", 2) == [1.0, 0.0]
    instance.free()


@pytest.mark.parametrize(
    "function",
    ["fmi2GetDerivatives", "fmi2GetContinuousStates", "fmi2GetEventIndicators", "fmi2SetContinuousStates"],
)
def test_arrays_of_another_size_are_refused(build: Build, function: str) -> None:
    instance = _started(build, "ball")
    assert instance.call(function, (c.c_double * 5)(), c.c_size_t(5)) == ERROR
    assert "size" in instance.text
    instance.free()
