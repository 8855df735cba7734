from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from pyjoystick.motion import peaks_of_run
from pyjoystick.motion.release_peaks import PeakPairingError, _first_peaks, average_peaks
from tests.pyjoystick.releases import linear_release, linear_run, peak_table

J = 0.01135


def test_peaks_of_a_run_against_the_closed_form() -> None:
    """A linear joystick; cubics between samples h apart are good to h^4 in value and h^3 in time."""
    start, frequency, damping = 2.0, 30.0, 0.045
    peaks = peaks_of_run(linear_run(J, damping, frequency, start=start), name="one")
    expected = linear_release(J, damping, frequency, start=start)
    assert (peaks.name, peaks.release_time, peaks.release_angle) == ("one", start, pytest.approx(-0.3))
    for series in ("displacement", "velocity"):
        found, exact = getattr(peaks, series)[:10], getattr(expected, series)[:10]
        assert found["sign"].tolist() == exact["sign"].tolist()
        np.testing.assert_allclose(found["time"], exact["time"], rtol=0.0, atol=1e-7)
        np.testing.assert_allclose(found["value"], exact["value"], rtol=1e-7)


def test_peaks_of_a_run_are_where_its_own_derivatives_change_their_sign() -> None:
    """Derivatives that lag by two samples move the peaks by as much."""
    run = linear_run(J, 0.045, 30.0)
    lagging = run.assign(omega=run["omega"].shift(2, fill_value=0.0))
    moved = peaks_of_run(lagging).displacement["time"] - peaks_of_run(run).displacement["time"]
    assert moved.to_numpy()[:9] == pytest.approx(2e-3, abs=1e-3)
    lagging = run.assign(alpha=run["alpha"].shift(2, fill_value=run["alpha"].iloc[0]))
    moved = peaks_of_run(lagging).velocity["time"] - peaks_of_run(run).velocity["time"]
    assert moved.to_numpy()[:9] == pytest.approx(2e-3, abs=1e-3)


def test_times_are_averaged_from_the_release() -> None:
    trials = [linear_release(J, c, 30.0, start=start) for c, start in ((0.04, 1.0), (0.05, 7.0))]
    average = average_peaks(trials)
    assert average.name == "average of 2"
    assert (average.release_time, average.release_angle) == (0.0, pytest.approx(-0.3))
    assert (len(average.displacement), len(average.velocity)) == (9, 10)
    assert average.displacement["time"].to_numpy() == pytest.approx(np.arange(1, 10) * math.pi / 30.0)
    expected = [trial.velocity["value"][:10] for trial in trials]
    assert average.velocity["value"].to_numpy() == pytest.approx(np.mean(expected, axis=0))
    assert average.displacement["sign"].tolist() == [1, -1, 1, -1, 1, -1, 1, -1, 1]


def test_a_trial_with_too_few_peaks_is_named() -> None:
    short = linear_release(J, 0.045, 30.0, name="short")
    short = dataclasses.replace(short, velocity=short.velocity[:8])
    with pytest.raises(PeakPairingError, match="short: velocity peak 9 is missing; 10 are needed") as caught:
        average_peaks([linear_release(J, 0.045, 30.0), short])
    assert (caught.value.series, caught.value.number) == ("velocity", 9)
    assert len(average_peaks([short], velocity_peaks=8).velocity) == 8


def test_a_trial_from_the_other_side_is_named() -> None:
    trial = linear_release(J, 0.045, 30.0)
    mirrored = peak_table(trial.displacement["time"], -trial.displacement["value"])
    other = dataclasses.replace(trial, name="other", displacement=mirrored)
    with pytest.raises(PeakPairingError, match="other: displacement peak 1 lies on the opposite side"):
        average_peaks([trial, other])


def test_first_peaks_count_from_the_release() -> None:
    first = _first_peaks(linear_release(J, 0.045, 30.0, start=5.0), "displacement", 2)
    assert first["time"].tolist() == pytest.approx([math.pi / 30.0, math.pi / 15.0])
