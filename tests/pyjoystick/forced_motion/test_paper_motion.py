"""What section 5 says, as numbers, and the tables and figures made of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from pyjoystick.forced_motion import (
    MOTION,
    Demand,
    Samples,
    measures_report,
    plot_torque,
    section_5,
    torque_by_reference,
    torque_table,
)
from pyjoystick.forced_motion.figures import plot_demands
from pyjoystick.forced_motion.paper_motion import measures_of
from pyjoystick.forced_motion.reports import demand_report
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.support import ParameterError

DEMAND = Demand(
    levels=np.linspace(0.0, 2.66, 101),
    positive_work=0.3,
    negative_work=-0.25,
    impulse=0.5,
    time=0.6,
    arm=0.266,
)


def test_the_quick_stroke_fits_the_paper_but_for_the_damping_ratio() -> None:
    found = section_5()
    assert found.inertia_to_stiffness == pytest.approx(0.65, abs=0.01)
    assert found.damping_to_total["constant"] == pytest.approx(0.079, abs=0.001)
    assert found.damping_to_total["power-law"] == pytest.approx(0.120, abs=0.001)
    assert found.damping_ratio == pytest.approx(1.55, abs=0.01)


def test_a_falling_coefficient_would_double_the_damping() -> None:
    """Section 3.3 calls the slopes of Fig. 9 negative; n_pos is printed as positive."""
    falling = section_5(power_law=NOMINAL_POWER_LAW.replace({"damping.n_pos": -0.084}))
    assert falling.damping_ratio == pytest.approx(2.09, abs=0.01)


def test_slow_strokes_do_not_fit() -> None:
    slow = section_5(replace(MOTION, rise=0.3))
    assert slow.inertia_to_stiffness < 0.12
    assert slow.damping_to_total["constant"] < 0.05


def test_sampled_motions_give_the_same() -> None:
    found = section_5(Samples.evenly(MOTION, 1e-4))
    assert found.loss_ratio == pytest.approx(section_5().loss_ratio, rel=1e-6)


def test_the_reports_have_the_numbers() -> None:
    found = measures_of(MOTION, NOMINAL, NOMINAL_POWER_LAW)
    text = measures_report(found)
    assert f"{found['constant'].total.highest:.3f}" in text
    assert f"{1e3 * found['power-law'].loss:.2f}" in text
    assert "| damping, power-law" in text
    row = demand_report({"one": DEMAND}, moves=1000).splitlines()[-1]
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert cells == ["one", "1.00", "5.00", "9.00", "9.90", "10.00", "2.66", "0.300", "-0.250", "0.30", "2"]


def test_the_figure_has_the_panels_of_fig_15() -> None:
    samples = Samples.evenly(MOTION, 1e-3)
    laws = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}
    tables = {law: torque_table(samples, torque_by_reference(one, samples)) for law, one in laws.items()}
    figure = plot_torque(tables)  # type: ignore[arg-type]
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
