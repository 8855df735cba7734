"""Derivatives of a fit's predictions from the FMU's sensitivities, against equations derived by hand."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    POWER_LAW_DAMPING,
    RELEASE,
    FitSettings,
    Free,
    Measurement,
    driven,
    with_values,
)
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from pyjoystick.support import FloatArray
from tests.joystick_fmu.variational import Joystick
from tests.pyjoystick.identification.fitting.made import releases

POWER_LAW = with_values(POWER_LAW_DAMPING, NOMINAL_POWER_LAW.to_names(), replace_starts=True)
#: A scale acts on the derivatives, and two outputs have theirs one after the other.
SCALED = dataclasses.replace(CONSTANT_DAMPING, fixed={"angle_scale": 0.1}, outputs=("theta", "omega"))


def _problem(fmu: Fmu, settings: FitSettings, joystick: JoystickParameters) -> Problem:
    records = releases(joystick, 2)
    measured = [
        Measurement(one.name, one.time, {"theta": one.theta, "omega": 10.0 * one.theta}) for one in records
    ]
    return make_problem(measured, dataclasses.replace(settings, tolerance=1e-10), fmu)


def _with_measured_steps(problem: Problem, x: FloatArray) -> Problem:
    return dataclasses.replace(problem, steps=choose_steps(problem.model, x).steps)


@pytest.mark.parametrize(
    ("settings", "joystick"), [(SCALED, NOMINAL), (POWER_LAW, NOMINAL_POWER_LAW)], ids=["constant", "eq11"]
)
def test_those_of_releases(settings: FitSettings, joystick: JoystickParameters, fmus_by_name: Path) -> None:
    scale = 1.0 + float(settings.fixed.get("angle_scale", 0.0))
    with Fmu(settings.fmu) as fmu:
        problem = _problem(fmu, settings, joystick)
        x = problem.variables.start
        jacobians = problem.jacobians(x)
    assert all(problem.model.exact)
    parameters = problem.variables.varied
    for k, jacobian in enumerate(jacobians):
        start = float(x[problem.variables.place("theta_start", k)])
        late = problem.predictors[k].record.time - problem.variables.instrument(x, k).release_time
        moving = np.concatenate(([0.0], late[late > 0.0]))
        values = {**joystick.to_names(), **dict(zip(parameters, problem.variables.row(x, k), strict=True))}
        rows, _ = Joystick(values, parameters).motion(moving, start)
        shown = np.concatenate((np.zeros(np.count_nonzero(late <= 0.0), int), np.arange(1, moving.size)))
        for i, name in enumerate(parameters):
            theta, omega = scale * rows[2 + 2 * i][shown], rows[3 + 2 * i][shown]
            expected = np.concatenate((theta, omega) if len(settings.outputs) == 2 else (theta,))
            column = jacobian[:, problem.variables.place(name, k)]
            # Errors of 1e-7 of the largest are those at this tolerance (docs/sensitivities.md).
            np.testing.assert_allclose(column, expected, atol=1e-6 * np.max(np.abs(expected)), err_msg=name)


def test_those_of_a_driven_motion_are_its_differences(
    fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a delay, the motion of the first samples is before the origin of the record."""
    time = np.arange(400) / 400.0
    torque = 2.0 * np.sin(2.0 * np.pi * 2.0 * time + 0.3)
    settings = dataclasses.replace(driven(CONSTANT_DAMPING), tolerance=1e-10)
    record = Measurement("hand", time, {"theta": 0.1 + 0.0 * time, "T": torque})
    with Fmu(settings.fmu) as fmu:
        problem = make_problem([record], settings, fmu)
        x = problem.variables.start
        delay = next(j for j, one in enumerate(problem.variables.free) if one.name == "delay")
        x[delay] = 0.004
        exact = problem.jacobian(x)
        assert all(problem.model.exact)
        monkeypatch.setattr(Fmu, "sensitive", None)
        differences = _with_measured_steps(make_problem([record], settings, fmu), x).jacobian(x)
    assert np.count_nonzero(time <= 0.004) == 2
    for j, one in enumerate(problem.variables.free):
        size = np.max(np.abs(differences[:, j]))
        np.testing.assert_allclose(exact[:, j], differences[:, j], atol=1e-6 * size, err_msg=one.label)


def test_others_are_differences(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of what no sensitivity is built for, and of what ties use."""
    free = (Free("damping.C", start=0.05), Free("J", start=0.0114), Free("m", start=0.9), *RELEASE)
    settings = FitSettings(fmu="Joystick", free=free, ties={"h": "0.08 + 0.1 * J"})
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), settings, fmu)
        exact = {one.name: yes for one, yes in zip(problem.variables.free, problem.model.exact, strict=True)}
        assert [name for name, yes in exact.items() if not yes] == ["J", "m"]
        x = problem.variables.start
        chosen = choose_steps(problem.model, x)
        assert np.count_nonzero(chosen.errors) == 2
        jacobian = problem.jacobian(x)
        monkeypatch.setattr(Fmu, "sensitive", None)
        differences = _with_measured_steps(make_problem(releases(NOMINAL), settings, fmu), x).jacobian(x)
    np.testing.assert_allclose(jacobian, differences, atol=1e-4 * np.max(np.abs(jacobian)))


def test_without_the_fmu_there_are_none(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Fmu, "sensitive", None)
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), CONSTANT_DAMPING, fmu)
    assert problem.model.exact == tuple(one.of_instrument for one in problem.variables.free)
