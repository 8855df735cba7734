"""Parameters measured beforehand: each counts as an additional measurement."""

from __future__ import annotations

import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import (
    CONSTANT_DAMPING,
    PIVOT_FRICTION,
    PLUNGER_FRICTION,
    Free,
    Uncertainty,
    fit,
    fitted_joystick,
    scaled_forces,
    summary,
    with_force_scale,
    with_friction,
    with_known,
)
from pyjoystick.identification.fitting.checks.noise_shape import estimated_sigmas
from pyjoystick.identification.fitting.checks.trust import away_from_known, check_known
from pyjoystick.identification.fitting.problem.joystick_settings import SPRING_FORCES
from pyjoystick.identification.fitting.problem.variables import Variable
from pyjoystick.identification.fitting.solution.bootstrap import bootstrap
from pyjoystick.identification.fitting.solution.search import search
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError
from tests.pyjoystick.identification.fitting.made import linear_problem, releases

NOISE = math.radians(0.1)


def test_a_linear_problem_against_its_closed_form() -> None:
    """The solution is (A^T A/s^2 + P)^-1 (A^T d/s^2 + P m), P the information beforehand."""
    random = np.random.default_rng(0)
    matrix, sigma = random.standard_normal((200, 2)), 0.5
    data = matrix @ [0.4, 0.9] + sigma * random.standard_normal(200)
    free = (Free("J", start=0.3, uncertainty=0.05), Free("m", start=0.1))
    problem = linear_problem([matrix], [data], free, sigma)
    prior = np.diag([0.05**-2, 0.0])
    information = matrix.T @ matrix / sigma**2 + prior
    expected = np.linalg.solve(information, matrix.T @ data / sigma**2 + prior @ [0.3, 0.0])
    found = search(problem, problem.variables.start, evaluations=50, central=True)
    assert found.x == pytest.approx(expected, rel=1e-7)
    jacobian = problem.jacobian(found.x)
    assert jacobian.T @ jacobian == pytest.approx(information, rel=1e-7)


def test_the_bootstrap_draws_what_was_measured_anew() -> None:
    """Where the data say little, what was measured beforehand decides, and its error is that of the fit."""
    random = np.random.default_rng(1)
    matrix, sigma = random.standard_normal((60, 2)) * [0.01, 1.0], 0.5
    data = matrix @ [0.4, 0.9] + sigma * random.standard_normal(60)
    free = (Free("J", start=0.4, uncertainty=0.05), Free("m", start=0.9))
    problem = linear_problem([matrix], [data], free, sigma)
    found = search(problem, problem.variables.start, evaluations=50, central=True)
    error = math.sqrt(np.linalg.inv(problem.jacobian(found.x).T @ problem.jacobian(found.x))[0, 0])
    drawn = bootstrap(problem, found.x, 200, "residuals", 1).fits[:, 0]
    assert np.std(drawn) == pytest.approx(error, rel=0.2)


def test_what_contradicts_the_records_is_told() -> None:
    """The weighted mean of records 1.0 +- 0.1 and of what was measured, 1.1 +- 0.01."""
    weights = np.array([100.0, 10_000.0])
    x, error = float(weights @ [1.0, 1.1] / weights.sum()), float(weights.sum() ** -0.5)
    one = Variable("F", None, "F", "N", 1.1, 0.0, 2.0, 0.01)
    away = away_from_known(one, x, error)
    assert away == pytest.approx(-0.1 / math.hypot(0.1, 0.01))
    assert check_known([one], np.array([x]), np.array([error])).passed
    far = dataclasses.replace(one, start=1.4)
    x = float(weights @ [1.0, 1.4] / weights.sum())
    check = check_known([far], np.array([x]), np.array([error]))
    assert not check.passed
    assert "F by -4.0" in check.message
    assert away_from_known(one, 1.1, 0.01) is None  # the records say nothing


def test_the_hysteresis_tells_both_frictions_apart(fmus_by_name: Path) -> None:
    """Releases hardly tell friction at the pivot from that at the plungers; the testing machine does."""
    joystick = NOMINAL.replace({"friction.T_c": 0.005, "friction.F_c": 0.3})
    settings = with_friction(CONSTANT_DAMPING, PIVOT_FRICTION, PLUNGER_FRICTION)
    settings = dataclasses.replace(settings, uncertainty=Uncertainty(profiles=()))
    records = releases(joystick, 2, noise=NOISE)
    alone = fit(records, settings)
    measured = with_known(settings, {"friction.F_c": 0.305}, {"friction.F_c": 0.01})
    found = fit(records, measured)
    assert alone.error("friction.T_c") > 3.0 * found.error("friction.T_c")
    for name, truth in (("friction.T_c", 0.005), ("friction.F_c", 0.3), ("damping.C", 0.045)):
        assert found.value(name) == pytest.approx(truth, abs=4.0 * found.error(name))
    assert found.error("friction.F_c") < 0.01
    told = re.search(
        r"Counted as measured beforehand: friction\.F_c 0\.305 \+- 0\.01 "
        r"\(the records lie (\S+) standard errors away\)\.",
        summary(found),
    )
    assert told is not None
    difference = alone.value("friction.F_c") - 0.305
    # Fits of releases alone are not quite linear in the two frictions.
    assert float(told[1]) == pytest.approx(
        difference / math.hypot(alone.error("friction.F_c"), 0.01), abs=0.2
    )


