"""Peaks against closed forms and the turning points located by the reference."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings, strategies as st

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, simulate
from pyjoystick.motion import find_peaks
from pyjoystick.support import FloatArray, ParameterError, SeriesError

DECAY, RATE = 0.8, 9.0


def damped_sine(time: FloatArray) -> tuple[FloatArray, FloatArray]:
    """exp(-decay*t)*cos(rate*t) and its derivative."""
    envelope = np.exp(-DECAY * time)
    value = envelope * np.cos(RATE * time)
    return value, -DECAY * value - RATE * envelope * np.sin(RATE * time)


def peaks_of_damped_sine(end: float) -> tuple[FloatArray, FloatArray]:
    """Times and values of its extrema after 0: tan(rate*t) = -decay/rate."""
    first = (math.pi - math.atan2(DECAY, RATE)) / RATE
    time = np.arange(first, end, math.pi / RATE)
    return time, damped_sine(time)[0]


def errors(spacing: float, *, with_derivative: bool) -> tuple[float, float]:
    """Largest errors in time and value of all peaks of 3 s, over several positions of the samples."""
    worst = [0.0, 0.0]
    for shift in np.linspace(0.0, spacing, 7):
        time = np.arange(shift, 3.0, spacing)
        value, derivative = damped_sine(time)
        found = find_peaks(time, value, derivative if with_derivative else None)
        exact_time, exact_value = peaks_of_damped_sine(float(time[-1]))
        inside = exact_time < time[-2]
        found = found.iloc[: int(np.sum(inside))]
        worst[0] = max(worst[0], float(np.max(np.abs(found["time"] - exact_time[inside]))))
        worst[1] = max(worst[1], float(np.max(np.abs(found["value"] - exact_value[inside]))))
    return worst[0], worst[1]


@pytest.mark.parametrize(
    ("with_derivative", "time_order", "value_order"), [(True, 3.0, 4.0), (False, 4.0, 5.0)]
)
def test_the_order_of_accuracy(with_derivative: bool, time_order: float, value_order: float) -> None:
    coarse = errors(0.02, with_derivative=with_derivative)
    fine = errors(0.005, with_derivative=with_derivative)
    assert math.log2(coarse[0] / fine[0]) / 2.0 == pytest.approx(time_order, abs=0.35)
    assert math.log2(coarse[1] / fine[1]) / 2.0 == pytest.approx(value_order, abs=0.35)
    assert fine[0] < 1e-5
    assert fine[1] < 1e-7


def test_all_peaks_are_found_in_order_with_their_signs() -> None:
    time = np.linspace(0.0, 3.0, 181)
    value, derivative = damped_sine(time)
    for found in (find_peaks(time, value, derivative), find_peaks(time, value)):
        exact_time, exact_value = peaks_of_damped_sine(3.0)
        assert list(found.columns) == ["time", "value", "sign"]
        np.testing.assert_array_equal(found["sign"], np.sign(exact_value))
        np.testing.assert_allclose(found["time"], exact_time, atol=1e-5)
        np.testing.assert_allclose(found["value"], exact_value, atol=1e-6)


@settings(max_examples=50, derandomize=True, deadline=None)
@given(st.lists(st.floats(0.2, 1.0), min_size=60, max_size=60), st.floats(-0.5, 0.5))
def test_uneven_samples_of_a_parabola_give_its_vertex(gaps: list[float], vertex: float) -> None:
    time = np.cumsum(gaps)
    time -= time[30]
    value = 3.0 - 0.001 * (time - vertex) ** 2
    for derivative in (None, -0.002 * (time - vertex)):
        found = find_peaks(time, value, derivative)
        assert found["sign"].tolist() == [1]
        assert found["time"][0] == pytest.approx(vertex, abs=1e-8)
        assert found["value"][0] == pytest.approx(3.0, abs=1e-12)


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_displacement_peaks_are_the_turning_points_of_the_reference(parameters: JoystickParameters) -> None:
    """At 600 Hz, the rate of the paper's processed data, over its nine peaks.

    Measured: 3e-8 s and 1e-9 rad with omega, 9e-8 s and 4e-9 rad without it.
    """
    run = simulate(parameters, time=np.linspace(0.0, 0.8, 481), theta_start=math.radians(-20.0))
    turns = run.turning_points[:9]
    with_omega = find_peaks(run.time, run.theta, run.omega).iloc[:9]
    without = find_peaks(run.time, run.theta).iloc[:9]
    for found, time_error, value_error in ((with_omega, 1e-7, 3e-9), (without, 3e-7, 1e-8)):
        np.testing.assert_allclose(found["time"], [turn.time for turn in turns], atol=time_error)
        np.testing.assert_allclose(found["value"], [turn.theta for turn in turns], atol=value_error)


def test_velocity_peaks_are_found_although_kinks_surround_them() -> None:
    """One peak a half swing, within a sample of the largest |omega| of a run with 100 times as many."""
    coarse = simulate(NOMINAL, time=np.linspace(0.0, 0.8, 481), theta_start=math.radians(-20.0))
    fine = simulate(NOMINAL, time=np.linspace(0.0, 0.8, 48001), theta_start=math.radians(-20.0))
    ends = [0.0, *(turn.time for turn in fine.turning_points)]
    found = find_peaks(coarse.time, coarse.omega, coarse.alpha, minimum_prominence=0.2)
    for row, (start, end) in enumerate(pairwise(ends[:10])):
        swing = (fine.time >= start) & (fine.time <= end)
        top = int(np.argmax(np.abs(fine.omega[swing])))
        assert found["time"][row] == pytest.approx(fine.time[swing][top], abs=2e-3)
        assert found["value"][row] == pytest.approx(fine.omega[swing][top], abs=0.05)


def test_the_ends_are_no_peaks_and_a_straight_line_has_none() -> None:
    time = np.linspace(0.0, 1.0, 11)
    assert find_peaks(time, np.cos(time), -np.sin(time)).empty
    assert find_peaks(time, time).empty
    assert find_peaks(time, np.ones(11)).empty
    assert find_peaks(time, np.ones(11), np.zeros(11)).empty
    assert find_peaks([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])["time"].tolist() == [1.0]


def test_only_extrema_that_point_away_from_zero_count() -> None:
    """2 + cos(t) swings on one side of zero: its minima are no peaks."""
    time = np.linspace(0.0, 20.0, 401)
    found = find_peaks(time, 2.0 + np.cos(time), -np.sin(time))
    np.testing.assert_allclose(found["time"], 2.0 * math.pi * np.arange(1, 4), atol=1e-6)
    assert set(found["sign"]) == {1}
    below = find_peaks(time, -2.0 - np.cos(time))
    assert set(below["sign"]) == {-1}


@pytest.mark.parametrize("with_derivative", [True, False])
def test_a_plateau_is_one_peak_in_its_middle(with_derivative: bool) -> None:
    value = np.array([0.0, 1.0, 2.0, 2.0, 2.0, 2.0, 1.0, 0.0, -1.0, -2.0, -2.0, -2.0, -1.0])
    derivative = np.array([1.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0, 0.0, 0.0, 0.0, 1.0])
    found = find_peaks(np.arange(13.0), value, derivative if with_derivative else None)
    assert found["time"].tolist() == [3.5, 10.0]
    assert found["value"].tolist() == [2.0, -2.0]
    assert found["sign"].tolist() == [1, -1]


def test_two_equal_samples_at_the_top_are_no_plateau() -> None:
    time = np.arange(-4.5, 5.0)
    found = find_peaks(time, 10.0 - time**2)
    assert found["time"].tolist() == pytest.approx([0.0], abs=1e-12)
    assert found["value"].tolist() == pytest.approx([10.0], abs=1e-12)


def test_a_shelf_on_the_way_is_no_peak() -> None:
    assert find_peaks(np.arange(7.0), [0.0, 1.0, 2.0, 2.0, 2.0, 3.0, 4.0]).empty
    rising = find_peaks(
        np.arange(7.0), [0.0, 1.0, 2.0, 2.0, 2.0, 3.0, 4.0], [1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0]
    )
    assert rising.empty


def test_noise_needs_a_prominence_above_its_swing() -> None:
    """Noise of 1 % on the damped sine: every ripple is a peak, or with a prominence of 10 % each swing."""
    time = np.linspace(0.0, 2.0, 1201)
    value = damped_sine(time)[0] + 0.01 * np.random.default_rng(7).standard_normal(len(time))
    exact_time, exact_value = peaks_of_damped_sine(2.0)
    assert len(find_peaks(time, value)) > 100
    found = find_peaks(time, value, minimum_prominence=0.1)
    assert len(found) == len(exact_time)
    np.testing.assert_array_equal(found["sign"], np.sign(exact_value))
    np.testing.assert_allclose(found["time"], exact_time, atol=0.03)
    np.testing.assert_allclose(found["value"], exact_value, atol=0.04)


def test_noise_before_the_release_makes_no_peak() -> None:
    time = np.linspace(0.0, 1.2, 721)
    swing = np.where(time < 0.3, -1.0, -np.cos(RATE * (time - 0.3)))
    value = swing + 1e-3 * np.random.default_rng(3).standard_normal(len(time))
    found = find_peaks(time, value, minimum_prominence=0.1)
    assert found["sign"].tolist() == [1, -1]
    np.testing.assert_allclose(found["time"], 0.3 + np.array([1.0, 2.0]) * math.pi / RATE, atol=0.02)


def test_prominence_leaves_the_largest_of_the_ripples_on_a_swing() -> None:
    time = np.linspace(0.0, 2.0 * math.pi, 1001)
    value = 5.0 * np.sin(time) + 0.3 * np.sin(20.0 * time)
    assert len(find_peaks(time, value)) > 4
    for prominence in (0.7, 4.0):
        found = find_peaks(time, value, minimum_prominence=prominence)
        assert found["sign"].tolist() == [1, -1]
        np.testing.assert_allclose(found["value"], [np.max(value), np.min(value)], atol=1e-4)
    assert find_peaks(time, value, minimum_prominence=11.0).empty


def test_small_peaks_can_be_left_out() -> None:
    time = np.linspace(0.0, 3.0, 301)
    value, derivative = damped_sine(time)
    everything = find_peaks(time, value, derivative)
    tall = find_peaks(time, value, derivative, minimum_height=0.3)
    expected = everything[everything["value"].abs() >= 0.3]
    assert 0 < len(tall) < len(everything)
    pd.testing.assert_frame_equal(tall, expected)


@pytest.mark.parametrize("factor", [-1.0, math.degrees(1.0), math.radians(1.0)])
def test_the_derivative_is_that_of_the_value(factor: float) -> None:
    time = np.linspace(0.0, 1.0, 101)
    value, derivative = np.cos(20.0 * time), -20.0 * np.sin(20.0 * time)
    assert len(find_peaks(time, value, derivative)) == 6
    with pytest.raises(SeriesError, match="series 'derivative': is not that of value, which changes"):
        find_peaks(time, value, factor * derivative)
    with pytest.raises(SeriesError, match="series 'derivative': is not that of value"):
        find_peaks(time, derivative, value)


@pytest.mark.parametrize(
    ("time", "value", "derivative", "message"),
    [
        ([0.0, 1.0, 2.0], [0.0, math.nan, 0.0], None, "series 'value': is nan at index 1; must be finite"),
        ([0.0, 1.0, 2.0], [0.0, 1.0, 0.0], [0.0, 1.0, math.inf], "series 'derivative': is inf at index 2"),
        ([0.0, 2.0, 1.0], [0.0, 1.0, 0.0], None, r"series 'time': must increase; index 2 is 1\.0 after 2\.0"),
        ([0.0, 1.0, 1.0], [0.0, 1.0, 0.0], None, "series 'time': must increase; index 2"),
        ([0.0, 1.0], [0.0, 1.0], None, "series 'time': has 2 samples; at least 3 are needed"),
        ([], [], None, "at least 3 are needed"),
        ([0.0, 1.0, 2.0], [0.0, 1.0], None, "series 'value': has 2 samples, time has 3"),
        ([0.0, 1.0, 2.0], [0.0, 1.0, 0.0], [1.0], "series 'derivative': has 1 samples, time has 3"),
        (
            [[0.0, 1.0, 2.0]],
            [0.0, 1.0, 0.0],
            None,
            r"series 'time': must be one-dimensional, has the shape \(1, 3\)",
        ),
        ([0.0, 1.0, 2.0], ["a", "b", "c"], None, "series 'value': must hold numbers only"),
    ],
)
def test_unusable_series_are_refused_by_name(time: Any, value: Any, derivative: Any, message: str) -> None:
    with pytest.raises(SeriesError, match=message):
        find_peaks(time, value, derivative)


@pytest.mark.parametrize("name", ["minimum_height", "minimum_prominence"])
def test_limits_are_checked(name: str) -> None:
    limits: dict[str, Any] = {name: -1.0}
    with pytest.raises(ParameterError, match=f"^{name} = -1.0: must be a finite number, 0 or more$"):
        find_peaks([0.0, 1.0, 2.0], [0.0, 1.0, 0.0], **limits)


def test_the_unit_of_the_value_is_that_of_the_table() -> None:
    time = np.linspace(0.0, 1.0, 101)
    theta, omega = damped_sine(time)
    table = pd.DataFrame({"theta": theta, "omega": omega}, index=time)
    assert find_peaks(time, theta).attrs["units"] == {"time": "s"}
    table.attrs["units"] = {"time": "s", "theta": "rad", "omega": "rad/s"}
    assert find_peaks(table.index, table["theta"], table["omega"]).attrs["units"] == {
        "time": "s",
        "value": "rad",
    }


def test_a_peak_where_the_slope_only_touches_zero() -> None:
    """The cubic 7.87*(1 - (1 - t)^3)/3 and a slope at its end that rounding errors make negative."""
    slope = [7.87, -1.3e-32, -7.87]
    found = find_peaks(np.array([0.0, 1.0, 2.0]), np.array([0.0, 7.87 / 3.0, 0.0]), np.array(slope))
    assert found["time"].tolist() == pytest.approx([1.0], abs=1e-6)
    assert found["value"].tolist() == pytest.approx([7.87 / 3.0], rel=1e-12)
