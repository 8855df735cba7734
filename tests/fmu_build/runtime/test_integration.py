"""The integrator in co-simulation, on an oscillator whose solution is cos(t)."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import ERROR, OK, WARNING, Instance
from tests.fmu_build.runtime.library3 import Instance3

X, V, E, K = range(4)
# Of the model "lag", tau*der(x) = u - x.
LAG_X, LAG_U, TAU = 1, 4, 7
TORQUE, DAMPING = 7, 9  # of the model "joystick"


def _largest_error(build: Build, tolerance: float, steps: int) -> float:
    instance = Instance(build("oscillator"))
    instance.initialize(tolerance)
    end = 10.0
    errors = [abs(x - math.cos(i * end / steps)) for i, (x,) in enumerate(instance.run(end, steps, (X,)))]
    instance.free()
    return max(errors)


def test_error_follows_tolerance(build: Build) -> None:
    errors = [_largest_error(build, 10.0**-n, 100) for n in range(4, 13)]
    for n, error in zip(range(4, 13), errors, strict=True):
        assert error <= 10.0**-n, (n, error)
    for looser, tighter in pairwise(errors[:-1]):
        assert 3.0 < looser / tighter < 30.0


def test_states_and_energy_agree(build: Build) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize()
    for x, v, energy in instance.run(3.0, 7, (X, V, E)):
        assert energy == 0.5 * (x * x + v * v)
    instance.free()


def test_communication_points_do_not_steer_the_integrator(build: Build) -> None:
    """Points of both runs have bit-identical values, and the integrator takes the same steps."""
    coarse, fine = Instance(build("oscillator")), Instance(build("oscillator"))
    coarse.initialize()
    fine.initialize()
    few, many = coarse.run(8.0, 16, (X, V)), fine.run(8.0, 4096, (X, V))
    assert many[:: 4096 // 16] == few
    assert coarse.statistics() == fine.statistics()
    coarse.free()
    fine.free()


def test_equal_value_is_no_change(build: Build) -> None:
    touched, untouched = Instance(build("oscillator")), Instance(build("oscillator"))
    touched.initialize()
    untouched.initialize()
    for i in range(100):
        assert touched.set({K: 1.0}) == OK
        assert touched.step(i * 0.125, 0.125) == untouched.step(i * 0.125, 0.125) == OK
        assert touched.get(X, V) == untouched.get(X, V)
    assert touched.statistics() == untouched.statistics()
    touched.free()
    untouched.free()


def test_change_of_parameter_starts_from_the_communication_point(build: Build) -> None:
    """With k = 4 from t = 1 on: x = cos(1)*cos(2*(t - 1)) - sin(1)/2*sin(2*(t - 1))."""
    instance = Instance(build("oscillator"))
    instance.initialize(1e-10)
    assert instance.step(0.0, 1.0) == OK
    assert instance.set({K: 4.0}) == OK
    assert instance.get(E)[0] == pytest.approx(2.0 * math.cos(1.0) ** 2 + 0.5 * math.sin(1.0) ** 2, abs=1e-9)
    assert instance.step(1.0, 2.0) == OK
    expected = math.cos(1.0) * math.cos(4.0) - 0.5 * math.sin(1.0) * math.sin(4.0)
    assert instance.get(X)[0] == pytest.approx(expected, abs=1e-9)
    instance.free()


def test_step_of_size_zero_changes_nothing(build: Build) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize()
    assert instance.step(0.0, 0.3) == OK
    before = instance.get(X, V)
    assert instance.step(0.3, 0.0) == OK
    assert instance.get(X, V) == before
    instance.free()


@pytest.mark.parametrize(
    ("point", "size", "why"),
    [
        (0.5, -0.1, "negative"),
        (0.5, math.nan, "finite"),
        (math.inf, 0.1, "finite"),
        (0.4, 0.1, "not where the last step ended"),
        (0.6, 0.1, "not where the last step ended"),
        (0.5, 0.6, "beyond the stop time"),
    ],
)
def test_impossible_steps_are_refused(build: Build, point: float, size: float, why: str) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize(stop=1.0)
    assert instance.step(0.0, 0.5) == OK
    assert instance.step(point, size) == ERROR
    assert why in instance.text
    assert instance.step(0.5, 0.5) == OK, "a refused call has no effect"
    instance.free()


def test_rounding_in_the_importers_time_is_no_fault(build: Build) -> None:
    instance = Instance(build("oscillator"))
    instance.initialize(stop=1.0)
    time = 0.0
    for _ in range(10):
        assert instance.step(time, 0.1) == OK, instance.text
        time += 0.1
    assert time != 1.0
    instance.free()


@pytest.mark.parametrize(
    ("tolerance", "start", "stop", "why"),
    [
        (-1.0, 0.0, 1.0, "tolerance"),
        (math.nan, 0.0, 1.0, "tolerance"),
        (1e-6, math.nan, 1.0, "start time"),
        (1e-6, 2.0, 1.0, "stop time"),
    ],
)
def test_impossible_experiments_are_refused(
    build: Build, tolerance: float, start: float, stop: float, why: str
) -> None:
    instance = Instance(build("oscillator"))
    assert instance.call("fmi2SetupExperiment", 1, tolerance, start, 1, stop) == ERROR
    assert why in instance.text
    instance.free()


@pytest.mark.parametrize("tolerance", [1e-20, 0.5])
def test_tolerance_out_of_reach_is_warned_of(build: Build, tolerance: float) -> None:
    instance = Instance(build("oscillator"))
    assert instance.call("fmi2SetupExperiment", 1, tolerance, 0.0, 0, 0.0) == WARNING
    assert f"{tolerance:g}" in instance.text
    instance.expect("fmi2EnterInitializationMode")
    instance.expect("fmi2ExitInitializationMode")
    (x,) = instance.run(1.0, 1, (X,))[-1]
    assert x == pytest.approx(math.cos(1.0), abs=max(tolerance, 1e-13))
    instance.free()


def test_right_hand_side_that_fails_is_reported_with_its_time(build: Build) -> None:
    """der(x) = x^2 from x = 1 is infinite at t = 1."""
    instance = Instance(build("growth"))
    assert instance.set({2: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.get(0)[0] == pytest.approx(2.0, abs=1e-7)
    assert instance.step(0.5, 1.0) == ERROR
    assert "time 0.99999" in instance.text or "time 1.0000" in instance.text
    assert instance.step(0.5, 0.1) == ERROR, "nothing goes on after a failure"
    instance.expect("fmi2Reset")
    instance.free()


def _end_in_error(build: Build, build3: Build, model: str, values: dict[int, float], size: float) -> str:
    """What a step that fails says; what was saved before it can be restored, and a reset helps."""
    old, new = Instance(build(model)), Instance3(build3(model))
    assert old.set(values) == new.set(values) == OK
    old.initialize(stop=10.0 * size)
    new.initialize(stop=10.0 * size)
    saved = old.save()
    before = old.get(*values)
    assert old.step(0.0, size) == new.step(0.0, size).status == ERROR
    assert new.text.split(": ")[-1] == old.text.split(": ")[-1]
    old.restore(saved)
    assert old.get(*values) == before
    old.discard(saved)
    old.expect("fmi2Reset")
    old.initialize()
    assert old.step(0.0, 0.1) == OK
    text = old.text
    old.free()
    new.free()
    return text


def test_steps_that_hardly_move_the_time_are_an_error(build: Build, build3: Build) -> None:
    """So large a torque moves the joystick from kink to kink in next to no time."""
    text = _end_in_error(build, build3, "joystick", {X: 0.0, TORQUE: 1e298}, 0.1)
    assert "1000 events at practically the same time" in text


@pytest.mark.parametrize(
    ("model", "values", "size"),
    [
        ("oscillator", {K: 1e6}, 1e9),
        ("lag", {LAG_U: 1.0, TAU: 1e-3}, 1e9),
        ("joystick", {DAMPING: 1e8}, 0.1),
    ],
    ids=["oscillations without end", "stiff", "stiff joystick"],
)
def test_steps_that_come_to_nothing_are_an_error(
    build: Build, build3: Build, model: str, values: dict[int, float], size: float
) -> None:
    text = _end_in_error(build, build3, model, values, size)
    assert "too stiff for this solver: the last 1000000 steps were of about" in text


def test_many_steps_are_no_error(build: Build) -> None:
    """Some 5 million steps in one communication step."""
    instance = Instance(build("oscillator"))
    assert instance.set({K: 1e4}) == OK
    instance.initialize(1e-4, stop=1e4)
    assert instance.step(0.0, 1e4) == OK
    assert instance.statistics()["steps"] > 1_000_000
    instance.free()


def test_the_largest_steps_there_are(build: Build) -> None:
    """At rest a step may go as far as there are numbers, and not beyond."""
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.step(0.0, 1e308) == OK
    assert instance.step(1e308, 0.7e308) == OK
    assert instance.get(LAG_X) == [0.0]
    assert instance.step(1.7e308, 0.7e308) == ERROR
    assert "their sum must be finite" in instance.text
    instance.free()
