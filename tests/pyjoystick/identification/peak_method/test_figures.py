from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from pyjoystick.identification import DampingEstimate, estimate_damping, plot_damping_estimate
from pyjoystick.identification.peak_method.figures import plot_peak_errors
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError
from tests.pyjoystick.releases import reference_release


@pytest.fixture(scope="module")
def estimate() -> DampingEstimate:
    return estimate_damping([reference_release(NOMINAL, math.radians(-20.0))], NOMINAL.J)


def test_points_lines_and_bands_of_fig_9(estimate: DampingEstimate) -> None:
    figure = plot_damping_estimate(estimate, constant=0.045, title="Fig. 9")
    angle, velocity = figure.axes
    assert (angle.get_xscale(), angle.get_yscale()) == ("log", "log")
    assert "(deg)" in angle.get_xlabel()
    assert "(deg/s)" in velocity.get_xlabel()
    by_label = {str(line.get_label()): line for line in angle.lines}
    positive = estimate.displacement[estimate.displacement["peak"] > 0.0]
    points = by_label["positive peaks"]
    np.testing.assert_allclose(np.asarray(points.get_xdata()), np.degrees(positive["peak"]))
    np.testing.assert_array_equal(points.get_ydata(), positive["C"])
    drawn = by_label["line, positive peaks"]
    height = np.radians(np.asarray(drawn.get_xdata(), dtype=np.float64))
    np.testing.assert_allclose(np.asarray(drawn.get_ydata()), estimate.lines["positive"].at(height))
    both = next(line for line in velocity.lines if line.get_label() == "line, both signs")
    height = np.radians(np.asarray(both.get_xdata(), dtype=np.float64))
    np.testing.assert_allclose(np.asarray(both.get_ydata()), estimate.lines["velocity"].at(height))
    legend = [text.get_text() for text in figure.legends[0].get_texts()]
    drawn_lines = {str(line.get_label()) for axes in figure.axes for line in axes.lines}
    assert set(legend) == drawn_lines
    assert len(legend) == len(drawn_lines) == 6
    assert [len(axes.collections) for axes in figure.axes] == [2, 1]
    assert [line.get_ydata()[0] for line in (angle.lines[-1], velocity.lines[-1])] == [0.045, 0.045]


def test_the_minima_of_fig_11_are_marked() -> None:
    index = [0.02, 0.04, 0.06]
    columns = ("displacement", "displacement_time", "velocity", "velocity_time")
    sweep = pd.DataFrame({name: [9.0, 2.0 + k, 7.0] for k, name in enumerate(columns)}, index=index)
    figure = plot_peak_errors({"alpha": sweep, "C": 2.0 * sweep}, largest=30.0)
    assert [axes.get_xlabel() for axes in figure.axes] == ["alpha", "C"]
    marked = [line for line in figure.axes[1].lines if line.get_marker() == "o"]
    found = sorted((float(line.get_xdata()[0]), float(line.get_ydata()[0])) for line in marked)
    assert found == [(0.04, 4.0), (0.04, 6.0), (0.04, 8.0), (0.04, 10.0)]
    assert figure.axes[0].get_ylim() == (0.0, 30.0)


def test_no_sweep_is_refused() -> None:
    with pytest.raises(ParameterError, match="sweeps"):
        plot_peak_errors({})
