"""Weights, and the estimated noise."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import CONSTANT_DAMPING, Fit, FitSettings, Free, Noise, Uncertainty, fit
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.noise_model import weights_of
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL
from pyjoystick.motion import Record
from tests.pyjoystick.identification.fitting.made import releases

NOISE = math.radians(0.1)
SPRINGS = tuple(Free(f"{side}.returnSpring.F_0") for side in ("forward", "backward"))
PEAKS = dataclasses.replace(
    CONSTANT_DAMPING, comparison="peaks", free=(*CONSTANT_DAMPING.free, *SPRINGS), uncertainty=Uncertainty()
)
OUTPUTS = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))


def _descent(found: Fit, records: list[Record], settings: FitSettings) -> tuple[float, float]:
    """The sum of squares with the weights at the end of a fit, and by how much a linear step lowers it."""
    with Fmu(settings.fmu) as fmu:
        problem = make_problem(records, settings, fmu)
        problem = problem.with_weights(weights_of(problem.predictors, [one.sigma for one in found.records]))
        problem = dataclasses.replace(problem, steps=choose_steps(problem.model, found.x).steps)
        residuals, jacobian = problem.residuals(found.x), problem.jacobian(found.x)
    step = np.linalg.lstsq(jacobian, -residuals, rcond=None)[0]
    cost = float(residuals @ residuals)
    return cost, cost - float(np.sum((residuals + jacobian @ step) ** 2))


@pytest.mark.parametrize(
    "settings",
    [PEAKS, dataclasses.replace(OUTPUTS, noise=Noise(per_record=True)), OUTPUTS],
    ids=["peaks", "noise by record", "trajectory"],
)
def test_the_end_is_a_minimum_with_the_noise_that_was_estimated(
    fmus_by_name: Path, settings: FitSettings
) -> None:
    """Weights change from the first guess to the estimate, and the minimum must be that of the last ones."""
    records = releases(NOMINAL, 2, noise=NOISE)
    found = fit(records, settings)
    cost, descent = _descent(found, records, settings)
    assert found.cost == pytest.approx(cost, rel=1e-6)
    # In variances of the noise: less than a hundredth of a standard error.
    assert descent < 1e-4
    assert found.cost == pytest.approx(found.standard_errors.degrees_of_freedom, rel=0.02)


def test_heights_and_times_of_peaks_count_alike(fmus_by_name: Path) -> None:
    found = fit(releases(NOMINAL, 2, noise=NOISE), PEAKS)
    assert found.trusted, [check for check in found.checks if not check.passed]
    for one in found.records:
        assert one.sigma["theta"] == pytest.approx(one.sigma["theta time"], rel=1e-12)
    assert found.profiles
    assert all(profile.converged for profile in found.profiles.values())
