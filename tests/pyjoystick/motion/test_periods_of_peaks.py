"""The period around each peak."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from pyjoystick.motion import find_peaks, periods
from pyjoystick.runs import reference_free_oscillation

PEAKS = pd.DataFrame({"time": [1.0, 2.5, 3.5, 4.0], "value": [4.0, -3.0, 2.0, -1.0], "sign": [1, -1, 1, -1]})


def test_the_span_from_the_peak_before_to_the_peak_after() -> None:
    table = periods(PEAKS)
    assert table["time"].tolist() == [2.5, 3.5]
    assert table["amplitude"].tolist() == [3.0, 2.0]
    assert table["period"].tolist() == [2.5, 1.5]


def test_the_release_counts_as_the_peak_before_the_first() -> None:
    table = periods(PEAKS, release_time=0.25)
    assert table["time"].tolist() == [1.0, 2.5, 3.5]
    assert table["amplitude"].tolist() == [4.0, 3.0, 2.0]
    assert table["period"].tolist() == [2.25, 2.5, 1.5]


def test_too_few_peaks_have_no_period() -> None:
    for count in (0, 1, 2):
        assert periods(PEAKS[:count]).empty
    assert periods(PEAKS[:0], release_time=0.0).empty
    assert periods(PEAKS[:1], release_time=0.0).empty


def test_the_period_of_a_sine_is_its_own() -> None:
    time = np.linspace(0.0, 3.0, 3001)
    wave = np.cos(2.0 * math.pi * time / 0.4)
    found = periods(find_peaks(time, wave), release_time=0.0)
    np.testing.assert_allclose(found["period"], 0.4, rtol=1e-6)


def test_the_joysticks_period_falls_with_its_amplitude() -> None:
    motion = reference_free_oscillation(math.radians(-20.0), duration=1.0)
    found = periods(find_peaks(motion.index, motion["theta"], motion["omega"]), release_time=0.0)
    # The two sides differ, so amplitudes are compared side by side with their own.
    assert len(found) > 8
    assert (np.diff(found["period"]) < 0.0).all()
    assert (np.diff(found["amplitude"][::2]) < 0.0).all()
