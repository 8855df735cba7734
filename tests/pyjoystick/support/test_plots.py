"""The figure of displacement, velocity and acceleration."""

from __future__ import annotations

import math
import struct
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.runs import reference_free_oscillation
from pyjoystick.support import (
    OutputFileError,
    ParameterError,
    UnknownVariableError,
    plot_motion,
    save_figure,
    save_results,
)


@pytest.fixture(scope="module")
def runs() -> dict[str, pd.DataFrame]:
    return {
        label: reference_free_oscillation(math.radians(-20.0), parameters=parameters, output_interval=0.01)
        for label, parameters in (("constant", NOMINAL), ("power law", NOMINAL_POWER_LAW))
    }


@pytest.mark.parametrize(("unit", "factor"), [("deg", math.degrees(1.0)), ("rad", 1.0)])
def test_every_panel_has_every_run_in_the_unit_it_names(
    runs: dict[str, pd.DataFrame], unit: str, factor: float
) -> None:
    figure = plot_motion(runs, angle_unit=unit)  # type: ignore[arg-type]
    expected = (("theta", f"Displacement ({unit})"), ("omega", f"Velocity ({unit}/s)"), ("alpha", None))
    for axes, (column, label) in zip(figure.axes, expected, strict=True):
        assert label is None or axes.get_ylabel() == label
        for line, (name, run) in zip(axes.lines, runs.items(), strict=False):
            assert line.get_label() == name
            np.testing.assert_array_equal(line.get_xdata(), run.index)
            np.testing.assert_allclose(np.asarray(line.get_ydata()), run[column] * factor, rtol=1e-14)
    assert figure.axes[-1].get_xlabel() == "Time (s)"
    assert all(axes.get_xlim() == (0.0, 1.5) for axes in figure.axes)


def test_curves_differ_in_dashes_and_in_gray(runs: dict[str, pd.DataFrame]) -> None:
    figure = plot_motion({f"{label} {i}": run for i in (1, 2) for label, run in runs.items()})
    lines = figure.axes[0].lines[:4]
    assert len({str(line._unscaled_dash_pattern) for line in lines}) == 4  # type: ignore[attr-defined]
    luminance = [np.dot(to_rgb(line.get_color()), (0.299, 0.587, 0.114)) for line in lines[:2]]
    assert abs(luminance[0] - luminance[1]) > 0.3


def test_the_legend_covers_no_panel(runs: dict[str, pd.DataFrame]) -> None:
    figure = plot_motion(runs, title="Title")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    legend = figure.legends[0].get_window_extent()
    assert [text.get_text() for text in figure.legends[0].get_texts()] == list(runs)
    assert not any(legend.overlaps(axes.get_window_extent()) for axes in figure.axes)
    assert legend.x0 >= 0.0
    assert legend.x1 <= figure.bbox.width


def test_one_run_needs_no_legend(runs: dict[str, pd.DataFrame]) -> None:
    assert plot_motion({"only": runs["constant"]}).legends == []


def test_a_png_has_the_size_that_was_asked_for(runs: dict[str, pd.DataFrame], tmp_path: Path) -> None:
    path = tmp_path / "new" / "motion.png"
    save_figure(plot_motion(runs, size=(5.0, 4.0)), path, resolution=100.0)
    content = path.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">II", content[16:24]) == (500, 400)


@pytest.mark.parametrize(("suffix", "start"), [(".pdf", b"%PDF"), (".svg", b"<?xml"), (".PNG", b"\x89PNG")])
def test_the_suffix_is_the_format(
    runs: dict[str, pd.DataFrame], tmp_path: Path, suffix: str, start: bytes
) -> None:
    path = tmp_path / f"motion{suffix}"
    save_figure(plot_motion(runs), path)
    assert path.read_bytes().startswith(start)
    assert list(tmp_path.iterdir()) == [path]


def test_the_same_pdf_is_the_same_file(runs: dict[str, pd.DataFrame], tmp_path: Path) -> None:
    for name in ("one.pdf", "two.pdf"):
        save_figure(plot_motion(runs), tmp_path / name)
    assert (tmp_path / "one.pdf").read_bytes() == (tmp_path / "two.pdf").read_bytes()


def test_another_format_is_refused(runs: dict[str, pd.DataFrame], tmp_path: Path) -> None:
    with pytest.raises(OutputFileError, match=r"motion\.gif: the name must end in \.png, \.pdf, \.svg"):
        save_figure(plot_motion(runs), tmp_path / "motion.gif")
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_drawn(runs: dict[str, pd.DataFrame]) -> None:
    run = runs["constant"]
    with pytest.raises(ParameterError, match="runs = 0 runs: must be 1 to 5 runs"):
        plot_motion({})
    with pytest.raises(ParameterError, match="runs = 6 runs"):
        plot_motion({str(i): run for i in range(6)})
    with pytest.raises(ParameterError, match="angle_unit = grad: must be 'deg' or 'rad'"):
        plot_motion(runs, angle_unit="grad")  # type: ignore[arg-type]
    with pytest.raises(UnknownVariableError, match="no variable 'alpha'"):
        plot_motion({"": run.drop(columns="alpha")})


def test_results_are_a_summary_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "new" / "results"
    save_results(folder, "## Numbers", {"one": Figure(), "two": Figure()})
    assert capsys.readouterr().out == "## Numbers\n"
    assert (folder / "summary.md").read_text(encoding="utf-8") == "## Numbers\n"
    assert sorted(path.name for path in folder.iterdir()) == [
        *("one.pdf", "one.png", "summary.md", "two.pdf", "two.png")
    ]


def test_a_file_in_the_way_of_results_is_named(tmp_path: Path) -> None:
    (tmp_path / "results").write_text("in the way")
    with pytest.raises(OutputFileError, match="results"):
        save_results(tmp_path / "results", "", {"one": Figure()})
