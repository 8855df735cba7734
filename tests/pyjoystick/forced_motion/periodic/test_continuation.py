"""Branches of piecewise-linear oscillators against their closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from pyjoystick.forced_motion.periodic.continuation import Branch, Continuation, Steps
from pyjoystick.forced_motion.periodic.maps import CentralDifferences, SmoothMap
from pyjoystick.forced_motion.periodic.solutions import PeriodicSolution, solve
from pyjoystick.support import FloatArray
from tests.pyjoystick.forced_motion.periodic.oscillators import (
    Oscillator,
    Piece,
    orbit_of_dwell,
    preload_fold,
    symmetric_orbit,
)

#: A spring of stiffness 7 joins one of stiffness 1 at x = 1.
STIFFENING = Oscillator(Piece(1.0, 0.0, 0.05), Piece(8.0, -7.0, 0.05), 1.0)
PRELOADED = Oscillator(Piece(1.0, -1.0, 0.05), Piece(1.0, 1.0, 0.05), 0.0, 0.5 * math.pi)
STEP = 1e-4


def over_amplitude(system: Oscillator, omega: float, periods: int = 1) -> SmoothMap:
    def images(states: FloatArray, amplitude: float) -> FloatArray:
        for _ in range(periods):
            states = np.array([system.image(state, amplitude, omega) for state in states])
        return states

    return CentralDifferences(images, np.ones(2), 1.0, step=STEP)


def over_frequency(system: Oscillator, amplitude: float) -> SmoothMap:
    def images(states: FloatArray, omega: float) -> FloatArray:
        return np.array([system.image(state, amplitude, omega) for state in states])

    return CentralDifferences(images, np.ones(2), 1.0, step=STEP)


def branch_of(
    smooth_map: SmoothMap, start: PeriodicSolution, limits: tuple[float, float], way: float, most: float = 0.1
) -> Branch:
    continuation = Continuation(smooth_map, np.ones(3), limits, steps=Steps(most=most))
    return continuation.branch(start, np.array([0.0, 0.0, way]))


def assert_multipliers(found: PeriodicSolution, expected: np.ndarray) -> None:
    # By their sum and product: where the two meet, rounding of the matrix goes into them as its root.
    assert np.sum(found.multipliers) == pytest.approx(np.sum(expected), abs=1e-8)
    assert np.prod(found.multipliers) == pytest.approx(np.prod(expected), abs=1e-8)


def test_branch_of_shaw_and_holmes_with_both_folds() -> None:
    omega = 1.3
    period = 2.0 * math.pi / omega
    smooth_map = over_amplitude(STIFFENING, omega)
    first = orbit_of_dwell(STIFFENING, omega, 0.03 * period)
    start = solve(smooth_map, first.state + 1e-3, first.amplitude, np.ones(2))
    branch = branch_of(smooth_map, start, (0.2, 1.0), 1.0, most=0.2)
    assert branch.end == "edge of the range"
    folds = [point.solution.parameter for point in branch.special if point.kind == "fold"]
    assert folds == pytest.approx([_fold(omega, 0.05, 0.08), _fold(omega, 0.19, 0.216)], abs=1e-6)

    # The dwell rises along the branch: between the folds the amplitude of the force determines it.
    bounds = [_dwell_of_fold(omega, 0.05, 0.08), _dwell_of_fold(omega, 0.19, 0.216), 0.23 * period]
    lower, piece = 0.02 * period, 0
    for solution, after in zip(branch.solutions[1:-1], branch.solutions[2:], strict=True):
        turned = (after.parameter - solution.parameter) * (-1.0) ** piece < 0.0
        dwell = _dwell(omega, solution.parameter, lower, bounds[piece])
        expected = orbit_of_dwell(STIFFENING, omega, dwell)
        near_fold = abs(solution.parameter - folds[min(piece, 1)]) < 1e-3
        if not near_fold:
            assert solution.state == pytest.approx(expected.state, abs=1e-8)
            assert_multipliers(solution, expected.multipliers)
            assert solution.is_stable == bool(np.abs(expected.multipliers[0]) < 1.0)
        if turned and piece < 2:
            lower, piece = bounds[piece], piece + 1
    assert piece == 2
    assert sum(not one.is_stable for one in branch.solutions) > 10


def _amplitude(omega: float, dwell: float) -> float:
    return orbit_of_dwell(STIFFENING, omega, dwell).amplitude


def _slope(omega: float, dwell: float) -> float:
    return _amplitude(omega, dwell + 1e-5) - _amplitude(omega, dwell - 1e-5)


def _dwell_of_fold(omega: float, low: float, high: float) -> float:
    """Where the closed form's amplitude has an extremum; the parts of a period in which to look."""
    period = 2.0 * math.pi / omega
    return float(brentq(lambda dwell: _slope(omega, dwell), low * period, high * period, xtol=1e-14))


