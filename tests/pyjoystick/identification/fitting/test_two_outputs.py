"""Records of angle and angular velocity, where derivative and sampled output coincide."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import RELEASE, FitSettings, Free, Measurement, Noise, Uncertainty, fit
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL, simulate

SIGMA = {"theta": np.radians(0.1), "omega": 0.05}
SETTINGS = FitSettings(
    fmu="Joystick", free=(Free("damping.C"), *RELEASE), outputs=("theta", "omega"), noise=Noise(sigma=SIGMA)
)


@pytest.fixture(scope="module")
def joystick(joystick_fmus: Path) -> Iterator[Fmu]:
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        yield fmu


def _records() -> list[Measurement]:
    random = np.random.default_rng(4)
    found = []
    for number, start in enumerate(np.radians([-20.0, -18.0])):
        time = np.arange(90) / 60.0
        late = np.maximum(time - 0.2437, 0.0)
        instants = np.union1d([0.0], late)
        run = simulate(NOMINAL, time=instants, theta_start=start)
        at = np.searchsorted(instants, late)
        columns = {
            "theta": run.theta[at] + random.normal(0.0, SIGMA["theta"], len(time)),
            "omega": run.omega[at] + random.normal(0.0, SIGMA["omega"], len(time)),
        }
        found.append(Measurement(f"record {number}", time, columns))
    return found


def test_the_jacobian_is_that_of_differences(joystick: Fmu) -> None:
    problem = make_problem(_records(), SETTINGS, joystick)
    x = problem.variables.start
    found = problem.jacobian(x)
    for j, one in enumerate(problem.variables.free):
        step = 1e-6 * max(one.scale, 1e-3)
        move = step * np.eye(len(x))[j]
        expected = (problem.residuals(x + move) - problem.residuals(x - move)) / (2.0 * step)
        # The acceleration jumps at kinks, which differences of the velocity step over.
        error = np.abs(found[:, j] - expected)
        assert np.median(error) <= 1e-3 * np.median(np.abs(expected[expected != 0.0])), one.label


def test_the_fit_finds_what_was_put_in(joystick: Fmu) -> None:
    found = fit(_records(), SETTINGS, fmu=joystick)
    assert found.trusted, [check.message for check in found.checks if not check.passed]
    assert abs(found.value("damping.C") - 0.045) < 4.0 * found.error("damping.C")
    assert found.error("damping.C") < 1e-4


def test_the_bootstrap_draws_each_output_in_its_own_unit(joystick: Fmu) -> None:
    """The noise of the velocity, in rad/s, is 29 times that of the angle, in rad."""
    wanted = Uncertainty(profiles=(), bootstrap=60, resampling="residuals")
    found = fit(_records(), dataclasses.replace(SETTINGS, uncertainty=wanted), fmu=joystick)
    assert found.bootstrap is not None
    ratios = found.bootstrap.errors() / found.standard_errors.errors
    # 60 draws know a standard deviation to 9 %.
    assert np.all((ratios > 0.6) & (ratios < 1.4)), ratios


def test_an_output_without_a_derivative_is_fitted_from_known_releases(joystick: Fmu) -> None:
    """Only a free clock and motions that are driven need the derivative of an output."""
    time = np.arange(90) / 60.0
    run = simulate(NOMINAL, time=time, theta_start=-0.3)
    record = Measurement("moment", time, {"M_s": np.asarray(run.M_s)})
    settings = FitSettings(
        fmu="Joystick", free=(Free("damping.C", start=0.03),), fixed={"theta_start": -0.3}, outputs=("M_s",)
    )
    found = fit([record], settings, fmu=joystick)
    assert found.value("damping.C") == pytest.approx(0.045, rel=1e-4)
