"""Untrustworthy fits say so, and why."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import pytest

from pyjoystick.identification import CONSTANT_DAMPING, Fit, FitError, Free, Noise, Uncertainty, fit
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from tests.pyjoystick.identification.fitting.made import releases

NOISE = math.radians(0.1)
QUICK = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))


def _failed(found: Fit) -> list[str]:
    return [check.name for check in found.checks if not check.passed]


def test_noise_is_estimated_and_the_fit_trusted(fmus_by_name: Path) -> None:
    found = fit(releases(NOMINAL, 2, noise=NOISE), CONSTANT_DAMPING)
    assert _failed(found) == []
    assert found.records[0].sigma["theta"] == pytest.approx(NOISE, rel=0.15)
    # The model is all but linear in C over its interval: the profile agrees with the linear interval.
    low, high = found.intervals[0]
    assert found.profiles[0].interval == pytest.approx((low, high), abs=0.02 * (high - low))
    # Five standard errors: seen once in two million data sets, and the seed is fixed.
    assert abs(found.value("damping.C") - 0.045) < 5.0 * found.error("damping.C")


def test_the_wrong_law_leaves_residuals_that_are_not_white(fmus_by_name: Path) -> None:
    found = fit(releases(NOMINAL_POWER_LAW, 1, noise=NOISE), QUICK)
    assert "missing physics" in _failed(found)


def test_more_left_over_than_the_noise_that_was_given(fmus_by_name: Path) -> None:
    settings = dataclasses.replace(QUICK, noise=Noise({"theta": 0.5 * NOISE}))
    found = fit(releases(NOMINAL, 1, noise=NOISE), settings)
    assert _failed(found) == ["size of residuals"]


def test_a_bound_is_named(fmus_by_name: Path) -> None:
    free = (Free("damping.C", start=0.055, minimum=0.05, maximum=0.1), *QUICK.free[1:])
    found = fit(releases(NOMINAL), dataclasses.replace(QUICK, free=free))
    assert "bounds" in _failed(found)
    assert "damping.C = 0.05" in next(check.message for check in found.checks if check.name == "bounds")


def test_too_few_peaks_to_compare(fmus_by_name: Path) -> None:
    settings = dataclasses.replace(QUICK, comparison="peaks", peaks=40)
    with pytest.raises(
        FitError, match=r"run 0: has \d+ peaks of theta that stand out, 40 are to be compared"
    ):
        fit(releases(NOMINAL), settings)
