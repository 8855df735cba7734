"""Peaks of runs against measured ones."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import CONSTANT_DAMPING, FitError, Measurement
from pyjoystick.identification.fitting.problem.peak_prediction import PeakPredictor, missing_peaks
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL
from tests.pyjoystick.identification.fitting.made import releases

PEAKS = dataclasses.replace(CONSTANT_DAMPING, comparison="peaks")


def test_residuals_are_those_of_eqs_12(fmus_by_name: Path) -> None:
    """Heights by the measured height, times by the spacing of the measured times."""
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), PEAKS, fmu)
        x = problem.variables.start
        (predictor,) = problem.predictors
        assert isinstance(predictor, PeakPredictor)
        heights, times = np.split(predictor.data, 2)
        assert predictor.normalization[:9] == pytest.approx(np.abs(heights))
        assert predictor.normalization[10:] == pytest.approx(np.diff(times))
        (predicted,) = problem.predictions(x)
        residuals = (predicted - predictor.data) / predictor.normalization
        assert problem.residuals(x) / residuals == pytest.approx(np.full(18, 100.0))
    assert np.all(np.sign(predicted[:9]) == np.sign(heights))


def test_the_release_time_moves_all_times_and_no_height(fmus_by_name: Path) -> None:
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), PEAKS, fmu)
        x = problem.variables.start
        later = x.copy()
        later[problem.variables.instrument_places(0)["release_time"]] += 0.01
        (before,), (after,) = problem.predictions(x), problem.predictions(later)
    assert after - before == pytest.approx(np.repeat([0.0, 0.01], 9), abs=1e-12)


def test_peaks_that_do_not_come_are_counted(fmus_by_name: Path) -> None:
    """With much damping the joystick creeps back: fewer peaks than were measured."""
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), PEAKS, fmu)
        x = problem.variables.start
        assert missing_peaks(problem.predictions(x)[0]) == 0
        x[0] = 0.3
        (predicted,) = problem.predictions(x)
        assert missing_peaks(predicted) > 0
        assert np.all(np.isfinite(problem.residuals(x)))


def test_only_the_angle_and_its_velocity_have_measured_peaks(fmus_by_name: Path) -> None:
    record = releases(NOMINAL)[0]
    measured = Measurement("run", record.time, {"theta": record.theta, "E": record.theta})
    settings = dataclasses.replace(PEAKS, outputs=("E",), derivatives={"E": "omega"})
    with Fmu("Joystick") as fmu, pytest.raises(FitError, match="run: peaks of E cannot be measured"):
        make_problem([measured], settings, fmu)


def test_peaks_of_the_velocity(fmus_by_name: Path) -> None:
    settings = dataclasses.replace(PEAKS, outputs=("omega",))
    with Fmu("Joystick") as fmu:
        problem = make_problem(releases(NOMINAL), settings, fmu)
        x = problem.variables.start
        x[0] = 0.045
        (predicted,) = problem.predictions(x)
        predictor = problem.predictors[0]
    # The spline rounds the corners of the velocity off within less than a frame.
    assert predicted[:9] == pytest.approx(predictor.data[:9], rel=0.06)
