from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.forced_motion.periodic.maps import CentralDifferences
from pyjoystick.forced_motion.periodic.solutions import NoSolutionError, solve
from pyjoystick.support import FloatArray

ONES = np.ones(2)


def linear(states: FloatArray, parameter: float) -> FloatArray:
    return states @ np.array([[0.5, 1.0], [-0.3, 0.2]]).T + parameter


def test_a_linear_map_in_one_step() -> None:
    matrix = np.array([[0.5, 1.0], [-0.3, 0.2]])
    found = solve(CentralDifferences(linear, ONES, 1.0, step=1e-3), np.array([7.0, -3.0]), 2.0, ONES)
    assert found.state == pytest.approx(np.linalg.solve(np.eye(2) - matrix, [2.0, 2.0]), abs=1e-12)
    assert np.sort_complex(found.multipliers) == pytest.approx(np.sort_complex(np.linalg.eigvals(matrix)))
    assert found.exponents(0.5).real == pytest.approx(np.log(np.linalg.det(matrix)) / (2.0 * 0.5))
    assert found.is_stable


def test_differences_are_right_to_the_fourth_order_and_know_their_error() -> None:
    def images(states: FloatArray, parameter: float) -> FloatArray:
        return parameter * np.exp(states)

    for step in (0.04, 0.02):
        here = CentralDifferences(images, np.ones(1), 1.0, step=step)(np.array([0.3]), 2.0)
        exact = 2.0 * math.exp(0.3)
        # With h and h/2: h^4/480 of the fifth derivative is left, and h^2/24 of the third is the estimate.
        assert here.monodromy[0, 0] - exact == pytest.approx(-exact * step**4 / 480.0, rel=0.01)
        assert here.error == pytest.approx(exact * step**2 / 24.0, rel=0.01)
        assert here.by_parameter() == pytest.approx(math.exp(0.3), rel=1e-9)


@pytest.mark.parametrize(
    "images",
    [
        lambda states, _: states + 1.0 + states**2,  # no fixed point
        lambda states, _: states + 1.0,  # nor here, and singular
        lambda states, _: np.full_like(states, np.nan),
    ],
)
def test_a_search_without_an_end_is_refused(images: object) -> None:
    smooth_map = CentralDifferences(images, ONES, 1.0, step=1e-4)  # type: ignore[arg-type]
    with pytest.raises(NoSolutionError, match=r"no periodic solution found at 3"):
        solve(smooth_map, np.full(2, 0.3), 3.0, ONES)
