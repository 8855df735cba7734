from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.identification import displacement_points, velocity_points
from pyjoystick.motion import ReleasePeaks
from pyjoystick.support import ParameterError
from tests.pyjoystick.releases import linear_release, peak_table

J, C = 0.01135, 0.045


def test_eq_10_by_hand() -> None:
    peaks = ReleasePeaks(
        name="by hand",
        release_time=1.0,
        release_angle=-0.4,
        displacement=peak_table([1.5, 2.0], [0.2, -0.1]),
        velocity=peak_table([1.25, 1.75, 2.25], [8.0, -4.0, 2.0]),
    )
    points = displacement_points(peaks, J)
    assert points["C"].tolist() == pytest.approx([2 * J / 0.5 * math.log(2.0), 2 * J / 1.0 * math.log(4.0)])
    assert points["peak"].tolist() == [0.2, -0.1]
    assert points["number"].tolist() == [1, 2]
    first = velocity_points(peaks, J)
    assert first["C"].tolist() == pytest.approx([2 * J / 0.5 * math.log(2.0), 2 * J / 1.0 * math.log(4.0)])
    assert first["number"].tolist() == [2, 3]
    letter = velocity_points(peaks, J, clock="release")
    assert letter["C"].tolist() == pytest.approx([2 * J / 0.75 * math.log(2.0), 2 * J / 1.25 * math.log(4.0)])


def test_it_is_exact_for_a_linear_joystick() -> None:
    peaks = linear_release(J, C, 30.0)
    displacement, velocity = displacement_points(peaks, J), velocity_points(peaks, J)
    assert (len(displacement), len(velocity)) == (9, 9)
    assert displacement["C"].to_numpy() == pytest.approx(C, rel=1e-12)
    assert velocity["C"].to_numpy() == pytest.approx(C, rel=1e-12)


def test_counted_from_the_release_a_linear_joystick_has_a_falling_line() -> None:
    """The exponent near the paper's m = -0.26 comes with this clock whatever the damping."""
    points = velocity_points(linear_release(J, C, 30.0), J, clock="release")
    assert np.all(np.diff(points["C"]) > 0.0)
    assert points["C"].iloc[0] < 0.7 * C


def test_an_inertia_that_cannot_be_is_refused() -> None:
    with pytest.raises(ParameterError, match="inertia"):
        displacement_points(linear_release(J, C, 30.0), 0.0)
