"""Rank, standard errors, profiles and bootstrap on problems with formulas."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import RELEASE, FitSettings, Free, Search, Uncertainty, fit
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.solution.bootstrap import bootstrap
from pyjoystick.identification.fitting.solution.profile import profile
from pyjoystick.identification.fitting.solution.search import search
from pyjoystick.identification.fitting.solution.uncertainty import (
    StandardErrors,
    identifiability,
    standard_errors,
)
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.support import FloatArray
from tests.pyjoystick.identification.fitting.made import linear_problem, releases


def test_a_sum_is_named() -> None:
    time = np.linspace(0.0, 1.0, 50)
    jacobian = np.column_stack((time, time, time**2))
    known = identifiability(jacobian, np.array([2.0, 1.0, 5.0]), ("a", "b", "c"), np.zeros(3))
    assert known.rank == 2
    assert known.undetermined.tolist() == [True, True, False]
    # a and b only act by their sum: one percent of b is half a percent of a.
    assert known.sentences == ("b +1 %, a -0.5 % together change nothing that was measured: fix one of them",)


def test_two_separate_combinations_are_named_separately() -> None:
    time = np.linspace(0.0, 1.0, 50)
    jacobian = np.column_stack((time, time, time**2, -(time**2), np.zeros(50)))
    known = identifiability(jacobian, np.ones(5), tuple("abcde"), np.zeros(5))
    assert known.rank == 2
    assert any("a" in one and "b" in one and "c " not in one for one in known.sentences)
    assert any("c +1 %" in one and "d +1 %" in one and "a " not in one for one in known.sentences)
    assert "e has no influence on what was measured" in known.sentences


def _fit(fmu: str, names: list[str], fixed: dict[str, float] | None = None) -> FitSettings:
    return FitSettings(
        fmu=fmu,
        free=(*(Free(name) for name in names), *RELEASE),
        fixed=fixed or {},
        # A search along an open valley has no end of its own.
        search=Search(evaluations=15),
        uncertainty=Uncertainty(profiles=()),
    )


def test_only_ratios_to_the_inertia_are_determined(fmus_by_name: Path) -> None:
    """M and h act by their product: one of the two can be had, not both."""
    found = fit(releases(NOMINAL), _fit("Joystick", ["m", "h", "damping.C"]))
    assert not found.trusted
    assert found.identifiability.deficient
    assert any("m +1 %, h -1 %" in one or "h +1 %, m -1 %" in one for one in found.identifiability.sentences)
    assert np.isinf(found.error("m"))
    assert found.error("damping.C") < 1e-6


def test_the_weight_of_the_power_law_is_not_determined(fmus_by_name: Path) -> None:
    names = ["alpha", "A_pos", "A_neg", "B"]
    found = fit(releases(NOMINAL_POWER_LAW), _fit("JoystickPowerLaw", [f"damping.{name}" for name in names]))
    (sentence,) = found.identifiability.sentences
    assert all(f"damping.{name}" in sentence for name in names)


def test_velocity_term_without_weight(fmus_by_name: Path) -> None:
    joystick = NOMINAL_POWER_LAW.replace({"damping.alpha": 1.0})
    settings = _fit("JoystickPowerLaw", ["damping.A_pos", "damping.B", "damping.m"], {"damping.alpha": 1.0})
    found = fit(releases(joystick), settings)
    assert set(found.identifiability.sentences) == {
        "damping.B has no influence on what was measured",
        "damping.m has no influence on what was measured",
    }
    assert found.value("damping.A_pos") == pytest.approx(0.086, rel=1e-6)


SIGMA = 0.1
FREE = (Free("J", start=1.0), Free("m", start=1.0))
TRUTH = np.array([2.0, 3.0])


def _line(count: int, seed: int) -> tuple[FloatArray, FloatArray]:
    """A straight line in noise: the matrix, and data."""
    x = np.linspace(0.0, 1.0, count)
    matrix = np.column_stack((np.ones(count), x))
    return matrix, matrix @ TRUTH + SIGMA * np.random.default_rng(seed).standard_normal(count)


def _problem(records: int, free: tuple[Free, ...] = FREE) -> Problem:
    matrices, data = zip(*(_line(40, seed) for seed in range(records)), strict=True)
    return linear_problem(matrices, data, free, SIGMA)


def _errors(problem: Problem, x: FloatArray) -> StandardErrors:
    jacobian = problem.jacobian(x)
    known = identifiability(jacobian, np.abs(x), problem.variables.labels, np.zeros(2))
    return standard_errors(jacobian, known, problem.size, 0.95, sigma_known=True)


def test_a_straight_line_has_the_errors_of_the_textbook(fmus_by_name: Path) -> None:
    problem = _problem(1)
    found = search(problem, problem.variables.start, evaluations=50)
    matrix, data = _line(40, 0)
    inverse = np.linalg.inv(matrix.T @ matrix)
    assert found.x == pytest.approx(inverse @ matrix.T @ data, rel=1e-7)
    errors = _errors(problem, found.x)
    assert errors.covariance == pytest.approx(SIGMA**2 * inverse, rel=1e-6)
    assert errors.quantile == pytest.approx(1.959964, rel=1e-6)
    assert errors.intervals(found.x)[:, 1] - found.x == pytest.approx(1.959964 * errors.errors)
    # The value at x = 0.5, the mean of all x, has the error of the mean.
    assert errors.of(np.array([1.0, 0.5])) == pytest.approx(SIGMA / math.sqrt(40), rel=1e-6)


def test_an_estimated_noise_has_wider_intervals() -> None:
    jacobian = np.column_stack((np.ones(6), np.arange(6.0)))
    known = identifiability(jacobian, np.ones(2), ("a", "b"), np.zeros(2))
    errors = standard_errors(jacobian, known, 6, 0.95, sigma_known=False)
    assert (errors.degrees_of_freedom, errors.quantile) == (4, pytest.approx(2.776445, rel=1e-6))


def test_of_a_linear_model_the_profile_is_the_linear_interval(fmus_by_name: Path) -> None:
    problem = _problem(1)
    found = search(problem, problem.variables.start, evaluations=50)
    errors = _errors(problem, found.x)
    for j in range(2):
        one = profile(problem, found.x, found.cost, j, errors)
        assert one.converged
        assert one.lower < 1e-6
        assert one.interval == pytest.approx(errors.intervals(found.x)[j], rel=1e-5)
        assert one.distances == pytest.approx((one.values - found.x[j]) / errors.errors[j], abs=1e-4)


def test_a_profile_ends_at_a_bound(fmus_by_name: Path) -> None:
    problem = _problem(1, (Free("J", start=2.0, minimum=1.99), FREE[1]))
    found = search(problem, np.array([2.5, 3.0]), evaluations=50)
    errors = _errors(problem, found.x)
    assert errors.intervals(found.x)[0, 0] < 1.99
    one = profile(problem, found.x, found.cost, 0, errors)
    assert one.bounded == (True, False)
    assert one.interval[0] == -math.inf
    assert one.values[0] == 1.99


def test_a_profile_below_the_minimum_says_so(fmus_by_name: Path) -> None:
    problem = _problem(1)
    found = search(problem, problem.variables.start, evaluations=50)
    errors = _errors(problem, found.x)
    beside = found.x + np.array([0.5, 0.0]) * errors.errors
    cost = float(np.sum(problem.residuals(beside) ** 2))
    assert profile(problem, beside, cost, 0, errors).lower > 0.1


def test_the_bootstrap_of_residuals_has_the_errors_of_the_noise(fmus_by_name: Path) -> None:
    problem = _problem(2)
    found = search(problem, problem.variables.start, evaluations=50)
    drawn = bootstrap(problem, found.x, 400, "residuals", seed=4)
    assert (len(drawn.fits), drawn.failed) == (400, 0)
    # 400 draws scatter by 3.5 %, the residuals' own deviation by 8 %.
    assert drawn.errors() == pytest.approx(_errors(problem, found.x).errors, rel=0.2)
    low, high = drawn.intervals(0.95).T
    assert np.all((low < found.x) & (found.x < high))


def test_the_bootstrap_of_records_repeats_whole_records(fmus_by_name: Path) -> None:
    """Of two records three samples can be drawn: the first twice, the second twice, or both.

    Both count by their own noise, which is four times as large in the second.
    """
    problem = _problem(2).with_weights((np.full(40, 1.0 / SIGMA), np.full(40, 0.25 / SIGMA)))
    found = search(problem, problem.variables.start, evaluations=50)
    drawn = bootstrap(problem, found.x, 20, "records", seed=4)
    singles = [search(_alone(k), found.x, evaluations=50).x for k in range(2)]
    expected = [singles[0], singles[1], found.x]
    places = {int(np.argmin([np.max(np.abs(one - other)) for other in expected])) for one in drawn.fits}
    distances = [min(float(np.max(np.abs(one - other))) for other in expected) for one in drawn.fits]
    assert max(distances) < 1e-6
    assert places == {0, 1, 2}


def test_the_release_of_a_record_that_was_not_drawn_is_left_out(fmus_by_name: Path) -> None:
    free = (Free("J", start=1.0), Free("m", start=1.0, per_record=True))
    problem = _problem(2, free)
    found = search(problem, problem.variables.start, evaluations=50)
    drawn = bootstrap(problem, found.x, 20, "records", seed=4)
    assert drawn.failed == 0
    missing = np.isnan(drawn.fits)
    assert not missing[:, 0].any()
    assert 0 < missing[:, 1].sum() < 20
    assert not np.any(missing[:, 1] & missing[:, 2])
    assert np.all(np.isfinite(drawn.intervals(0.95)))
    once = bootstrap(problem, found.x, 1, "records", seed=4)
    assert np.all(np.isnan(once.intervals(0.95)))
    assert np.all(np.isnan(once.errors()))


def _alone(record: int) -> Problem:
    matrix, data = _line(40, record)
    return linear_problem([matrix], [data], FREE, SIGMA)
