from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from pyjoystick.identification import DampingEstimateError, estimate_damping
from tests.pyjoystick.releases import linear_release, peak_table

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


def test_too_little_is_refused() -> None:
    with pytest.raises(DampingEstimateError, match="no release"):
        estimate_damping([], J)
    release = linear_release(J, C, 30.0)
    few = dataclasses.replace(release, displacement=peak_table([2.1, 2.2], [0.2, -0.1]))
    with pytest.raises(DampingEstimateError, match="positive peaks: 1 points"):
        estimate_damping([few], J)
