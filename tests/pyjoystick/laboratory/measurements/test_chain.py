from __future__ import annotations

import numpy as np
import pytest
from scipy import signal

from pyjoystick.laboratory import Chain, LowPass, derivative
from pyjoystick.laboratory.measurements.chain import weights
from pyjoystick.laboratory.measurements.resampling import resample
from pyjoystick.support import ParameterError, SeriesError

RATE = 600.0


def _amplitude_and_phase(low_pass: LowPass, frequency: float) -> tuple[float, float]:
    """Measured on a sine, away from the ends, by least squares."""
    time = np.arange(int(8.0 * RATE)) / RATE
    sine, cosine = np.sin(2.0 * np.pi * frequency * time), np.cos(2.0 * np.pi * frequency * time)
    filtered = low_pass.filter(sine, RATE)
    inner = slice(1200, -1200)
    (a, b), *_ = np.linalg.lstsq(np.stack((sine[inner], cosine[inner]), axis=1), filtered[inner], rcond=None)
    return float(np.hypot(a, b)), float(np.arctan2(b, a))


@pytest.mark.parametrize(
    "low_pass",
    [
        LowPass(),
        LowPass(corrected=True),
        LowPass(20.0, 2),
        LowPass(20.0, 1),
        LowPass(20.0, 1, corrected=True),
    ],
)
@pytest.mark.parametrize("frequency", [2.0, 8.0, 11.64, 13.0, 17.0, 26.0])
def test_both_runs_have_the_stated_response_and_zero_phase(low_pass: LowPass, frequency: float) -> None:
    amplitude, phase = _amplitude_and_phase(low_pass, frequency)
    expected = float(low_pass.response(np.array(frequency), RATE))
    assert amplitude == pytest.approx(expected, rel=1e-6)
    assert phase == pytest.approx(0.0, abs=1e-6)


def test_the_amplitude_falls_like_an_eighth_order_and_is_not_that_of_a_butterworth_of_order_eight() -> None:
    low, high = (_amplitude_and_phase(LowPass(), f)[0] for f in (26.0, 52.0))
    assert np.log2(low / high) == pytest.approx(8.0, abs=0.3)  # 48 dB an octave; tan() bends it a little
    once = signal.sosfreqz(signal.butter(4, 13.0, fs=RATE, output="sos"), worN=[13.0], fs=RATE)[1]
    assert _amplitude_and_phase(LowPass(), 13.0)[0] == pytest.approx(abs(once[0]) ** 2, rel=1e-6)
    assert _amplitude_and_phase(LowPass(), 13.0)[0] == pytest.approx(0.5, rel=1e-6)


def test_where_minus_3_db_is_and_the_cutoff_that_puts_it_at_13_hz() -> None:
    half_power = LowPass().half_power_frequency(RATE)
    assert half_power == pytest.approx(11.65, abs=0.01)
    assert _amplitude_and_phase(LowPass(), half_power)[0] == pytest.approx(np.sqrt(0.5), rel=1e-6)
    corrected = LowPass(corrected=True)
    assert corrected.design_cutoff(RATE) == pytest.approx(14.50, abs=0.01)
    assert corrected.half_power_frequency(RATE) == pytest.approx(13.0, rel=1e-12)
    assert _amplitude_and_phase(corrected, 13.0)[0] == pytest.approx(np.sqrt(0.5), rel=1e-6)


def test_the_filter_leaves_straight_lines_alone_up_to_the_ends() -> None:
    line = np.linspace(-1.0, 2.0, 500)
    np.testing.assert_allclose(LowPass().filter(line, RATE), line, atol=1e-6)


@pytest.mark.parametrize(("order", "cutoff"), [(1, 13.0), (4, 13.0), (4, 290.0)])
def test_ends_are_prolonged_by_six_periods_or_by_what_there_is(order: int, cutoff: float) -> None:
    """Of a shorter series, which may have as few samples as the order needs."""
    values = np.random.default_rng(1).standard_normal(700)
    sections = signal.butter(order, cutoff, fs=RATE, output="sos")
    for count in (2 * order + 2, 40, 700):
        padding = min(count - 1, int(np.ceil(6.0 * RATE / cutoff)))
        expected = signal.sosfiltfilt(sections, values[:count], padlen=padding)
        np.testing.assert_array_equal(LowPass(cutoff, order).filter(values[:count], RATE), expected)
    with pytest.raises(
        SeriesError, match=f"has {2 * order + 1} samples, at least {2 * order + 2} are needed"
    ):
        LowPass(cutoff, order).filter(values[: 2 * order + 1], RATE)