def _fold(omega: float, low: float, high: float) -> float:
    return _amplitude(omega, _dwell_of_fold(omega, low, high))


def _dwell(omega: float, amplitude: float, low: float, high: float) -> float:
    return float(brentq(lambda dwell: _amplitude(omega, dwell) - amplitude, low, high, xtol=1e-15))


def test_period_doubling_and_the_branch_that_leaves_there() -> None:
    system = Oscillator(Piece(1.0, 0.0, 0.02), Piece(8.0, -7.0, 0.02), 1.0)
    omega = 2.2
    period = 2.0 * math.pi / omega
    smooth_map = over_amplitude(system, omega)
    first = orbit_of_dwell(system, omega, 0.255 * period)
    start = solve(smooth_map, first.state, first.amplitude, np.ones(2))
    branch = branch_of(smooth_map, start, (8.0, 13.0), -1.0)
    (doubling,) = [point.solution for point in branch.special if point.kind == "period doubling"]

    def beyond(dwell: float) -> float:
        return float(np.prod(orbit_of_dwell(system, omega, dwell).multipliers + 1.0).real)

    dwell = float(brentq(beyond, 0.235 * period, 0.255 * period, xtol=1e-14))
    assert doubling.parameter == pytest.approx(orbit_of_dwell(system, omega, dwell).amplitude, abs=1e-6)

    twice = over_amplitude(system, omega, periods=2)
    values, vectors = np.linalg.eig(doubling.map.monodromy)
    direction = np.append(vectors[:, np.argmin(np.abs(values + 1.0))].real, 0.0)
    continuation = Continuation(twice, np.ones(3), (8.0, 13.0), steps=Steps(points=15))
    beginning = continuation.beside(doubling, direction)
    doubled = continuation.branch(beginning, direction)
    last = doubled.solutions[-1]
    once = system.image(last.state, last.parameter, omega)
    assert np.max(np.abs(once - last.state)) > 0.05
    assert system.image(once, last.parameter, omega) == pytest.approx(last.state, abs=1e-8)


@pytest.mark.parametrize("omega", [1.5, 2.0])
def test_both_branches_of_duan_and_singh_and_the_fold_where_they_meet(omega: float) -> None:
    smooth_map = over_amplitude(PRELOADED, omega)
    fold = preload_fold(PRELOADED, omega)
    first = symmetric_orbit(PRELOADED, 1.5 * fold, omega, 1)
    start = solve(smooth_map, first.state, first.amplitude, np.ones(2))
    branch = branch_of(smooth_map, start, (0.5 * fold, 1.6 * fold), -1.0, most=0.05)
    assert [point.kind for point in branch.special] == ["fold"]
    assert branch.special[0].solution.parameter == pytest.approx(fold, abs=1e-6)
    assert branch.end == "edge of the range"
    sides = {True: 0, False: 0}
    for solution in branch.solutions:
        if solution.parameter < 1.001 * fold:
            continue
        expected = symmetric_orbit(PRELOADED, solution.parameter, omega, 1 if solution.is_stable else -1)
        assert solution.state == pytest.approx(expected.state, abs=1e-8)
        assert_multipliers(solution, expected.multipliers)
        sides[solution.is_stable] += 1
    assert min(sides.values()) > 3


