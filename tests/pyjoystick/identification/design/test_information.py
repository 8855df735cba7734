"""The information in an experiment, against derivatives of the reference and fits of synthetic records."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    RELEASE,
    Experiment,
    FitSettings,
    Free,
    PlannedFit,
    best_design,
    design_json,
    design_table,
    plot_design,
    trial_sentence,
    try_design,
)
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import FloatArray, ParameterError

SIGMA = {"theta": math.radians(0.1)}
FREE_J = FitSettings(fmu="Joystick", free=(Free("J"), Free("damping.C"), *RELEASE))


@pytest.fixture(scope="module")
def planned(joystick_fmus: Path) -> Iterator[PlannedFit]:
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        yield PlannedFit(FREE_J, NOMINAL.to_names(), SIGMA, fmu)


def _reference(experiment: Experiment, **changes: float) -> FloatArray:
    """What a camera sees of the reference, with J, C, angle and instant of the release, and zero moved."""
    angle = experiment.release_angle + changes.pop("angle", 0.0)
    later, zero = changes.pop("later", 0.0), changes.pop("zero", 0.0)
    names = {"J": "J", "C": "damping.C"}
    values = NOMINAL.to_names()
    joystick = NOMINAL.replace({names[key]: values[names[key]] + one for key, one in changes.items()})
    time = np.union1d([0.0], np.maximum(experiment.time - later, 0.0))
    run = simulate(joystick, time=time, theta_start=angle)
    return run.theta[np.searchsorted(time, np.maximum(experiment.time - later, 0.0))] + zero


@pytest.mark.parametrize("degrees", [-20.0, 5.0])
def test_the_information_is_that_of_the_reference(planned: PlannedFit, degrees: float) -> None:
    experiment = Experiment.release(math.radians(degrees), rate=60.0, duration=1.0)
    steps = {"J": 1e-7, "C": 1e-6, "angle": 1e-6, "later": 1e-6, "zero": 1e-3}
    columns = [
        (_reference(experiment, **{name: step}) - _reference(experiment, **{name: -step})) / (2.0 * step)
        for name, step in steps.items()
    ]
    jacobian = np.array(columns).T / SIGMA["theta"]
    # The inverse of the part of the whole covariance is the information on J and C alone.
    expected = np.linalg.inv(np.linalg.inv(jacobian.T @ jacobian)[:2, :2])
    found = planned.information(experiment)
    assert found.names == ("J", "damping.C")
    scale = np.outer(found.values, found.values)
    np.testing.assert_allclose(found.matrix * scale, expected * scale, rtol=2e-3, atol=1.0)


def test_fits_scatter_as_predicted(planned: PlannedFit) -> None:
    experiments = [Experiment.release(math.radians(angle), rate=60.0, duration=1.0) for angle in (-20.0, 5.0)]
    design = best_design([planned.information(one) for one in experiments], 1)
    told: list[tuple[int, int]] = []
    trial = try_design(design, planned, sets=8, on_progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (8, 8)
    low, high = np.sqrt(stats.chi2.ppf((1e-4, 1.0 - 1e-4), 8) / 8)
    assert np.all((trial.ratios > low) & (trial.ratios < high))
    assert "scatter of 8 fitted synthetic sets" in trial_sentence(trial)
    assert '"sets": 8' in design_json({"best": design}, trial)


def test_a_driven_joystick_shows_its_stiffness_too(planned: PlannedFit) -> None:
    """Released, J and the stiffnesses are known as ratios alone: a torque gives the scale."""
    free = (Free("J"), Free("forward.returnSpring.F_0"), Free("zero_offset", per_record=True))
    settings = FitSettings(fmu="Joystick", free=free, inputs=("T",))
    driven = PlannedFit(settings, NOMINAL.to_names(), SIGMA, planned.fmu)
    time = np.arange(301) / 200.0
    found = {
        name: driven.information(Experiment(name, time, start, {"T": torque}))
        for name, start, torque in (
            ("released", math.radians(10.0), np.zeros(301)),
            ("driven", 0.0, 2.5 * np.sin(8.0 * time)),
        )
    }
    condition = {
        name: np.linalg.cond(one.matrix * np.outer(one.values, one.values)) for name, one in found.items()
    }
    assert condition["driven"] < condition["released"]


def test_reports(planned: PlannedFit) -> None:
    experiments = [Experiment.release(math.radians(angle), rate=60.0, duration=0.5) for angle in (-20.0, 5.0)]
    design = best_design([planned.information(one) for one in experiments], 2)
    table = design_table({"the best 2": design})
    assert "J (%)" in table
    assert "damping.C (%)" in table
    figure = plot_design(design)
    assert figure.axes[0].get_ylabel() == "Standard error (%)"


def test_what_cannot_be_planned(planned: PlannedFit) -> None:
    values = NOMINAL.to_names()
    with pytest.raises(ParameterError, match="noise of theta"):
        PlannedFit(CONSTANT_DAMPING, values, {}, planned.fmu)
    with pytest.raises(ParameterError, match="all records share"):
        PlannedFit(FitSettings(fmu="Joystick", free=RELEASE), values, SIGMA, planned.fmu)
    peaks = FitSettings(fmu="Joystick", free=(Free("damping.C"), *RELEASE), comparison="peaks")
    with pytest.raises(ParameterError, match="comparison"):
        PlannedFit(peaks, values, SIGMA, planned.fmu)


def test_what_the_settings_know_counts_once_for_all_records(planned: PlannedFit) -> None:
    """A short release tells little of J beside a swing test, a hundred of them no hundred times the test."""
    known = FitSettings(fmu="Joystick", free=(Free("J", 0.01, uncertainty=1e-5), Free("damping.C"), *RELEASE))
    experiment = Experiment.release(math.radians(5.0), rate=30.0, duration=0.1)
    with_test = PlannedFit(known, NOMINAL.to_names(), SIGMA, planned.fmu)
    told = with_test.information(experiment)
    design = best_design([told], 100, uncertainties=with_test.uncertainties)
    alone = 100.0 * planned.information(experiment).matrix
    expected = np.sqrt(np.diag(np.linalg.inv(alone + np.diag([1e10, 0.0]))))
    assert design.errors == pytest.approx(expected, rel=1e-6)
    assert design.errors[0] > 5e-6