def test_the_cutoff_is_below_half_of_the_rate_and_the_order_at_most_ten() -> None:
    assert LowPass(cutoff=np.nextafter(12.0, 0.0), order=10).design_cutoff(24.0) < 12.0
    for method in ("design_cutoff", "half_power_frequency"):
        with pytest.raises(ParameterError, match="below half of the sampling rate"):
            getattr(LowPass(cutoff=12.0), method)(24.0)
    with pytest.raises(ParameterError, match="order = 11"):
        LowPass(order=11)
    with pytest.raises(ParameterError, match=r"cutoff = 0\.0"):
        LowPass(cutoff=0.0)


def test_what_the_filter_refuses() -> None:
    with pytest.raises(ParameterError, match="order = 0: must be a whole number from 1 to 10"):
        LowPass(order=0)
    with pytest.raises(
        ParameterError, match=r"cutoff = 13\.0: must be below half of the sampling rate, 12 Hz"
    ):
        LowPass().filter(np.zeros(50), 24.0)
    with pytest.raises(SeriesError, match="sample 3 is nan"):
        LowPass().filter(np.array([0.0, 0.0, 0.0, np.nan] * 5), RATE)
    with pytest.raises(SeriesError, match="has 5 samples, at least 10"):
        LowPass().filter(np.zeros(5), RATE)


def test_the_papers_rules_of_differentiation() -> None:
    np.testing.assert_allclose(weights((-2, -1, 0, 1, 2), 1), np.array([1, -8, 0, 8, -1]) / 12.0, atol=1e-15)
    np.testing.assert_allclose(weights((-1, 0, 1), 2), [1.0, -2.0, 1.0], atol=1e-15)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("points", [3, 5, 7])
def test_derivatives_converge_with_the_order_of_the_rule_even_at_the_ends(order: int, points: int) -> None:
    errors = []
    for count in (40, 80):
        time = np.linspace(0.0, 2.0, count + 1)
        exact = np.cos(time) if order == 1 else -np.sin(time)
        found = derivative(np.sin(time), 2.0 / count, order=order, points=points)
        errors.append(np.max(np.abs(found - exact)))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(points - 1, abs=0.35)


def test_what_derivatives_refuse() -> None:
    with pytest.raises(ParameterError, match="points = 4: must be 3, 5 or 7"):
        derivative(np.zeros(9), 1.0, order=1, points=4)
    with pytest.raises(ParameterError, match="order = 3"):
        derivative(np.zeros(9), 1.0, order=3, points=3)
    with pytest.raises(SeriesError, match="has 5 samples, more than 5"):
        derivative(np.zeros(5), 1.0, order=1, points=5)


def _camera(lost: slice) -> tuple[np.ndarray, np.ndarray]:
    time = np.arange(120) / 60.0
    theta = 0.3 * np.sin(2.0 * np.pi * 1.5 * time)
    theta[lost] = np.nan
    return time, theta


def test_the_spline_meets_the_samples_and_is_fourth_order_between_them() -> None:
    errors = []
    for rate in (60.0, 120.0):
        time = np.arange(int(2 * rate)) / rate
        even = resample(time, np.sin(9.0 * time), RATE, longest_gap=0.0)
        inner = slice(200, -200)
        errors.append(np.max(np.abs(even.values - np.sin(9.0 * even.time))[inner]))
        np.testing.assert_allclose(even.values[:: int(RATE / rate)], np.sin(9.0 * time), atol=1e-12)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.2)


@pytest.mark.parametrize(("lost", "bridged"), [(1, True), (2, True), (3, False), (10, False)])
def test_gaps_are_bridged_up_to_the_limit_and_marked_either_way(lost: int, bridged: bool) -> None:
    time, theta = _camera(slice(50, 50 + lost))
    even = resample(time, theta, RATE, longest_gap=0.05)
    inside = (even.time > time[49] + 1e-6) & (even.time < time[50 + lost] - 1e-6)
    assert np.isnan(even.values[inside]).all() == (not bridged)
    np.testing.assert_array_equal(even.bridged, inside & bridged)
    assert np.isfinite(even.values[~inside]).all()
    assert len(even.gaps) == (0 if bridged else 1)
    if not bridged:
        np.testing.assert_allclose(even.gaps[0], (time[49] + 1 / RATE, time[50 + lost] - 1 / RATE), atol=1e-9)


