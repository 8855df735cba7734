"""Samples of motions and the integrals over them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.forced_motion import ForwardAndReturn, Samples, smooth_spans
from pyjoystick.model import NOMINAL, contact_travel
from pyjoystick.support import ParameterError, SeriesError
from tests.pyjoystick.forced_motion.cases import MOTIONS

TIME = np.array([0.0, 0.1, 0.3])


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_integrals_of_the_velocity_are_the_angles(motion: ForwardAndReturn) -> None:
    samples = Samples.of(NOMINAL, motion)
    assert np.sum(samples.weights) == pytest.approx(motion.duration, rel=1e-14)
    assert abs(np.sum(samples.omega * samples.weights)) < 1e-15
    stroke = samples.time <= motion.rest + motion.rise
    assert np.sum((samples.omega * samples.weights)[stroke]) == pytest.approx(motion.amplitude, rel=1e-13)


def test_every_kink_that_is_passed_ends_a_span() -> None:
    """Four on the way up and four on the way down; the balance spring begins at 6.8 degrees forward."""
    motion = ForwardAndReturn(amplitude=math.radians(15.0), rise=0.2)
    spans = smooth_spans(NOMINAL, motion)
    assert len(spans) == 3 + 8
    travels = contact_travel(NOMINAL, motion.at(spans[1:5]).theta)
    np.testing.assert_allclose(travels, NOMINAL.forward.kinks, rtol=1e-12)
    small = ForwardAndReturn(amplitude=math.radians(-5.0), rise=0.2)
    assert len(smooth_spans(NOMINAL, small)) == 3 + 4


def test_even_samples_show_both_sides_of_a_jump() -> None:
    motion = ForwardAndReturn(amplitude=0.3, rise=0.2, rest=0.1, dwell=0.1, shape="raised-cosine")
    samples = Samples.evenly(motion, 0.01)
    repeated = samples.time[1:][np.diff(samples.time) == 0.0]
    np.testing.assert_allclose(repeated, [0.1, 0.3, 0.4, 0.6], atol=1e-15)
    assert len(samples) == 70 + 1 + 4
    assert np.abs(np.diff(samples.alpha)[np.diff(samples.time) == 0.0]) == pytest.approx(
        0.5 * math.pi**2 * 0.3 / 0.04, rel=1e-12
    )
    assert np.sum(samples.weights) == pytest.approx(0.7, rel=1e-14)
    with pytest.raises(ParameterError, match="output_interval"):
        Samples.evenly(motion, 0.0)


def test_the_trapezoidal_rule_is_exact_for_straight_lines() -> None:
    samples = Samples.trapezoidal(TIME, TIME, np.ones(3), np.zeros(3))
    assert np.sum(samples.theta * samples.weights) == pytest.approx(0.3**2 / 2.0, rel=1e-14)
    assert samples.duration == 0.3


def test_a_motion_with_a_jump_is_not_refined() -> None:
    samples = Samples.trapezoidal(np.array([0.0, 0.1, 0.1, 0.2]), *np.zeros((3, 4)))
    with pytest.raises(SeriesError, match=r"'time': does not increase at sample 2, 0\.1 s"):
        samples.refined(NOMINAL)


@pytest.mark.parametrize(
    ("time", "theta", "message"),
    [
        (TIME, np.zeros(2), "'theta': has the shape"),
        (TIME, np.array([0.0, math.nan, 0.0]), "'theta': sample 1 is nan"),
        (TIME[::-1], np.zeros(3), "must have two or more instants"),
        (np.array([0.0, 0.2, 0.1]), np.zeros(3), "'time': falls at sample 2, 0.1 s"),
        (np.zeros(3), np.zeros(3), "must have two or more instants"),
    ],
)
def test_what_is_refused(time: np.ndarray, theta: np.ndarray, message: str) -> None:
    with pytest.raises(SeriesError, match=message):
        Samples.trapezoidal(time, theta, np.zeros(len(time)), np.zeros(len(time)))