def test_a_measured_value_and_the_records_count_by_their_errors(fmus_by_name: Path) -> None:
    """Their weighted mean, whatever the noise was taken to be when the search began."""
    records = releases(NOMINAL, 2, noise=NOISE)
    settings = dataclasses.replace(
        CONSTANT_DAMPING, free=(*CONSTANT_DAMPING.free, Free("J")), uncertainty=Uncertainty(profiles=())
    )
    alone = fit(records, settings)
    error = alone.error("J")
    measured = alone.value("J") + 2.0 * error
    found = fit(records, with_known(settings, {"J": measured}, {"J": error}))
    assert found.value("J") == pytest.approx(alone.value("J") + error, abs=0.02 * error)
    assert found.error("J") == pytest.approx(error / math.sqrt(2.0), rel=0.02)


def test_what_is_known_precisely_hides_nothing(fmus_by_name: Path) -> None:
    """To know J precisely is to fix it: what else would explain the residuals is the same."""
    records = releases(NOMINAL.replace({"friction.T_c": 0.002}), 2, noise=NOISE)
    fixed = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))
    known = with_known(fixed, {"J": NOMINAL.J}, {"J": 1e-9})
    found = [fit(records, settings) for settings in (fixed, known)]
    checks = [{one.name: (one.passed, one.message) for one in each.checks} for each in found]
    for name in ("missing physics", "whiteness"):
        assert checks[0][name] == checks[1][name]
    assert not checks[0]["missing physics"][0]
    assert f"J {NOMINAL.J:.6g} +- 1e-09 (the records contain no information about it)" in summary(found[1])


def test_the_scale_of_the_load_cell_is_found(fmus_by_name: Path) -> None:
    """Springs 0.4 % stronger than measured, by a load cell known to 0.5 %."""
    values = NOMINAL.to_names()
    records = releases(scaled_forces(NOMINAL, 1.004), 4, noise=NOISE)
    settings = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))
    assert not fit(records, settings).trusted
    found = fit(records, with_force_scale(settings, NOMINAL, 0.005))
    assert found.trusted, [check for check in found.checks if not check.passed]
    for name, truth in (("damping.C", 0.045), ("force_scale", 1.004)):
        assert abs(found.value(name) - truth) < 4.0 * found.error(name) < 0.01 * truth
    saved = fitted_joystick(found, NOMINAL).joystick.to_names()
    for name in SPRING_FORCES:
        assert saved[name] == pytest.approx(found.value("force_scale") * values[name], rel=1e-3)


def test_the_scale_of_the_load_cell_needs_springs_that_nothing_else_moves() -> None:
    taken = with_known(
        CONSTANT_DAMPING, {"forward.returnSpring.k_s": 2625.0}, {"forward.returnSpring.k_s": 1.6}
    )
    with pytest.raises(ParameterError, match=r"forward\.returnSpring\.k_s = fitted or tied: must be left to"):
        with_force_scale(taken, NOMINAL, 0.005)
    with pytest.raises(ParameterError, match=r"force_scale\.uncertainty"):
        with_force_scale(CONSTANT_DAMPING, NOMINAL, 0.0)


def test_the_noise_is_that_of_the_samples_alone() -> None:
    """What is known gives no freedom: three variables, of which one is known, take two from 50 samples."""
    random = np.random.default_rng(2)
    matrix = random.standard_normal((50, 3))
    free = (Free("J", start=0.4, uncertainty=1e-6), Free("m", start=0.9), Free("h", start=0.1))
    problem = linear_problem([matrix], [random.standard_normal(50)], free)
    x = problem.variables.start
    ((sigma,),) = (one.values() for one in estimated_sigmas(problem, x, per_record=False, combined=False))
    residuals = matrix @ x - problem.data[0]
    assert sigma == pytest.approx(math.sqrt(float(residuals @ residuals) / 48.0))


def test_what_was_fixed_becomes_free() -> None:
    fixed = dataclasses.replace(CONSTANT_DAMPING, fixed={"J": 0.011})
    found = with_known(fixed, {"J": 0.01135, "damping.C": 0.05}, {"J": 1e-5, "damping.C": 0.01})
    assert found.fixed == {}
    known = {one.name: (one.start, one.uncertainty) for one in found.free if one.uncertainty}
    assert known == {"J": (0.01135, 1e-5), "damping.C": (0.05, 0.01)}
    assert next(one for one in found.free if one.name == "damping.C").maximum == 0.5


@pytest.mark.parametrize("free", [{"uncertainty": 1.0}, {"start": 1.0, "uncertainty": 0.0}])
def test_what_cannot_be_known(free: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=r"J\.uncertainty"):
        Free("J", **free)
