"""Lyapunov exponents of maps whose exponents are known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.forced_motion.periodic.chaos import largest_exponent
from pyjoystick.support import FloatArray, ParameterError


def logistic(states: FloatArray, parameter: float) -> FloatArray:
    return parameter * states * (1.0 - states)


def henon(states: FloatArray, parameter: float) -> FloatArray:
    x, y = states.T
    return np.column_stack((1.0 - parameter * x**2 + y, 0.3 * x))


def spread(runs: int, n: int) -> FloatArray:
    return np.linspace(0.1, 0.23, runs * n).reshape(runs, n)


def test_the_logistic_map_doubles_distances() -> None:
    """R = 4 is conjugate to the tent map: ln 2 a step."""
    found = largest_exponent(logistic, spread(40, 1), 4.0, np.ones(1), 0.5, iterations=500)
    assert found.value == pytest.approx(math.log(2.0) / 0.5, rel=0.01)
    assert abs(found.value - math.log(2.0) / 0.5) < 4.0 * found.error
    assert found.is_chaotic
    assert found.settled == 0


def test_henon() -> None:
    """0.41922 a step (Sprott, Chaos and Time-Series Analysis, 2003)."""
    found = largest_exponent(henon, spread(40, 2), 1.4, np.ones(2), 1.0, iterations=1000)
    assert found.value == pytest.approx(0.41922, rel=0.01)


def test_tangents_take_the_place_of_neighbors() -> None:
    """The same motions with exact derivatives: the exponents differ by what neighbors 1e-7 apart bend."""

    def tangents(states: FloatArray, parameter: float) -> tuple[FloatArray, FloatArray]:
        x = states[:, 0]
        by_x = np.column_stack((-2.0 * parameter * x, np.full_like(x, 0.3)))
        by_y = np.column_stack((np.ones_like(x), np.zeros_like(x)))
        return henon(states, parameter), np.stack((by_x, by_y), axis=2)

    by_neighbors, by_tangents = (
        largest_exponent(henon, spread(40, 2), 1.4, np.ones(2), 1.0, iterations=50, tangents=one)
        for one in (None, tangents)
    )
    assert by_tangents.value == pytest.approx(by_neighbors.value, rel=1e-5)
    assert by_tangents.error == pytest.approx(by_neighbors.error, rel=1e-4)


def test_a_precision_is_reached_by_more_iterations() -> None:
    """The error of a mean falls with the root of the number."""
    rough = largest_exponent(logistic, spread(8, 1), 3.9, np.ones(1), 1.0, iterations=60)
    assert rough.error > 0.015 * rough.value
    fine = largest_exponent(logistic, spread(8, 1), 3.9, np.ones(1), 1.0, iterations=60, precision=0.015)
    assert 0.0 < fine.error <= 0.015 * fine.value
    # The mean of ln |r (1 - 2 x)| over 4e6 iterations is 0.4959.
    assert fine.value == pytest.approx(0.4959, abs=4.0 * fine.error)


def test_a_stable_orbit_is_not_chaotic() -> None:
    """For r = 3.2 an orbit of two states x+-, with the multiplier 4 + 2 r - r^2 = 0.16 over two steps."""
    found = largest_exponent(logistic, spread(4, 1), 3.2, np.ones(1), 1.0, iterations=100)
    assert found.value == pytest.approx(0.5 * math.log(0.16), rel=0.02)  # its beginning is averaged too
    assert not found.is_chaotic


def test_motions_whose_chaos_ends_are_left_out_and_counted() -> None:
    """Above 2 a stable fixed point at 3, below the logistic map."""

    def both(states: FloatArray, parameter: float) -> FloatArray:
        return np.where(states > 2.0, 3.0 + 0.5 * (states - 3.0), logistic(states, parameter))

    states = np.concatenate((spread(20, 1), [[2.5], [3.5]]))
    found = largest_exponent(both, states, 4.0, np.ones(1), 1.0, iterations=300)
    assert found.settled == 2
    assert found.value == pytest.approx(math.log(2.0), rel=0.02)


def test_motions_that_fail_or_are_one_are_refused() -> None:
    with pytest.raises(ParameterError, match="do not fail or become one"):
        largest_exponent(lambda states, _: 0.0 * states, spread(2, 1), 1.0, np.ones(1), 1.0)
    with pytest.raises(ParameterError, match="states = 1"):
        largest_exponent(logistic, spread(1, 1), 4.0, np.ones(1), 1.0)
