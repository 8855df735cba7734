"""Figures of a fit."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from pyjoystick.identification import CONSTANT_DAMPING, Fit, Free, fit, save_figures
from pyjoystick.identification.fitting.figures import (
    plot_correlation,
    plot_profiles,
    plot_records,
    plot_residuals,
)
from pyjoystick.model import NOMINAL
from tests.pyjoystick.identification.fitting.made import releases


@pytest.fixture
def found(fmus_by_name: Path) -> Fit:
    settings = dataclasses.replace(
        CONSTANT_DAMPING, free=(*CONSTANT_DAMPING.free, Free("forward.returnSpring.F_0"))
    )
    return fit(releases(NOMINAL, 2, noise=math.radians(0.1)), settings)


def _legend(figure: Figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_records_beside_their_fit(found: Fit) -> None:
    figure = plot_records(found)
    assert [axes.get_title("left") for axes in figure.axes] == ["run 0", "run 1"]
    assert figure.axes[-1].get_xlabel() == "Time (s)"
    assert all(axes.get_ylabel() == "theta (deg)" for axes in figure.axes)
    dots, line = figure.axes[0].lines
    assert list(dots.get_ydata()) == pytest.approx([math.degrees(x) for x in found.records[0].data])
    times = np.asarray(line.get_xdata())
    assert np.diff(times).max() <= 1.0001e-3
    at_samples = np.interp(found.records[0].times, times, np.asarray(line.get_ydata()))
    assert at_samples == pytest.approx(np.degrees(found.records[0].predicted), abs=2e-3)
    assert _legend(figure) == ["measured", "fit"]


def test_the_motion_has_a_gap_where_samples_are_missing(fmus_by_name: Path) -> None:
    whole = releases(NOMINAL, noise=math.radians(0.1))[0]
    kept = np.ones(len(whole.time), dtype=bool)
    kept[40:46] = False
    one = dataclasses.replace(whole, time=whole.time[kept], theta=whole.theta[kept], rows=whole.rows[kept])
    curve = fit([one], CONSTANT_DAMPING).records[0].curve
    assert curve is not None
    missing = curve.index[curve["theta"].isna()].to_numpy()
    before, after = whole.time[39], whole.time[46]
    assert before < missing[0] < before + 2e-3
    assert after - 2e-3 < missing[-1] < after
    assert len(missing) == pytest.approx((after - before) / 1e-3, abs=2)


def test_long_names_of_records_take_little_room(found: Fit) -> None:
    names = [f"2026-11-19_subject_7_right_hand_release_{number}" for number in (1, 2)]
    records = tuple(
        dataclasses.replace(one, name=name) for one, name in zip(found.records, names, strict=True)
    )
    long = dataclasses.replace(found, records=records)
    assert max(len(text.get_text()) for text in plot_correlation(long).axes[0].get_yticklabels()) < 30
    figure = plot_residuals(long)
    figure.draw_without_rendering()
    legend, axes = figure.legends[0].get_window_extent(), figure.axes[0].get_window_extent()
    assert legend.width < figure.bbox.width
    assert axes.height > 0.6 * figure.bbox.height


def test_residuals_in_standard_deviations(found: Fit) -> None:
    figure = plot_residuals(found)
    first = figure.axes[0].lines[0]
    one = found.records[0]
    assert list(first.get_ydata()) == pytest.approx(list(one.residuals() / one.sigma["theta"]))
    assert _legend(figure) == ["run 0", "run 1"]


def test_profiles_reach_the_level(found: Fit) -> None:
    figure = plot_profiles(found)
    labels = [axes.get_xlabel() for axes in figure.axes]
    assert labels == ["damping.C (N.m.s/rad)", "forward.returnSpring.F_0 (N)"]
    assert _legend(figure) == ["profile", "linear", "95 %"]
    for axes in figure.axes:
        assert max(axes.lines[0].get_ydata()) > found.standard_errors.quantile


def test_correlations_are_written_into_their_cells(found: Fit) -> None:
    figure = plot_correlation(found)
    assert len(figure.axes[0].texts) == len(found.variables) ** 2
    assert figure.axes[0].texts[0].get_text() == "1.00"


def test_peaks_are_dots_and_crosses(fmus_by_name: Path, tmp_path: Path) -> None:
    settings = dataclasses.replace(CONSTANT_DAMPING, comparison="peaks")
    found = fit(releases(NOMINAL, noise=math.radians(0.1)), settings)
    dots, crosses = plot_records(found).axes[0].lines
    assert (dots.get_marker(), crosses.get_marker()) == (".", "x")
    assert len(dots.get_ydata()) == len(crosses.get_ydata()) == 9
    names = [path.name for path in save_figures(found, tmp_path)]
    assert names == ["records.png", "residuals.png", "correlation.png", "profiles.png"]
    assert all((tmp_path / name).stat().st_size > 5000 for name in names)
