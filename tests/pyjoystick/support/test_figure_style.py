"""Style common to all figures: distinguishable colors, legends that cover nothing."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from pyjoystick.support import LAWS, SERIES, ParameterError, dress, figure_style, legend_above, line_style

#: What a viewer without one kind of cones sees, in linear RGB (Vienot, Brettel and Mollon, 1999).
DEUTERANOPE = np.array([[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]])
PROTANOPE = np.array([[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]])


def _linear(color: str) -> np.ndarray:
    rgb = np.array(to_rgb(color))
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("sight", [np.eye(3), DEUTERANOPE, PROTANOPE], ids=["all", "no green", "no red"])
@pytest.mark.parametrize(
    "colors",
    [
        [style["color"] for style in SERIES],
        [style["color"] for style in LAWS.values()],
        [figure_style.FORWARD, figure_style.BACKWARD],
        [figure_style.MEASURED, figure_style.FITTED, figure_style.BAND],
    ],
    ids=["series", "laws", "sides", "fit"],
)
def test_colors_of_one_panel_can_be_told_apart(colors: list[str], sight: np.ndarray) -> None:
    seen = [sight @ _linear(color) for color in colors]
    assert all(np.linalg.norm(a - b) > 0.1 for a, b in itertools.combinations(seen, 2))


def test_lines_of_one_panel_differ_in_their_dashes() -> None:
    assert len({str(style["linestyle"]) for style in SERIES}) == len(SERIES)
    assert len({str(style["linestyle"]) for style in LAWS.values()}) == len(LAWS)


def test_a_line_has_the_style_of_its_role() -> None:
    assert line_style("measured")["color"] == figure_style.MEASURED
    assert line_style("constant") == LAWS["constant"]
    assert [line_style(i) for i in range(len(SERIES))] == list(SERIES)
    for wrong in (len(SERIES), -1, "velocity"):
        with pytest.raises(ParameterError, match="measured, constant, power-law, or a number from 0 to 4"):
            line_style(wrong)  # type: ignore[arg-type]


def test_the_legend_and_the_title_cover_no_panel_nor_each_other() -> None:
    figure = Figure(layout="constrained")
    panels = figure.subplots(2, 1)
    for panel in panels:
        panel.plot([0.0, 1.0], label="both")
        dress(panel, zero=True)
    panels[1].plot([1.0, 0.0], label="second")
    legend_above(figure, list(panels), title="Title")
    FigureCanvasAgg(figure).draw()  # type: ignore[no-untyped-call]
    legend = figure.legends[0]
    assert [text.get_text() for text in legend.get_texts()] == ["both", "second"]
    assert legend.get_title().get_text() == "Title"
    assert not any(legend.get_window_extent().overlaps(panel.get_window_extent()) for panel in panels)
    entries = [text.get_window_extent() for text in legend.get_texts()]
    assert not any(legend.get_title().get_window_extent().overlaps(entry) for entry in entries)
