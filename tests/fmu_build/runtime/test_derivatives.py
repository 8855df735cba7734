"""Directional derivatives: der(x) = -z with z + z^3 = x and s^2 = x - floor, whose derivatives are known."""

from __future__ import annotations

import ctypes as c
from collections.abc import Sequence

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, Instance
from tests.fmu_build.runtime.library3 import Instance3

X, Z, W, FLOOR, S, DER_X = range(6)
KINDS = (MODEL_EXCHANGE, CO_SIMULATION)


def _call(instance: Instance, unknowns: Sequence[int], seed: dict[int, float]) -> tuple[int, list[float]]:
    n, m = len(unknowns), len(seed)
    result = (c.c_double * n)()
    status = instance.call(
        "fmi2GetDirectionalDerivative",
        (c.c_uint * n)(*unknowns),
        c.c_size_t(n),
        (c.c_uint * m)(*seed),
        c.c_size_t(m),
        (c.c_double * m)(*seed.values()),
        result,
    )
    return status, list(result)


def _derivatives(instance: Instance, unknowns: Sequence[int], seed: dict[int, float]) -> list[float]:
    status, values = _call(instance, unknowns, seed)
    assert status == OK, instance.text
    return values


@pytest.mark.parametrize("kind", KINDS)
def test_systems_of_equations_move_by_their_linearization(build: Build, kind: int) -> None:
    instance = Instance(build("loop"), kind)
    assert instance.set({FLOOR: -2.0}) == OK
    instance.initialize()
    x, z, s = instance.get(X, Z, S)
    assert (x, z, s) == pytest.approx((2.0, 1.0, 2.0), rel=1e-14)
    by_x = _derivatives(instance, (X, Z, W, S, DER_X), {X: 1.0})
    assert by_x == pytest.approx([1.0, 0.25, 0.75, 0.25, -0.25], rel=1e-14)
    assert _derivatives(instance, (Z, S), {FLOOR: 1.0}) == pytest.approx([0.0, -0.25], rel=1e-14)
    # Linear in the seed, whose parts add up where a known is named twice.
    assert _derivatives(instance, (S,), {X: 3.0, FLOOR: 1.0}) == pytest.approx([0.5], rel=1e-14)
    assert _derivatives(instance, (), {X: 1.0}) == []
    assert _derivatives(instance, (S, Z), {}) == [0.0, 0.0]
    instance.free()


@pytest.mark.parametrize("kind", KINDS)
def test_adjoint_derivatives_of_fmi3_are_the_transposed_ones(build3: Build, kind: int) -> None:
    instance = Instance3(build3("loop"), kind)
    assert instance.set({FLOOR: -2.0}) == OK
    instance.initialize()
    found = (c.c_double * 2)()
    instance.expect(
        "fmi3GetAdjointDerivative",
        *((c.c_uint32 * 3)(Z, S, DER_X), c.c_size_t(3), (c.c_uint32 * 2)(X, FLOOR), c.c_size_t(2)),
        *((c.c_double * 3)(1.0, 10.0, 100.0), c.c_size_t(3), found, c.c_size_t(2)),
    )
    assert list(found) == pytest.approx([0.25 + 10.0 * 0.25 - 100.0 * 0.25, -10.0 * 0.25], rel=1e-14)
    instance.free()


def test_in_initialization_mode(build: Build) -> None:
    instance = Instance(build("loop"))
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    assert instance.set({FLOOR: -2.0}) == OK
    assert _derivatives(instance, (Z, S), {X: 1.0}) == pytest.approx([0.25, 0.25], rel=1e-14)
    assert instance.set({X: 0.0}) == OK
    assert _derivatives(instance, (Z,), {X: 1.0}) == pytest.approx([1.0], rel=1e-14)
    instance.free()


def test_a_run_with_derivatives_is_the_run_without(build: Build) -> None:
    """Also the first guesses of Newton's method stay what they were."""
    runs = []
    for asks in (False, True):
        instance = Instance(build("loop"))
        instance.initialize()
        values = []
        for i in range(40):
            if asks:
                _derivatives(instance, (Z, W, S, DER_X), {X: 1.0, FLOOR: 1.0})
            assert instance.step(i * 0.05, 0.05) == OK
            values.append(instance.get(X))
        runs.append(values)
        instance.free()
    assert runs[0] == runs[1]


@pytest.mark.parametrize(
    ("unknown", "known", "message"),
    [
        (99, X, "There is no variable with value reference 99"),
        (Z, 99, "There is no variable with value reference 99"),
        (FLOOR, X, 'Variable "floor" has no derivative: it is not computed.'),
        (Z, W, 'There are no derivatives with respect to variable "w"'),
        (Z, DER_X, 'There are no derivatives with respect to variable "der(x)"'),
    ],
)
def test_what_cannot_be_an_unknown_or_a_known(build: Build, unknown: int, known: int, message: str) -> None:
    instance = Instance(build("loop"))
    instance.initialize()
    assert _call(instance, (unknown,), {known: 1.0})[0] == ERROR
    assert message in instance.text
    assert _derivatives(instance, (Z,), {X: 1.0})
    instance.free()


def test_no_derivative_where_there_is_none(build: Build) -> None:
    instance = Instance(build("loop"))
    instance.initialize()
    assert _call(instance, (Z,), {X: float("nan")})[0] == ERROR
    assert 'variable "z" has no finite derivative' in instance.text
    instance.free()


def test_missing_arrays(build: Build) -> None:
    instance = Instance(build("loop"))
    instance.initialize()
    one, reference, value = c.c_size_t(1), (c.c_uint * 1)(X), (c.c_double * 1)(1.0)
    arguments = [reference, one, reference, one, value, value]
    for missing in (0, 2, 4, 5):
        given = [None if i == missing else argument for i, argument in enumerate(arguments)]
        assert instance.call("fmi2GetDirectionalDerivative", *given) == ERROR
    assert instance.text.count("null pointer") == 4
    instance.free()


@pytest.mark.parametrize("kind", KINDS)
def test_allowed_from_initialization_mode_on(build: Build, kind: int) -> None:
    instance = Instance(build("loop"), kind)
    assert _call(instance, (Z,), {X: 1.0})[0] == ERROR
    assert "not allowed in the instantiated state" in instance.text
    instance.initialize()
    assert _derivatives(instance, (Z,), {X: 1.0})
    if kind == MODEL_EXCHANGE:
        instance.expect("fmi2EnterContinuousTimeMode")
        assert _derivatives(instance, (Z,), {X: 1.0})
    instance.expect("fmi2Terminate")
    assert _derivatives(instance, (Z,), {X: 1.0})
    instance.free()


def test_a_model_without_derivatives_says_so(build: Build) -> None:
    instance = Instance(build("lag"))
    instance.initialize()
    assert _call(instance, (0,), {0: 1.0})[0] == ERROR
    assert "the model does not provide them" in instance.text
    instance.free()
