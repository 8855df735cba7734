from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.laboratory import ANGLE_NOISE, CAMERA_RATE, synthetic_record
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import ParameterError

RELEASE = math.radians(-20.0)


def test_without_noise_it_is_the_held_then_released_joystick() -> None:
    record = synthetic_record(
        NOMINAL, release_angle=RELEASE, random=np.random.default_rng(1), release_time=0.26, noise=0.0
    )
    assert np.diff(record.time) == pytest.approx(1.0 / CAMERA_RATE)
    assert record.time[-1] == 1.75
    held = record.time <= 0.26
    assert set(record.theta[held]) == {RELEASE}
    free = simulate(NOMINAL, time=np.insert(record.time[~held] - 0.26, 0, 0.0), theta_start=RELEASE)
    assert record.theta[~held] == pytest.approx(free.theta[1:], abs=1e-9)


def test_the_noise_is_the_one_asked_for_and_repeats_with_the_seed() -> None:
    clean, noisy, again = (
        synthetic_record(NOMINAL, release_angle=RELEASE, random=np.random.default_rng(1), noise=noise)
        for noise in (0.0, ANGLE_NOISE, ANGLE_NOISE)
    )
    assert np.std(noisy.theta - clean.theta) == pytest.approx(ANGLE_NOISE, rel=0.2)
    assert np.array_equal(noisy.theta, again.theta)
    assert "synthetic" in noisy.source


def test_settings_that_cannot_be_are_refused() -> None:
    for name, value in (("noise", -1.0), ("rate", 0.0), ("release_time", -0.1), ("release_angle", 2.0)):
        options = {"release_angle": RELEASE, name: value}
        with pytest.raises(ParameterError, match=name):
            synthetic_record(NOMINAL, random=np.random.default_rng(1), **options)
