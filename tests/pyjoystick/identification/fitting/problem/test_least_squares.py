"""Residuals and derivatives of the least-squares problem."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    RELEASE,
    FitError,
    FitSettings,
    Free,
    Measurement,
    Noise,
)
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError, UnknownParameterError, UnknownVariableError
from tests.pyjoystick.identification.fitting.made import releases


def _problem(fmu: Fmu, settings: FitSettings, records: int = 2) -> Problem:
    return make_problem(releases(NOMINAL, records), settings, fmu)


def test_derivatives_are_those_of_the_residuals(fmus_by_name: Path) -> None:
    """Against differences over wider steps, the release time included, whose derivative is the velocity."""
    with Fmu("Joystick") as fmu:
        problem = _problem(fmu, dataclasses.replace(CONSTANT_DAMPING, tolerance=1e-11))
        x = problem.variables.start
        problem = dataclasses.replace(problem, steps=choose_steps(problem.model, x).steps)
        jacobian = problem.jacobian(x)
        for j, one in enumerate(problem.variables.free):
            step = 1e-4 * one.scale * np.eye(len(x))[j]
            slope = (problem.residuals(x + step) - problem.residuals(x - step)) / (2.0 * step[j])
            size = np.max(np.abs(slope))
            # A sample that the release passes within the step has no derivative.
            close = np.isclose(jacobian[:, j], slope, atol=1e-3 * size)
            assert np.count_nonzero(~close) <= 1, one.label


def test_a_variable_of_one_record_moves_no_other(fmus_by_name: Path) -> None:
    with Fmu("Joystick") as fmu:
        problem = _problem(fmu, CONSTANT_DAMPING)
        jacobian = problem.jacobian(problem.variables.start)
    first = len(problem.data[0])
    for j, one in enumerate(problem.variables.free):
        moved = [bool(np.any(block != 0.0)) for block in (jacobian[:first, j], jacobian[first:, j])]
        assert moved == ([True, True] if one.record is None else [one.record == 0, one.record == 1])


def test_steps_are_measured(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At the default tolerance the derivatives are good to 1e-6 of their size or better."""
    monkeypatch.setattr(Fmu, "sensitive", None)
    with Fmu("Joystick") as fmu:
        problem = _problem(fmu, CONSTANT_DAMPING, 1)
        chosen = choose_steps(problem.model, problem.variables.start)
    assert np.all(chosen.errors < 1e-6)
    assert 0.0 < chosen.noise < 1e-9


def test_derivatives_at_a_bound_are_one_sided(fmus_by_name: Path) -> None:
    settings = dataclasses.replace(
        CONSTANT_DAMPING, free=(Free("damping.C", start=0.05, minimum=0.05, maximum=0.1), *RELEASE)
    )
    with Fmu("Joystick") as fmu:
        bounded = _problem(fmu, settings)
        free = _problem(fmu, CONSTANT_DAMPING)
        bounded = dataclasses.replace(bounded, steps=np.full(len(bounded.steps), 1e-5))
        x = bounded.variables.start
        one, other = bounded.jacobian(x), free.jacobian(x)
    # Its error is of the first order in the step.
    assert one[:, 0] == pytest.approx(other[:, 0], abs=1e-3 * np.max(np.abs(other[:, 0])))


def test_a_run_that_fails_turns_the_search_back(fmus_by_name: Path) -> None:
    """A tie that leads to a damping below 0, which the FMU does not allow."""
    settings = FitSettings(
        fmu="Joystick", free=(Free("c", start=0.05), *RELEASE), ties={"damping.C": "c - 0.1 * (c > 0.06)"}
    )
    with Fmu("Joystick") as fmu:
        problem = _problem(fmu, settings, 1)
        x = problem.variables.start
        good = float(np.sum(problem.residuals(x) ** 2))
        x[0] = 0.07
        assert float(np.sum(problem.residuals(x) ** 2)) > 1e4 * good
        assert np.all(np.isfinite(problem.jacobian(x)))
        with pytest.raises(FitError, match=r"run 0: the run fails: a parameter is outside the range"):
            problem.predictions(x)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"outputs": ("phi",)}, UnknownVariableError, "phi"),
        ({"free": (Free("damping.D"),)}, UnknownParameterError, "did you mean damping.C"),
        ({"free": (Free("E"),)}, ParameterError, "a real parameter or start value that can be set"),
        (
            {"free": (Free("c", per_record=True),), "ties": {"m": "c"}},
            ParameterError,
            "given: the FMU has no",
        ),
        ({"free": (Free("damping.C", start=-1.0),)}, ParameterError, "damping.C = -1.0"),
        ({"ties": {"q": "2*J"}}, UnknownParameterError, "'q'"),
        ({"ties": {"m": "2*damping.D"}}, UnknownParameterError, "damping.D"),
        ({"ties": {"m": "2*("}}, ParameterError, "an expression in the free parameters: damping.C"),
        ({"ties": {"m": "import os"}}, ParameterError, "an expression in the free parameters: damping.C"),
        ({"ties": {"m": "'heavy'"}}, ParameterError, "an expression in the free parameters: damping.C"),
        ({"noise": Noise(per_record=True)}, ParameterError, "left out for a single record"),
        ({"derivatives": {}}, UnknownVariableError, "derivative of theta"),
    ],
)
def test_settings_that_do_not_go_with_the_fmu(
    fmus_by_name: Path, changes: dict[str, object], error: type[Exception], words: str
) -> None:
    settings = dataclasses.replace(CONSTANT_DAMPING, **changes)  # type: ignore[arg-type]
    with Fmu("Joystick") as fmu, pytest.raises(error) as caught:
        _problem(fmu, settings, 1)
    assert words in str(caught.value)


def test_a_tie_that_divides_by_zero_is_a_run_that_fails(fmus_by_name: Path) -> None:
    settings = FitSettings(
        fmu="Joystick", free=(Free("c", start=0.06), *RELEASE), ties={"damping.C": "1.0 / (c - 0.06)"}
    )
    with Fmu("Joystick") as fmu, pytest.raises(FitError, match="outside the range that the FMU allows"):
        _problem(fmu, settings, 1)


def test_there_must_be_a_record(fmus_by_name: Path) -> None:
    with Fmu("Joystick") as fmu, pytest.raises(FitError, match="records: there is none"):
        make_problem([], CONSTANT_DAMPING, fmu)


def test_a_release_after_the_record_is_refused(fmus_by_name: Path) -> None:
    record = Measurement("short", np.linspace(0.0, 1.0, 20), {"theta": np.full(20, -0.3)})
    settings = FitSettings(fmu="Joystick", free=(Free("damping.C"),), fixed={"release_time": 2.0})
    with Fmu("Joystick") as fmu, pytest.raises(FitError, match="short: ends before the release time, 2 s"):
        make_problem([record], settings, fmu)
