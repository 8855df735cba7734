"""Tables and figures of torques and demands."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from pyjoystick.forced_motion import (
    Demand,
    ForwardAndReturn,
    Samples,
    measure,
    measures_report,
    plot_torque,
    torque_by_reference,
)
from pyjoystick.forced_motion.figures import plot_demands
from pyjoystick.forced_motion.reports import demand_report
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, LawName
from pyjoystick.support import ParameterError

MOTION = ForwardAndReturn(amplitude=math.radians(18.0), rise=0.12, rest=0.3)
LAWS: dict[LawName, JoystickParameters] = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}
DEMAND = Demand(
    levels=np.linspace(0.0, 2.66, 101),
    positive_work=0.3,
    negative_work=-0.25,
    impulse=0.5,
    time=0.6,
    pivot_to_handle=0.266,
)


def test_the_reports_have_the_numbers() -> None:
    samples = Samples.evenly(MOTION, 1e-3)
    found = {law: measure(one, samples, torque_by_reference(one, samples)) for law, one in LAWS.items()}
    text = measures_report(found)
    assert f"{found['constant'].total.highest:.3f}" in text
    assert f"{1e3 * found['power-law'].loss:.2f}" in text
    assert "| damping, power-law" in text
    row = demand_report({"one": DEMAND}, moves=1000).splitlines()[-1]
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert cells == ["one", "1.00", "5.00", "9.00", "9.90", "10.00", "2.66", "0.300", "-0.250", "0.30", "2"]


def test_the_figure_has_the_panels_of_fig_15() -> None:
    samples = Samples.evenly(MOTION, 1e-3)
    tables = {law: torque_by_reference(one, samples) for law, one in LAWS.items()}
    figure = plot_torque(tables)
    FigureCanvasAgg(figure).draw()
    stiffness, damping, inertia, total = figure.axes
    assert [len(axes.get_lines()) for axes in figure.axes] == [2, 3, 2, 3]  # and a line at zero each
    assert stiffness.get_ylim() == inertia.get_ylim() == total.get_ylim() != damping.get_ylim()
    np.testing.assert_array_equal(damping.get_lines()[1].get_ydata(), tables["power-law"]["T_damping"])
    (legend,) = figure.legends
    assert legend.get_window_extent().y0 > damping.get_window_extent().y1
    with pytest.raises(ParameterError, match="tables"):
        plot_torque({})


def test_the_figure_of_the_load() -> None:
    figure = plot_demands({"Preload": {"as it is": DEMAND}, "Speed": {"a": DEMAND, "b": DEMAND}})
    FigureCanvasAgg(figure).draw()
    assert [len(axes.get_lines()) for axes in figure.axes] == [1, 2]
    assert figure.axes[0].get_lines()[0].get_xdata()[-1] == pytest.approx(10.0)
    with pytest.raises(ParameterError, match="groups"):
        plot_demands({})
