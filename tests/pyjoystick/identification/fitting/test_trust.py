"""Fits that are not to be trusted say so, and why."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import CONSTANT_DAMPING, Fit, FitError, Free, Noise, Uncertainty, fit
from pyjoystick.identification.fitting.trust import check_whiteness
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
    assert _failed(found) == ["whiteness"]


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


def test_white_noise_passes_and_a_slow_wave_does_not() -> None:
    noise = np.random.default_rng(5).standard_normal(200)
    assert check_whiteness(["a"], [noise], 0.0).passed
    wave = noise + np.sin(np.linspace(0.0, 12.0, 200))
    check = check_whiteness(["a", "b"], [noise, wave], 0.0)
    assert not check.passed
    assert "not white in b" in check.message


def test_a_zero_offset_is_reported() -> None:
    noise = np.random.default_rng(5).normal(size=300)
    noise = (noise - noise.mean()) / noise.std()
    check = check_whiteness(["a", "b"], [noise, noise + 0.6], 0.0)
    assert check.passed
    assert "those of b have a mean of +0.60 standard deviations" in check.message
    assert "those of a" not in check.message
