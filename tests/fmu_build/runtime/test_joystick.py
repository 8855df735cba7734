"""The joystick released at -20 degrees, against SciPy's method of order 8 with its own event location."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import DOP853
from scipy.optimize import brentq

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import Instance

_END, _POINTS = 1.5, 900
_INERTIA, _MASS, _HEIGHT, _GRAVITY, _A, _B, _DAMPING = 0.01135, 0.87, 0.082, 9.80665, 0.02398, 0.005, 0.045
# Per side (k_s, k_h, F_0, x_0) of the return and of the balance spring.
_SPRINGS = {
    1: ((2625.0, 427375.0, 52.7808125, 0.075e-3), (2975.0, 1022400.0, 11.2464, 2.932e-3)),
    -1: ((1191.0, 657809.0, 55.5848605, 0.075e-3), (2899.0, 1107910.0, 9.97119, 3.054e-3)),
}
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Solution:
    """States at the communication points, and the times of the events."""

    states: Array
    events: list[float]


def _travel(theta: float, side: int) -> float:
    return _A * side * math.tan(theta) + _B * (1.0 - 1.0 / math.cos(theta))


def _switches(theta: float) -> list[float]:
    values = [theta]
    for side, springs in _SPRINGS.items():
        for _, k_h, f_0, x_0 in springs:
            values += [_travel(theta, side) - x_0, _travel(theta, side) - x_0 - f_0 / k_h]
    return values


def _right_hand_side(mode: list[bool]) -> Callable[[float, Array], Array]:
    side = 1 if mode[0] else -1
    first = 1 if mode[0] else 5

    def derivatives(_time: float, y: Array) -> Array:
        theta, omega = float(y[0]), float(y[1])
        x = _travel(theta, side)
        force = 0.0
        for i, (k_s, k_h, f_0, x_0) in enumerate(_SPRINGS[side]):
            if mode[first + 2 * i]:
                released = mode[first + 2 * i + 1]
                force += f_0 + k_s * (x - x_0) if released else (k_h + k_s) * (x - x_0)
        contact = (_A * side + (x - _B) * math.tan(theta)) * force
        gravity = _MASS * _GRAVITY * _HEIGHT * math.sin(theta)
        return np.array([omega, (gravity - contact - _DAMPING * omega) / _INERTIA])

    return derivatives


def _mode(theta: float) -> list[bool]:
    return [value > 0.0 for value in _switches(theta)]


def _first_switch(solver: DOP853, mode: list[bool]) -> float | None:
    """The first time in the solver's last step at which a switch changes."""
    dense = solver.dense_output()
    low = solver.t_old
    for high in np.linspace(solver.t_old, solver.t, 9)[1:]:
        changed = [i for i, now in enumerate(_mode(dense(high)[0])) if now != mode[i]]
        if changed:
            return float(min(_root(dense, i, low, high) for i in changed))
        low = high
    return None


def _root(dense: Callable[[float], Array], i: int, low: float, high: float) -> float:
    values = [_switches(dense(t)[0])[i] for t in (low, high)]
    if values[0] * values[1] > 0.0:  # it starts from zero, with rounding on the other side
        return low
    return float(brentq(lambda t: _switches(dense(t)[0])[i], low, high, xtol=1e-16, rtol=1e-15))


@pytest.fixture(scope="module")
def truth() -> Solution:
    times = np.linspace(0.0, _END, _POINTS + 1)
    states, events = np.empty((_POINTS + 1, 2)), []
    time, y, done = 0.0, np.array([math.radians(-20.0), 0.0]), 0
    mode = _mode(y[0])
    while done <= _POINTS:
        solver = DOP853(_right_hand_side(mode), time, y, 2.0 * _END, rtol=1e-13, atol=1e-14)
        switch = None
        while switch is None and done <= _POINTS:
            solver.step()
            switch = _first_switch(solver, mode)
            reached = solver.t if switch is None else switch
            while done <= _POINTS and times[done] <= reached:
                states[done] = solver.dense_output()(times[done])
                done += 1
        if switch is not None:
            # Past the switch by more than its rounding, so that the switch is seen to have changed.
            time = switch + 1e-15
            y = solver.dense_output()(time)
            mode = _mode(y[0])
            if time <= _END:
                events.append(time)
    return Solution(states, events)


def _run(build: Build, tolerance: float, steps: int) -> tuple[Array, dict[str, int]]:
    instance = Instance(build("joystick"))
    instance.initialize(tolerance, stop=_END)
    values = np.array(instance.run(_END, steps, (0, 1)))
    statistics = instance.statistics()
    instance.free()
    return values, statistics


def test_error_is_below_the_tolerance_and_falls_with_it(build: Build, truth: Solution) -> None:
    errors = [
        float(np.max(np.abs(_run(build, tolerance, _POINTS)[0] - truth.states)[:, 0]))
        for tolerance in (1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    ]
    for tolerance, error in zip((1e-6, 1e-7, 1e-8, 1e-9, 1e-10), errors, strict=True):
        assert error < tolerance
    for looser, tighter in pairwise(errors):
        assert tighter < 0.5 * looser


def test_work_and_events(build: Build, truth: Solution) -> None:
    """Everything costs by the evaluation: their number must not creep up."""
    _, statistics = _run(build, 1e-8, _POINTS)
    assert statistics["events"] == len(truth.events)
    assert statistics["evaluations"] < 6000


@pytest.mark.parametrize("step", [1e-4, 1e-3, 1e-2, 1e-1])
def test_communication_step_does_not_matter(build: Build, step: float) -> None:
    steps = round(_END / step)
    values, statistics = _run(build, 1e-8, steps)
    coarse, coarse_statistics = _run(build, 1e-8, 15)
    assert statistics == coarse_statistics, "the integrator takes the very same steps"
    # What is left is the rounding of the communication points: an ulp of the time at up to 60 rad/s2.
    assert np.max(np.abs(values[:: steps // 15] - coarse)) < 1e-13