def test_what_lies_beyond_a_gap_does_not_touch_what_lies_before() -> None:
    time, theta = _camera(slice(50, 60))
    whole = Chain().run(time, theta)
    alone = Chain().run(time[:50], theta[:50])
    count = len(alone.time)
    for name in ("theta", "omega", "alpha"):
        np.testing.assert_array_equal(getattr(whole, name)[:count], getattr(alone, name))
    assert np.isnan(whole.omega[count : count + 50]).all()


def test_the_chain_on_a_sine_has_the_stated_response() -> None:
    time = np.arange(600) / 240.0
    for frequency in (2.0, 5.0, 9.0):
        chain = Chain()
        motion = chain.run(time, 0.2 * np.sin(2.0 * np.pi * frequency * time))
        inner = slice(400, -400)
        exact = 0.2 * 2.0 * np.pi * frequency * np.cos(2.0 * np.pi * frequency * motion.time)[inner]
        ratio = float(motion.omega[inner] @ exact / (exact @ exact))
        # The spline through 240 Hz adds less than 1e-4 up to 9 Hz.
        assert ratio == pytest.approx(float(chain.response(np.array(frequency))), abs=2e-4)


def test_what_the_chain_refuses() -> None:
    with pytest.raises(ParameterError, match="velocity_points = 4"):
        Chain(velocity_points=4)
    with pytest.raises(ParameterError, match=r"cutoff = 13\.0: must be below half"):
        Chain(rate=20.0)
    time, theta = np.arange(40) / 60.0, np.zeros(40)
    theta[2::3] = np.nan
    with pytest.raises(SeriesError, match="no stretch between gaps"):
        Chain(longest_gap=0.0).run(time, theta)
    with pytest.raises(SeriesError, match="at least 4 are needed"):
        Chain().run(np.arange(9) / 60.0, np.full(9, np.nan))


@pytest.mark.parametrize("start", [0.0, 7.3, -2.05])
def test_resampling_begins_and_ends_with_the_samples_wherever_the_clock_is(start: float) -> None:
    time = start + np.arange(61) / 60.0
    values = np.sin(9.0 * (time - start))
    values[[0, 60]] = np.nan  # lost frames at the ends are no samples
    even = resample(time, values, RATE, longest_gap=0.05)
    assert len(even.time) == 58 * 10 + 1
    np.testing.assert_allclose(even.time, time[1] + np.arange(581) / RATE, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(even.values, np.sin(9.0 * (even.time - start)), atol=2e-5)
    assert even.gaps == ()


def test_filters_of_the_lowest_and_the_highest_order() -> None:
    for order in (1, 10):
        low_pass = LowPass(order=order)
        for frequency in (6.0, 13.0, 20.0):
            ratio = np.tan(np.pi * frequency / RATE) / np.tan(np.pi * 13.0 / RATE)
            expected = 1.0 / (1.0 + ratio ** (2 * order))
            assert _amplitude_and_phase(low_pass, frequency)[0] == pytest.approx(expected, rel=1e-5)
    shortest = LowPass(order=1).filter(np.ones(4), RATE)
    np.testing.assert_allclose(shortest, 1.0, atol=1e-12)
    with pytest.raises(SeriesError, match="has 3 samples, at least 4"):
        LowPass(order=1).filter(np.ones(3), RATE)
    for order in (11, 2.0, True):
        with pytest.raises(ParameterError, match="a whole number from 1 to 10"):
            LowPass(order=order)  # type: ignore[arg-type]


def test_both_ends_are_prolonged_by_six_periods_of_the_cutoff() -> None:
    """So that what the filter remembers of its start has died away: as with ends prolonged by far more."""
    time = np.arange(3000) / RATE
    values = np.cos(2.0 * np.pi * 0.7 * time) + 0.3 * time
    sections = signal.butter(4, 13.0, fs=RATE, output="sos")
    far = signal.sosfiltfilt(sections, values, padlen=2900)
    np.testing.assert_allclose(LowPass().filter(values, RATE), far, rtol=0.0, atol=1e-7)
