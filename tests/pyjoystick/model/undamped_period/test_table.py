"""Tables of periods, and their agreement with the paper's main finding."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from pyjoystick.model import (
    NOMINAL,
    LineOscillator,
    LineSide,
    RestrainedSpring,
    decaying_periods,
    exponent,
    period_table,
    plot_periods,
    undamped_oscillation,
)
from pyjoystick.motion import find_peaks
from pyjoystick.runs import reference_free_oscillation

RELEASES = np.radians(np.geomspace(0.25, 20.0, 40))


def test_a_row_is_one_oscillation() -> None:
    row = period_table(NOMINAL, [math.radians(-10.0)]).iloc[0]
    found = undamped_oscillation(NOMINAL, math.radians(-10.0))
    assert row["period"] == found.period
    assert row["amplitude"] == (found.forward + found.backward) / 2.0
    assert row["linearized"] == pytest.approx(row["period"], rel=0.01)
    assert row["clearance"] + row["steep"] + row["soft"] == pytest.approx(1.0, rel=1e-14)


def test_the_exponent_lies_between_that_of_a_spring_and_of_a_constant_force() -> None:
    table = period_table(NOMINAL, RELEASES)
    slopes = exponent(table)[np.degrees(table["amplitude"]).between(1.0, 5.0).to_numpy()]
    assert len(slopes) > 5
    assert np.all((slopes > 0.4) & (slopes < 0.5))


def test_the_exponent_of_a_power_law_is_its_exponent() -> None:
    spring = LineSide.of_spring(RestrainedSpring(k_s=1e-6, k_h=1e15, F_0=40.0, x_0=0.0))
    releases = np.geomspace(1e-3, 1e-2, 5)
    oscillator = LineOscillator(0.5, spring, spring)
    table = period_table(NOMINAL, RELEASES[:5])
    table["amplitude"] = releases
    table["period"] = [oscillator.oscillation(release).period for release in releases]
    assert exponent(table) == pytest.approx(np.full(5, 0.5), rel=1e-6)


def test_a_damped_oscillation_has_the_undamped_periods_of_its_amplitudes() -> None:
    run = reference_free_oscillation(math.radians(-20.0))
    damped = decaying_periods(find_peaks(run.index, run["theta"], run["omega"]))
    table = period_table(NOMINAL, RELEASES)
    expected = np.interp(damped["amplitude"], table["amplitude"], table["period"])
    assert len(damped) > 10
    assert damped["period"].to_numpy() == pytest.approx(expected, rel=0.02)


def test_the_legend_covers_no_panel() -> None:
    table = period_table(NOMINAL, RELEASES)
    figure = plot_periods(table, {"decaying": (table[["amplitude", "period"]], "C0")}, title="Title")
    FigureCanvasAgg(figure).draw()  # type: ignore[no-untyped-call]
    legend = figure.legends[0].get_window_extent()
    assert not any(legend.overlaps(axes.get_window_extent()) for axes in figure.axes)
    assert figure.axes[1].get_xlabel() == "Amplitude, mean of both sides (deg)"
    assert figure.axes[0].get_ylabel() == "Period (ms)"
