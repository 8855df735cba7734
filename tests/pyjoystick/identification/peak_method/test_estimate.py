"""The peak method: its points, pooled constants and lines."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from pyjoystick.identification import (
    DampingEstimateError,
    displacement_points,
    estimate_damping,
    velocity_points,
)
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


J, C = 0.01135, 0.045


def test_linear_joysticks_pooled() -> None:
    releases = [linear_release(J, C, frequency, name=f"{frequency}") for frequency in (25.0, 30.0, 36.0)]
    estimate = estimate_damping(releases, J)
    assert len(estimate.displacement) == len(estimate.velocity) == 27
    assert estimate.left_out == 0
    for line in estimate.lines.values():
        assert line.exponent == pytest.approx(0.0, abs=1e-9)
        assert line.coefficient == pytest.approx(C, rel=1e-9)
    assert [line.points for line in estimate.lines.values()] == [15, 12, 27]
    for constant in estimate.constants.values():
        assert constant.value == pytest.approx(C, rel=1e-12)
    law = estimate.law(0.9)
    assert (law.alpha, law.A_neg, law.B) == pytest.approx((0.9, C, C))


def test_the_error_of_a_constant_comes_from_the_records() -> None:
    values = (0.044, 0.045, 0.047)
    estimate = estimate_damping([linear_release(J, value, 30.0, name=f"{value}") for value in values], J)
    found = estimate.constants["both"]
    assert found.value == pytest.approx(np.mean(values))
    assert found.error == pytest.approx(np.std(values, ddof=1) / np.sqrt(3.0))
    interval = found.interval()
    assert interval is not None
    # Student's t for two degrees of freedom.
    assert interval[1] - found.value == pytest.approx(4.3027 * found.error, rel=1e-4)
    alone = estimate_damping([linear_release(J, C, 30.0)], J).constants["both"]
    assert (alone.error, alone.interval()) == (None, None)


def test_a_peak_no_lower_than_the_release_is_left_out_and_counted() -> None:
    release = linear_release(J, C, 30.0)
    raised = release.displacement.copy()
    raised.loc[0, "value"] = 0.31
    estimate = estimate_damping([dataclasses.replace(release, displacement=raised)], J)
    assert estimate.left_out == 1
    assert estimate.lines["positive"].points == 4
    assert estimate.displacement["C"].iloc[0] < 0.0


def test_peaks_that_do_not_fall_are_refused_with_their_record() -> None:
    """A first peak that is much too low makes C negative."""
    good, bad = (linear_release(J, C, 30.0, name=name) for name in ("good", "bad"))
    velocity = bad.velocity.assign(value=bad.velocity["value"].where(bad.velocity.index > 0, 0.01))
    bad = dataclasses.replace(bad, velocity=velocity)
    with pytest.raises(DampingEstimateError, match=r"^bad: the velocity peaks do not fall: C = -.*above 0"):
        estimate_damping([good, bad], J)


def test_too_little_is_refused() -> None:
    with pytest.raises(DampingEstimateError, match="no release"):
        estimate_damping([], J)
    release = linear_release(J, C, 30.0)
    few = dataclasses.replace(release, displacement=peak_table([2.1, 2.2], [0.2, -0.1]))
    with pytest.raises(DampingEstimateError, match="positive peaks of linear: 1 points"):
        estimate_damping([few], J)


def test_a_release_without_peaks_of_the_velocity_is_told() -> None:
    quiet = dataclasses.replace(linear_release(J, C, 30.0, name="quiet"), velocity=peak_table([], []))
    with pytest.raises(DampingEstimateError, match="quiet: no peak of the velocity stands out of the noise"):
        estimate_damping([quiet], J)