def test_fold_over_the_frequency() -> None:
    amplitude = 0.25
    smooth_map = over_frequency(PRELOADED, amplitude)
    first = symmetric_orbit(PRELOADED, amplitude, 1.5, 1)
    start = solve(smooth_map, first.state, 1.5, np.ones(2))
    branch = branch_of(smooth_map, start, (1.0, 1.6), -1.0)
    (fold,) = [point.solution.parameter for point in branch.special if point.kind == "fold"]
    expected = brentq(lambda omega: preload_fold(PRELOADED, omega) - amplitude, 1.2, 1.5, xtol=1e-14)
    assert fold == pytest.approx(expected, abs=1e-6)


def test_a_branch_that_closes_ends_where_it_began() -> None:
    """X = c + sin, p = s of a circle: F(x, p) = x + x^2 + p^2 - 1 has the unit circle as its fixed points."""

    def circle(states: FloatArray, parameter: float) -> FloatArray:
        return states + states**2 + parameter**2 - 1.0

    smooth_map = CentralDifferences(circle, np.ones(1), 1.0, step=STEP)
    start = solve(smooth_map, np.array([0.9]), 0.0, np.ones(1))
    branch = Continuation(smooth_map, np.ones(2), (-2.0, 2.0)).branch(start, np.array([0.0, 1.0]))
    assert branch.end == "back at its start"
    folds = [point.solution.parameter for point in branch.special if point.kind == "fold"]
    assert folds == pytest.approx([1.0, -1.0], abs=1e-9)


def test_neimark_sacker_and_branch_point() -> None:
    """A rotation that grows with p loses its stability at p = 1; x^3 - p x has a branch point at p = 0."""
    turn = np.array([[math.cos(1.0), -math.sin(1.0)], [math.sin(1.0), math.cos(1.0)]])

    def rotation(states: FloatArray, parameter: float) -> FloatArray:
        return parameter * states @ turn.T - states * np.sum(states**2, axis=1, keepdims=True)

    smooth_map = CentralDifferences(rotation, np.ones(2), 1.0, step=STEP)
    start = solve(smooth_map, np.full(2, 0.01), 0.5, np.ones(2))
    branch = branch_of(smooth_map, start, (0.4, 1.3), 1.0)
    assert [point.kind for point in branch.special] == ["Neimark-Sacker"]
    assert branch.special[0].solution.parameter == pytest.approx(1.0, abs=1e-6)

    def pitchfork(states: FloatArray, parameter: float) -> FloatArray:
        return states + parameter * states - states**3

    one = CentralDifferences(pitchfork, np.ones(1), 1.0, step=STEP)
    start = solve(one, np.array([0.01]), -0.5, np.ones(1))
    branch = Continuation(one, np.ones(2), (-0.7, 0.63)).branch(start, np.array([0.0, 1.0]))
    assert [point.kind for point in branch.special] == ["branch point"]
    assert branch.special[0].solution.parameter == pytest.approx(0.0, abs=1e-6)


def test_a_test_of_the_system_is_located() -> None:
    smooth_map = over_amplitude(PRELOADED, 1.5)
    first, wanted = (symmetric_orbit(PRELOADED, amplitude, 1.5, 1) for amplitude in (0.3, 0.4))
    start = solve(smooth_map, first.state, 0.3, np.ones(2))
    continuation = Continuation(
        smooth_map,
        np.ones(3),
        (0.2, 0.6),
        tests=lambda solution: {"as at 0.4": float(solution.state[0] - wanted.state[0])},
    )
    branch = continuation.branch(start, np.array([0.0, 0.0, 1.0]))
    (point,) = branch.special
    assert point.kind == "as at 0.4"
    assert point.solution.parameter == pytest.approx(0.4, abs=1e-8)
