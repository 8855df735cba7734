from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import linregress, t as student

from pyjoystick.identification import DampingEstimateError, fit_power_line

HEIGHT = np.geomspace(0.03, 0.3, 12)


def _scattered(seed: int) -> np.ndarray:
    noise = 0.05 * np.random.default_rng(seed).standard_normal(len(HEIGHT))
    return np.asarray(0.04 * HEIGHT**-0.2 * np.exp(noise))


def test_a_power_law_is_found_exactly() -> None:
    line = fit_power_line(HEIGHT, 0.04 * HEIGHT**-0.2, name="exact")
    assert line.coefficient == pytest.approx(0.04, rel=1e-12)
    assert line.exponent == pytest.approx(-0.2, rel=1e-12)
    assert line.exponent_interval() == pytest.approx((-0.2, -0.2), abs=1e-9)


def test_it_is_the_regression_of_scipy() -> None:
    damping = _scattered(1)
    line, expected = fit_power_line(HEIGHT, damping, name="x"), linregress(np.log(HEIGHT), np.log(damping))
    assert line.exponent == pytest.approx(expected.slope, rel=1e-12)
    assert np.log(line.coefficient) == pytest.approx(expected.intercept, rel=1e-12)
    half = student.ppf(0.975, 10) * expected.stderr
    assert line.exponent_interval() == pytest.approx((expected.slope - half, expected.slope + half))
    half = student.ppf(0.975, 10) * expected.intercept_stderr
    assert np.log(line.coefficient_interval()) == pytest.approx(
        (expected.intercept - half, expected.intercept + half)
    )


def test_the_band_covers_the_true_line_as_often_as_it_says() -> None:
    covered = 0
    for seed in range(1000):
        low, high = fit_power_line(HEIGHT, _scattered(seed), name="x").band(0.05, 0.9)
        covered += bool(low < 0.04 * 0.05**-0.2 < high)
    # Three standard deviations of a binomial count.
    assert abs(covered - 900) < 29


@pytest.mark.parametrize(
    ("height", "damping", "reason"),
    [
        ([0.1, 0.2], [0.04, 0.05], "2 points"),
        ([0.1, 0.2, 0.3], [0.04, 0.0, 0.05], "above zero"),
        ([0.1, 0.1, 0.1], [0.04, 0.04, 0.05], "same height"),
        ([0.1, 0.1001, 0.1002], [0.01, 0.05, 0.09], "not damping: do the records have a zero offset"),
    ],
)
def test_points_without_a_line_are_refused(height: list[float], damping: list[float], reason: str) -> None:
    with pytest.raises(DampingEstimateError, match=f"side peaks: .*{reason}"):
        fit_power_line(height, damping, name="side peaks")


def test_a_confidence_is_between_0_and_1() -> None:
    with pytest.raises(DampingEstimateError, match="confidence"):
        fit_power_line(HEIGHT, _scattered(1), name="x").band(0.1, 95.0)
