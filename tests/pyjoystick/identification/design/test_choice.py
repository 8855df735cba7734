"""The best choice of experiments, against all choices."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest

from pyjoystick.identification import Design, Experiment, FitError, Information, best_design
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.support import ParameterError

TIME = np.arange(3.0)


def _information(name: str, matrix: np.ndarray, values: np.ndarray) -> Information:
    experiment = Experiment(name, TIME, 0.1)
    names = tuple(f"p{i}" for i in range(len(values)))
    return Information(experiment, names, values, matrix, Measurement(name, TIME, {"theta": TIME}))


def _random(seed: int, parameters: int = 2) -> list[Information]:
    """Six experiments of one to four samples each, with parameters of very different sizes."""
    random = np.random.default_rng(seed)
    values = 10.0 ** random.uniform(-4.0, 6.0, parameters)
    found = []
    for i in range(6):
        jacobian = random.normal(size=(random.integers(1, 5), parameters)) / values
        found.append(_information(f"e{i}", jacobian.T @ jacobian, values))
    return found


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("determine", [None, "p1"])
def test_no_choice_is_better(seed: int, determine: str | None) -> None:
    """Exchange finds the best of all 126 choices of four, to 2 % of its standard errors."""
    informations = _random(seed)
    found = best_design(informations, 4, determine=determine)
    assert found.counts.sum() == 4
    losses = []
    for choice in combinations_with_replacement(range(6), 4):
        counts = np.bincount(choice, minlength=6)
        scaled = sum(n * one.matrix for n, one in zip(counts, informations, strict=True))
        scaled = scaled * np.outer(found.values, found.values)
        if np.linalg.matrix_rank(scaled, tol=1e-9) == 2:
            covariance = np.linalg.inv(scaled)
            losses.append(np.linalg.det(covariance) ** 0.5 if determine is None else covariance[1, 1])
    own = found.covariance / np.outer(found.values, found.values)
    loss = np.linalg.det(own) ** 0.5 if determine is None else own[1, 1]
    assert np.sqrt(loss) <= 1.02 * np.sqrt(min(losses))


def test_what_is_known_is_not_measured_again() -> None:
    values = np.array([1.0, 1.0])
    first, second = (_information(name, np.diag(diagonal), values) for name, diagonal in
                     (("first", [100.0, 0.0]), ("second", [0.0, 16.0])))  # fmt: skip
    assert best_design([first, second], 3).counts.min() == 1
    known = best_design([first, second], 3, determine="p1", uncertainties={"p0": 0.01})
    assert known.counts.tolist() == [0, 3]
    assert known.errors == pytest.approx([0.01, 48.0**-0.5])


def test_errors_fall_with_the_root_of_the_number() -> None:
    design = best_design(_random(1), 4)
    assert design.with_counts(4 * design.counts).errors == pytest.approx(design.errors / 2.0)


def test_experiments_that_show_nothing_are_refused() -> None:
    """As a torque of zero throughout."""
    nothing = _information("nothing", np.zeros((2, 2)), np.array([1.0, 2.0]))
    with pytest.raises(FitError, match="not even the best of them determine p0, p1"):
        best_design([nothing], 2)


def test_what_no_experiment_shows_is_refused() -> None:
    blind = _information("blind", np.diag([1.0, 0.0]), np.array([1.0, 2.0]))
    with pytest.raises(FitError, match="not even the best of them determine p1"):
        best_design([blind], 4)
    assert best_design([blind], 4, determine="p0").errors[0] == pytest.approx(0.5)
    assert isinstance(best_design([blind], 2, uncertainties={"p1": 0.1}), Design)


def test_impossible_questions() -> None:
    with pytest.raises(ParameterError, match="determine"):
        best_design(_random(0), 4, determine="p7")
    with pytest.raises(ParameterError, match="count"):
        best_design(_random(0), 0)
    with pytest.raises(ParameterError, match="experiments"):
        best_design([], 4)
    with pytest.raises(ParameterError, match="not zero"):
        Experiment.release(0.0, rate=60.0, duration=1.0)
