"""Systems of equations inside the model: z + z^3 = x with der(x) = -z, and one without a solution."""

from __future__ import annotations

import math

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import ERROR, MODEL_EXCHANGE, OK, Instance

X, Z, W, FLOOR = range(4)


def _z(x: float) -> float:
    """Cardano's solution of z^3 + z = x."""
    root = math.sqrt(x * x / 4.0 + 1.0 / 27.0)
    return math.cbrt(x / 2.0 + root) + math.cbrt(x / 2.0 - root)


def _time(z: float) -> float:
    """When z is reached from z = 1 at t = 0: the integral of dx/z = (1 + 3*z^2)/z dz."""
    return 1.5 * (1.0 - z * z) - math.log(z)


def test_solution_along_the_way(build: Build) -> None:
    instance = Instance(build("loop"))
    instance.initialize(1e-10)
    for i, (x, z, w) in enumerate(instance.run(3.0, 30, (X, Z, W))):
        assert _time(z) == pytest.approx(i * 0.1, abs=1e-9)
        assert z == pytest.approx(_z(x), rel=1e-13)
        assert w == pytest.approx(0.5 * x + z, rel=1e-15)
    instance.free()


@pytest.mark.parametrize("start", [-1e6, -3.0, 0.0, 1e-9, 40.0, 1e9])
def test_far_first_guesses(build: Build, start: float) -> None:
    """Newton's method starts from z = 1."""
    instance = Instance(build("loop"), MODEL_EXCHANGE)
    assert instance.set({X: start, FLOOR: -1e12}) == OK
    instance.initialize()
    (z,) = instance.get(Z)
    assert z + z**3 == pytest.approx(start, rel=1e-12, abs=1e-14)
    instance.free()


def test_no_solution_at_the_start(build: Build) -> None:
    instance = Instance(build("loop"))
    assert instance.set({FLOOR: 3.0}) == OK
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    assert instance.call("fmi2ExitInitializationMode") == ERROR
    assert "At time 0: the algebraic loop of `s` could not be solved: singular Jacobian" in instance.text
    instance.free()


def test_solution_that_ceases_on_the_way(build: Build) -> None:
    """Below x = 1 there is none: the integrator comes as close as it can and says where.

    There the Jacobian is zero but for rounding, so that Newton's method may name that or the residual.
    """
    instance = Instance(build("loop"))
    assert instance.set({FLOOR: 1.0}) == OK
    instance.initialize()
    time = _time(_z(1.0))
    assert instance.step(0.0, 0.9 * time) == OK
    assert instance.step(0.9 * time, time) == ERROR
    assert f"time {time:.6f}" in instance.text
    assert "the algebraic loop of `s` could not be solved: " in instance.text
    instance.free()
