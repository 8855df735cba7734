"""Guessing the release from the record alone."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from pyjoystick.identification.fitting.problem.measurement import guess_release
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL


@pytest.mark.parametrize(("degrees", "rate", "noise"), [*product((-20.0, 12.0), (60.0, 600.0), (0.0, 0.1))])
def test_the_release_is_found_to_a_frame(degrees: float, rate: float, noise: float) -> None:
    record = synthetic_record(
        NOMINAL,
        release_angle=math.radians(degrees),
        random=np.random.default_rng(3),
        name="run",
        release_time=0.1237,
        duration=1.6,
        rate=rate,
        noise=math.radians(noise),
    )
    angle, instant, _ = guess_release(record.time, record.theta)
    assert math.degrees(angle) == pytest.approx(degrees, abs=0.2)
    # 60 frames a second: linear between two samples of a curved fall.
    assert instant == pytest.approx(0.1237, abs=0.01)


@pytest.mark.parametrize("rate", [60.0, 600.0])
@pytest.mark.parametrize("degrees", [3.0, -1.5])
def test_small_releases_are_found_in_noise(degrees: float, rate: float) -> None:
    """Noise alone takes some samples of the hold below 0.9 of the largest."""
    for seed in range(10):
        record = synthetic_record(
            NOMINAL,
            release_angle=math.radians(degrees),
            random=np.random.default_rng(seed),
            name="run",
            release_time=0.25,
            duration=1.0,
            rate=rate,
            noise=math.radians(0.1),
        )
        angle, instant, _ = guess_release(record.time, record.theta)
        assert math.degrees(angle) == pytest.approx(degrees, abs=0.2)
        assert instant == pytest.approx(0.25, abs=0.025)


@pytest.mark.parametrize(
    ("weaker", "zero"), [({"forward.returnSpring.F_0": 20.0, "damping.C": 0.01}, 0.0), ({}, 3.0)]
)
def test_the_first_swing_need_not_be_the_largest(weaker: dict[str, float], zero: float) -> None:
    """Where one side has the weaker spring, or the zero is off, the swing after the release goes further."""
    record = synthetic_record(
        NOMINAL.replace(weaker),
        release_angle=math.radians(-12.0),
        random=np.random.default_rng(1),
        name="run",
        release_time=0.25,
        duration=1.5,
        rate=240.0,
        noise=math.radians(0.05),
    )
    theta = record.theta + math.radians(zero)
    assert np.max(theta) > 1.05 * np.max(-theta)
    angle, instant, _ = guess_release(record.time, theta)
    assert math.degrees(angle) == pytest.approx(zero - 12.0, abs=0.1)
    assert instant == pytest.approx(0.25, abs=0.005)


def test_outliers_do_not_mislead() -> None:
    random = np.random.default_rng(2)
    record = synthetic_record(
        NOMINAL, release_angle=math.radians(-20.0), random=random, name="run", release_time=0.1, duration=1.0
    )
    theta = record.theta.copy()
    theta[1] += math.radians(11.0)
    theta[3] -= math.radians(11.0)
    angle, instant, _ = guess_release(record.time, theta)
    assert math.degrees(angle) == pytest.approx(-20.0, abs=0.1)
    assert instant == pytest.approx(0.1, abs=0.01)


def test_a_record_that_begins_in_the_fall_is_followed_back() -> None:
    """To the instant at which the motion was at rest, 10 ms before the first sample."""
    time = np.linspace(0.0, 1.0, 61)
    found = guess_release(time, -0.3 * np.exp(-time) * np.cos(20.0 * time + 0.2))
    assert found.angle == pytest.approx(-0.3, rel=0.05)
    assert found.time == pytest.approx(-0.01, abs=0.002)
