"""Figures of sweeps."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from matplotlib.container import BarContainer

from pyjoystick.runs import MOST_RESULTS, plot_scatter, plot_sensitivity
from pyjoystick.support import ParameterError, UnknownVariableError


def _indices(*results: str) -> pd.DataFrame:
    rows = [
        (result, parameter, 0.3, 0.2, 0.4, 0.5, 0.45, 0.55)
        for result in results
        for parameter in ("a", "b.c")
    ]
    names = ["result", "parameter", *(f"{n}{e}" for n in ("first", "total") for e in ("", "_low", "_high"))]
    return pd.DataFrame(rows, columns=names)


def _table(runs: int = 20) -> pd.DataFrame:
    table = pd.DataFrame({"a": np.arange(runs) * 1.0, "a.very.long.name": 1.0, "y": 2.0, "failed": False})
    table.loc[3, ["y", "failed"]] = [np.nan, True]
    table.attrs["sweep"] = {
        "settings": {"vary": {"a": {}, "a.very.long.name": {}}},
        "units": {"a": "m", "a.very.long.name": "N.m.s/rad", "y": ""},
    }
    return table


def test_bars_are_the_indices_with_their_intervals() -> None:
    figure = plot_sensitivity(_indices("y", "z", "u", "v"), title="Title")
    panels = [axes for axes in figure.axes if axes.get_visible()]
    assert [axes.get_title() for axes in panels] == ["y", "z", "u", "v"]
    assert [label.get_text() for label in panels[0].get_yticklabels()] == ["a", "b.c"]
    bars = [one for one in panels[0].containers if isinstance(one, BarContainer)]
    assert [bar.get_width() for one in bars for bar in one] == [0.3, 0.3, 0.5, 0.5]
    assert bars[0].errorbar is not None
    segments = bars[0].errorbar.lines[2][0].get_segments()
    np.testing.assert_allclose([segment[:, 0] for segment in segments], [[0.2, 0.4]] * 2)


def test_dots_are_runs_and_failed_runs_are_marked() -> None:
    figure = plot_scatter(_table(), ["y"])
    left, right = figure.axes
    assert left.collections[0].get_offsets().shape == (20, 2)
    assert left.lines[0].get_xdata().tolist() == [3.0]
    assert (left.get_xlabel(), left.get_ylabel()) == ("a (m)", "y")
    assert right.get_xlabel() == "a.very.long.name\n(N.m.s/rad)"


def test_of_very_many_runs_some_are_drawn() -> None:
    offsets = plot_scatter(_table(20_000), ["y"]).axes[0].collections[0].get_offsets()
    assert offsets.shape == (5000, 2)
    assert (offsets[0, 0], offsets[-1, 0]) == (0.0, 19_999.0)


def test_too_much_for_a_figure_is_refused() -> None:
    with pytest.raises(ParameterError, match="results = 7: must be 1 to 6"):
        plot_sensitivity(_indices(*"abcdefg"))
    with pytest.raises(ParameterError, match="results = 0"):
        plot_scatter(_table(), [])
    with pytest.raises(UnknownVariableError):
        plot_scatter(_table(), ["z"])
    assert MOST_RESULTS == 6
