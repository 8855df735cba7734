"""The exact zero of the gradient near a minimum that is known to fewer digits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import root

from pyjoystick.identification import Free
from pyjoystick.identification.fitting.problem.forward_model import ForwardModel
from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.predictor import Prediction
from pyjoystick.identification.fitting.solution.search import Minimum
from pyjoystick.identification.fitting.solution.stationary import stationary_point
from pyjoystick.support import FloatArray
from tests.pyjoystick.identification.fitting.made import LinearPredictor, linear_problem

NAMES = ("omega_start", "theta_start")
#: Far from what any row gives, so that the Hessian differs from that of Gauss and Newton by half.
DATA = np.array([1.0, 0.3, -0.2, 0.5])


class CurvedPredictor(LinearPredictor):
    """(u + v, u - v^2, 0.1 v + 0.5 v^2, u v) of the row (u, v)."""

    differentiable = NAMES

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        u, v = rows.T
        return Prediction(np.column_stack((u + v, u - v**2, 0.1 * v + 0.5 * v**2, u * v)), {}, "")

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> dict[str, FloatArray]:
        u, v = row
        by_v = np.array([1.0, -2.0 * v, 0.1 + v, u])
        return dict(zip(NAMES, (np.array([1.0, 1.0, 0.0, v]), by_v), strict=True))


def _problem(least: float = -1.4) -> Problem:
    free = [
        Free(name, start=1.0, minimum=low, maximum=1.4)
        for name, low in zip(NAMES, (-1.4, least), strict=True)
    ]
    linear = linear_problem([np.zeros((4, 2))], [DATA], free)
    curved = CurvedPredictor("run 0", np.zeros((4, 2)), DATA)
    return Problem.of(ForwardModel(linear.variables, [curved]), linear.noise)


def _gradient(x: FloatArray) -> FloatArray:
    """By hand."""
    u, v = x
    r = np.array([u + v, u - v**2, 0.1 * v + 0.5 * v**2, u * v]) - DATA
    return np.array([r[0] + r[1] + v * r[3], r[0] - 2.0 * v * r[1] + (0.1 + v) * r[2] + u * r[3]])


@pytest.mark.parametrize("away", [1e-9, 1e-4, 3e-3])
def test_the_gradient_vanishes(away: float) -> None:
    """Its Jacobian by hand is not needed: SciPy's hybrid method finds where the gradient by hand is zero."""
    expected = root(_gradient, [0.5, 0.1], tol=1e-14).x
    problem = _problem()
    start = expected + away * np.array([1.0, -1.0])
    found = stationary_point(
        problem, Minimum(start, float(np.sum(problem.residuals(start) ** 2)), True, "", 1)
    )
    np.testing.assert_allclose(found.x, expected, atol=1e-8)
    assert np.max(np.abs(_gradient(found.x))) < 1e-7
    assert found.cost == pytest.approx(float(np.sum(problem.residuals(expected) ** 2)), rel=1e-12)


@pytest.mark.parametrize(("errors", "is_near"), [(0.075, True), (0.15, False)])
def test_near_is_within_a_tenth_of_a_standard_error(errors: float, is_near: bool) -> None:
    """A move d is sqrt(d^T J^T J d)/s errors long, at most sqrt(2) times the larger of its two components."""
    expected = root(_gradient, [0.5, 0.1], tol=1e-14).x
    problem = _problem()
    residuals, move = problem.residuals(expected), np.array([1.0, -1.0])
    length = np.linalg.norm(problem.jacobian(expected) @ move) / np.sqrt(np.mean(residuals**2))
    start = expected + errors / length * move
    minimum = Minimum(start, float(np.sum(problem.residuals(start) ** 2)), True, "", 1)
    found = stationary_point(problem, minimum)
    if is_near:
        np.testing.assert_allclose(found.x, expected, atol=1e-8)
    else:
        assert found is minimum


def test_a_variable_at_its_bound_stays_there() -> None:
    least = float(root(_gradient, [0.5, 0.1], tol=1e-14).x[1]) + 0.05
    expected = root(lambda u: _gradient(np.array([u[0], least]))[:1], [0.5], tol=1e-14).x[0]
    problem = _problem(least)
    start = np.array([expected + 1e-3, least])
    found = stationary_point(
        problem, Minimum(start, float(np.sum(problem.residuals(start) ** 2)), True, "", 1)
    )
    assert found.x == pytest.approx([expected, least], abs=1e-8)
    assert found.x[1] == least


def test_what_is_no_minimum_is_left() -> None:
    """Half a unit away another point may be found, or none: the minimum is what the search found."""
    problem = _problem()
    start = root(_gradient, [0.5, 0.1], tol=1e-14).x + 0.5
    minimum = Minimum(start, float(np.sum(problem.residuals(start) ** 2)), True, "", 1)
    assert stationary_point(problem, minimum) is minimum


def test_what_the_data_do_not_determine_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two columns that are the same."""
    problem = _problem()
    (predictor,) = problem.predictors
    columns = dict.fromkeys(NAMES, np.ones(4))
    monkeypatch.setattr(predictor, "derivatives", lambda row, instrument, rough: columns)
    start = np.array([0.5, 0.1])
    minimum = Minimum(start, float(np.sum(problem.residuals(start) ** 2)), True, "", 1)
    assert stationary_point(problem, minimum) is minimum
