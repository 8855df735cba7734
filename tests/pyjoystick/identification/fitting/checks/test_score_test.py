"""The score test on linear problems gives the same numbers as fitting the suspect as a variable."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from pyjoystick.identification import Free
from pyjoystick.identification.fitting.checks.score_test import Finding, explanation, score_test
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.support import FloatArray
from tests.pyjoystick.identification.fitting.made import linear_problem

COUNT = 40
TIME = np.linspace(0.0, 1.0, COUNT)
LINE = np.column_stack((np.ones(COUNT), TIME))
WAVE = np.sin(9.0 * TIME)[:, np.newaxis]
FREE = (Free("J", start=1.0), Free("m", start=1.0))


def _problem() -> Problem:
    """Two records of a line, with a wave of another size in each, and noise."""
    random = np.random.default_rng(11)
    data = [LINE @ [2.0, 3.0] + size * WAVE[:, 0] + random.standard_normal(COUNT) for size in (0.9, 0.3)]
    return linear_problem([LINE, LINE], data, FREE)


def _left_over(columns: FloatArray, data: FloatArray) -> tuple[FloatArray, float]:
    """Coefficients and residual sum of squares by NumPy's least squares."""
    found, *_ = np.linalg.lstsq(columns, data)
    rest = data - columns @ found
    return np.asarray(found, dtype=np.float64), float(rest @ rest)


def _tested(problem: Problem, *found: Suspect) -> list[Finding]:
    x = problem.variables.start
    return score_test(problem, -problem.residuals(x), problem.jacobian(x), found)


def _says(sizes: FloatArray) -> str:
    return " ".join(f"{one:.6f}" for one in sizes)


@pytest.mark.parametrize("own", [False, True])
def test_a_suspect_explains_what_a_fit_with_it_would(fmus_by_name: Path, own: bool) -> None:
    problem = _problem()
    (found,) = _tested(problem, Suspect("a wave", (WAVE, WAVE), _says, own=own))
    joined = np.concatenate(problem.data)
    lines = np.concatenate((LINE, LINE))
    waves = np.kron(np.eye(2), WAVE) if own else np.concatenate((WAVE, WAVE))
    _, without = _left_over(lines, joined)
    coefficients, with_it = _left_over(np.column_stack((lines, waves)), joined)
    more, spare = waves.shape[1], 2 * COUNT - 2 - waves.shape[1]
    assert found.size == _says(coefficients[2:])
    assert found.explained == pytest.approx(1.0 - with_it / without)
    ratio = (without - with_it) / more / (with_it / spare)
    assert found.chance == pytest.approx(float(stats.f.sf(ratio, more, spare)))
    fall = 2 * COUNT * math.log(without / with_it) - more * math.log(2 * COUNT)
    assert found.evidence == pytest.approx(fall)


def test_chances_of_alternatives_add_up_to_one_at_most(fmus_by_name: Path) -> None:
    problem = _problem()
    one, some, many = _tested(
        problem,
        *(Suspect(f"of {count}", (WAVE, WAVE), alternatives=count) for count in (1, 3, 10**9)),
    )
    assert some.chance == pytest.approx(3.0 * one.chance)
    assert many.chance == 1.0


@pytest.mark.parametrize(("part", "judged"), [(0.008, False), (0.012, True)])
def test_what_the_variables_imitate_to_a_hundredth_is_not_judged(
    fmus_by_name: Path, part: float, judged: bool
) -> None:
    """The column is a variable's but for a part at right angles to all of them."""
    basis = np.linalg.qr(np.column_stack((LINE, WAVE)))[0]
    column = np.sqrt(1.0 - part**2) * basis[:, [1]] + part * basis[:, [2]]
    assert bool(_tested(_problem(), Suspect("like the slope", (column, column)))) is judged


def test_a_negative_size_of_what_can_only_be_positive_explains_nothing(fmus_by_name: Path) -> None:
    problem = _problem()
    upward, downward = (
        _tested(problem, Suspect("a wave", (one, one), one_sided=True))[0] for one in (WAVE, -WAVE)
    )
    assert upward.explained > 0.1
    assert (downward.explained, downward.evidence, downward.chance) == (0.0, -math.inf, 1.0)


def test_the_two_that_are_nearly_as_good_are_named_beside_the_best() -> None:
    """Nearly as good is within 6 of the criterion: a factor of 20 in likelihood."""
    findings = [
        Finding(name, "", 0.3, evidence, 1e-4)
        for name, evidence in (("a", 30.0), ("b", 25.0), ("c", 24.0), ("d", 24.5), ("e", 23.9))
    ]
    assert explanation(findings).endswith("; the records hardly tell it from b or c")
    assert explanation([findings[0], findings[4]]).endswith("30 % of their sum of squares")
