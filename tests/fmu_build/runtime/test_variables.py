"""Reading and setting variables: types, ranges and permissions by phase."""

from __future__ import annotations

import ctypes as c
import math

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, Instance

# The model "lag".
TIME, X, DER_X, Y, U, GEAR, ON, TAU, GAIN, HALF, HIGH, LAST_GEAR = range(12)


@pytest.mark.parametrize(
    ("reference", "value", "words"),
    [
        (TAU, 1e-4, ('"tau"', "0.0001", "0.001 to 1000")),
        (TAU, -1.0, ('"tau"', "-1", "0.001 to 1000")),
        (TAU, math.nan, ('"tau"', "nan", "finite")),
        (TAU, math.inf, ('"tau"', "inf", "finite")),
        (U, 10.5, ('"u"', "10.5", "-10 to 10")),
        (HALF, 1.0, ('"half"', "calculated parameter")),
        (Y, 1.0, ('"y"', "output")),
        (DER_X, 1.0, ('"der(x)"', "local variable")),
        (TIME, 1.0, ('"time"', "independent")),
        (GEAR, 1.0, ('"gear"', "Integer", "not Real")),
        (99, 1.0, ("99", "12")),
    ],
)
def test_bad_values_are_refused_by_name_and_the_old_one_is_kept(
    build: Build, reference: int, value: float, words: tuple[str, ...]
) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    before = instance.get(TAU, U, HALF, X)
    assert instance.set({TAU: 0.7, reference: value} if reference != TAU else {TAU: value}) == ERROR
    for word in words:
        assert word in instance.text
    assert instance.get(TAU, U, HALF, X) == before, "neither this nor the other variable of the call"
    assert instance.step(0.0, 0.1) == OK
    instance.free()


@pytest.mark.parametrize("value", [0, 4, -7])
def test_integer_range(build: Build, value: int) -> None:
    instance = Instance(build("lag"))
    assert instance.set_one("Integer", GEAR, value) == ERROR
    assert '"gear"' in instance.text
    assert f"{value}: the allowed range is 1 to 3" in instance.text
    instance.initialize()
    assert instance.get_one("Integer", GEAR) == 1
    instance.free()


@pytest.mark.parametrize(
    ("kind", "reference"), [("Boolean", GEAR), ("Integer", ON), ("Integer", U), ("Boolean", 12)]
)
def test_wrong_types_are_refused(build: Build, kind: str, reference: int) -> None:
    instance = Instance(build("lag"))
    assert instance.set_one(kind, reference, 1) == ERROR
    assert instance.messages
    instance.free()


def test_bounds_themselves_are_allowed(build: Build) -> None:
    instance = Instance(build("lag"))
    assert instance.set({TAU: 1e-3, U: -10.0}) == OK
    assert instance.set_one("Integer", GEAR, 3) == OK
    assert instance.set_one("Boolean", ON, 1) == OK
    instance.initialize()
    assert instance.get(TAU, U) == [1e-3, -10.0]
    assert instance.get_one("Integer", GEAR) == 3
    assert instance.get_one("Boolean", ON) == 1
    instance.free()


def test_fixed_parameter_and_start_value_only_before_the_end_of_initialization(build: Build) -> None:
    instance = Instance(build("lag"))
    assert instance.set({GAIN: 2.0, X: 0.5}) == OK
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    assert instance.set({GAIN: 4.0}) == OK
    assert instance.get(X, Y) == [0.5, 4.0 * 0.5 + 1.0]
    assert instance.set({X: 0.25, U: 1.0}) == OK
    assert instance.get(X, Y, DER_X) == [0.25, 4.0 * 0.25 + 1.0 + 1.0, (1.0 - 0.25) / 0.5]
    instance.expect("fmi2ExitInitializationMode")
    assert instance.get(X, Y) == [0.25, 3.0]
    assert instance.set({GAIN: 5.0}) == ERROR
    assert "after the initialization" in instance.text
    assert instance.set({X: 0.0}) == ERROR
    instance.free()


def test_model_exchange_continuous_time_takes_continuous_inputs_alone(build: Build) -> None:
    instance = Instance(build("lag"), MODEL_EXCHANGE)
    instance.initialize()
    assert instance.set({TAU: 0.25}) == OK
    assert instance.get(HALF) == [0.125]
    instance.expect("fmi2EnterContinuousTimeMode")
    assert instance.set({U: 1.0}) == OK
    assert instance.get(DER_X) == [4.0]
    assert instance.set({TAU: 0.5}) == ERROR
    assert instance.get(TAU) == [0.25]
    instance.free()


@pytest.mark.parametrize("kind", [MODEL_EXCHANGE, CO_SIMULATION])
def test_strings(build: Build, kind: int) -> None:
    instance = Instance(build("lag"), kind)
    instance.initialize()
    reference, value = (c.c_uint * 1)(0), (c.c_char_p * 1)(b"text")
    instance.expect("fmi2GetString", None, c.c_size_t(0), None)
    instance.expect("fmi2SetString", None, c.c_size_t(0), None)
    assert instance.call("fmi2GetString", reference, c.c_size_t(1), value) == ERROR
    assert instance.call("fmi2SetString", reference, c.c_size_t(1), value) == ERROR
    assert "no variable of type String" in instance.text
    instance.free()
