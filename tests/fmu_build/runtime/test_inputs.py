"""Inputs in co-simulation, on a first-order lag, tau = 0.5: tau*der(x) = u - x."""

from __future__ import annotations

import ctypes as c
import math

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import ERROR, OK, Instance

TIME, X, DER_X, Y, U, GEAR, ON, TAU, GAIN, HALF, HIGH, LAST_GEAR = range(12)
LAG = 0.5


def _ramp(time: float, slope: float) -> float:
    return slope * (time - LAG * (1.0 - math.exp(-time / LAG)))


@pytest.mark.parametrize("steps", [1, 3, 50, 1000])
def test_ramp_by_input_derivatives_is_exact(build: Build, steps: int) -> None:
    instance = Instance(build("lag"))
    instance.initialize(1e-10)
    end, slope = 2.0, 0.7
    size = end / steps
    for i in range(steps):
        assert instance.set({U: slope * i * size}) == OK
        assert instance.set_slope(U, slope) == OK
        assert instance.step(i * size, size) == OK
        x, u = instance.get(X, U)
        assert x == pytest.approx(_ramp((i + 1) * size, slope), abs=2e-10)
        assert u == pytest.approx(slope * (i + 1) * size, abs=1e-14)
    instance.free()


def test_input_derivative_lasts_for_one_step(build: Build) -> None:
    """After the ramp of the first step the input stays at 1, as no derivative is given for the second one."""
    instance = Instance(build("lag"))
    instance.initialize(1e-10)
    assert instance.set_slope(U, 1.0) == OK
    assert instance.step(0.0, 1.0) == OK
    at_one = instance.get(X)[0]
    assert instance.step(1.0, 1.0) == OK
    assert instance.get(U) == [1.0]
    assert instance.get(X)[0] == pytest.approx(1.0 + (at_one - 1.0) * math.exp(-1.0 / LAG), abs=1e-9)
    instance.free()


def test_relation_on_a_ramp_is_an_event_within_the_step(build: Build) -> None:
    """The input 2*t passes 1.5 at t = 0.75."""
    instance = Instance(build("lag"), debug=True)
    instance.initialize()
    assert instance.set_slope(U, 2.0) == OK
    assert instance.get_one("Boolean", HIGH) == 0
    assert instance.step(0.0, 1.0) == OK
    assert instance.get_one("Boolean", HIGH) == 1
    assert "State event at time 0.75" in instance.text
    instance.free()


@pytest.mark.parametrize("period", [1, 3])
def test_stairs_are_held_and_each_change_counts_from_its_point(build: Build, period: int) -> None:
    """The input is n from t = n/10*period on; x follows by the exact solution of each tread."""
    instance = Instance(build("lag"))
    instance.initialize(1e-10)
    expected, size = 0.0, 0.1
    for i in range(30):
        u = 0.2 * (i // period)
        assert instance.set({U: u}) == OK
        assert instance.step(i * size, size) == OK
        expected = u + (expected - u) * math.exp(-size / LAG)
        assert instance.get(X)[0] == pytest.approx(expected, abs=5e-10)
    instance.free()


def test_output_that_depends_on_an_input_follows_at_once(build: Build) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.set({U: 2.0}) == OK
    x, y, der_x = instance.get(X, Y, DER_X)
    assert y == 3.0 * x + 1.0 + 2.0
    assert der_x == (2.0 - x) / LAG
    instance.free()


def test_change_of_an_input_is_an_event_where_a_relation_changes(build: Build) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.set({U: 1.4}) == OK
    assert instance.step(0.5, 0.5) == OK
    assert instance.get_one("Boolean", HIGH) == 0
    assert instance.set({U: 1.6}) == OK
    assert instance.step(1.0, 0.5) == OK
    assert instance.get_one("Boolean", HIGH) == 1
    assert instance.statistics()["events"] == 1
    instance.free()


def test_change_of_a_discrete_input_is_an_event(build: Build) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.set_one("Integer", GEAR, 3) == OK
    assert instance.get_one("Integer", LAST_GEAR) == 1
    assert instance.step(0.5, 0.0) == OK, "a step of size 0 carries the event out"
    assert instance.get_one("Integer", LAST_GEAR) == 3
    instance.free()


def test_tunable_parameter_and_what_depends_on_it(build: Build) -> None:
    instance = Instance(build("lag"))
    assert instance.set({TAU: 2.0}) == OK
    instance.initialize(1e-10)
    assert instance.get(HALF) == [1.0]
    assert instance.set({TAU: 4.0, U: 1.0}) == OK
    assert instance.get(HALF) == [2.0]
    assert instance.step(0.0, 1.0) == OK
    assert instance.get(X)[0] == pytest.approx(1.0 - math.exp(-0.25), abs=1e-9)
    instance.free()


@pytest.mark.parametrize(
    ("reference", "slope", "order", "why"),
    [
        (U, 1.0, 2, "order 1"),
        (U, math.nan, 1, "finite"),
        (TAU, 1.0, 1, "continuous input"),
        (GEAR, 1.0, 1, "Integer"),
    ],
)
def test_impossible_input_derivatives_are_refused(
    build: Build, reference: int, slope: float, order: int, why: str
) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.set_slope(reference, slope, order) == ERROR
    assert why in instance.text
    instance.free()


def test_output_derivatives(build: Build) -> None:
    """der(x) is exact; y = 3*x + gear + u with the input held has the derivative 3*der(x)."""
    instance = Instance(build("lag"))
    instance.initialize(1e-10)
    assert instance.set({U: 1.0}) == OK
    assert instance.step(0.0, 0.3) == OK
    slope = math.exp(-0.3 / LAG) / LAG
    assert _output_derivative(instance, X) == pytest.approx(slope, abs=1e-9)
    assert _output_derivative(instance, Y) == pytest.approx(3.0 * slope, rel=1e-8)
    instance.free()


def _output_derivative(instance: Instance, reference: int) -> float:
    value = c.c_double()
    instance.expect(
        "fmi2GetRealOutputDerivatives",
        (c.c_uint * 1)(reference),
        c.c_size_t(1),
        (c.c_int * 1)(1),
        c.byref(value),
    )
    return value.value
