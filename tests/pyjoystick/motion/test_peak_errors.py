from __future__ import annotations

import dataclasses

import pytest

from pyjoystick.motion import ReleasePeaks, minima, peak_errors, sweep_peak_errors
from pyjoystick.motion.release_peaks import PeakPairingError
from tests.pyjoystick.releases import linear_release, peak_table

J = 0.01135


def _release(times: list[float], values: list[float], start: float, name: str) -> ReleasePeaks:
    table = peak_table([start + time for time in times], values)
    return ReleasePeaks(name=name, release_time=start, release_angle=-0.3, displacement=table, velocity=table)


MEASURED = _release([0.2, 0.5, 0.7], [0.2, -0.1, 0.05], 3.0, "measured")


def test_eqs_12_by_hand() -> None:
    """Different clocks, magnitudes in the denominator, the release as the peak before the first."""
    simulated = _release([0.21, 0.47, 0.70], [0.21, -0.08, 0.05], 0.0, "simulated")
    errors = peak_errors(simulated, MEASURED, displacement_peaks=3, velocity_peaks=2)
    assert errors.displacement == pytest.approx(100.0 / 3.0 * (0.01 / 0.2 + 0.02 / 0.1))
    assert errors.displacement_time == pytest.approx(100.0 / 3.0 * (0.01 / 0.2 + 0.03 / 0.3))
    assert errors.velocity == pytest.approx(100.0 / 2.0 * (0.01 / 0.2 + 0.02 / 0.1))
    assert errors.velocity_time == pytest.approx(100.0 / 2.0 * (0.01 / 0.2 + 0.03 / 0.3))


def test_the_paper_counts_nine_and_ten() -> None:
    one, other = linear_release(J, 0.045, 30.0), linear_release(J, 0.045, 30.0, start=0.0)
    assert dataclasses.astuple(peak_errors(one, other)) == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-10)
    tenth = other.displacement.copy()
    tenth.loc[9, "value"] = 5.0
    assert peak_errors(dataclasses.replace(one, displacement=tenth), other).displacement < 1e-9
    for series, count in (("displacement", 9), ("velocity", 10)):
        short = dataclasses.replace(one, **{series: getattr(one, series)[: count - 1]})
        with pytest.raises(PeakPairingError, match=f"linear: {series} peak {count} is missing"):
            peak_errors(short, other)


def test_peaks_of_other_signs_are_not_paired() -> None:
    simulated = _release([0.21, 0.47, 0.70], [0.21, -0.08, -0.05], 0.0, "simulated")
    with pytest.raises(PeakPairingError, match="simulated: displacement peak 3 lies on the opposite side"):
        peak_errors(simulated, MEASURED, displacement_peaks=3, velocity_peaks=2)


def test_a_sweep_finds_the_value_that_made_the_data() -> None:
    measured = linear_release(J, 0.045, 30.0)
    values = [0.02, 0.03, 0.045, 0.06]
    sweep = sweep_peak_errors(values, lambda c: linear_release(J, c, 30.0, start=0.0), measured)
    assert sweep.index.tolist() == values
    assert sweep.columns.tolist() == ["displacement", "displacement_time", "velocity", "velocity_time"]
    assert sweep.loc[0.03, "displacement"] > 10.0
    least = minima(sweep)
    assert least.loc["displacement", "at"] == 0.045
    assert least.loc["velocity", "error"] == pytest.approx(0.0, abs=1e-10)
