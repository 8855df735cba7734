"""The [explore] table of a TOML file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from fmu_build import BuildError
from fmu_build.explore import Settings, explore_page, read_settings
from fmu_build.explore.model import PageModel, PageVariable, run_length
from fmu_build.explore.page import _plots
from fmu_build.explore.ranges import Range
from fmu_build.explore.settings import PlotChoice, Preset
from tests.fmu_build.explore.conftest import Pages

_WHOLE = """
[explore]
title = "A title"
stop_time = 2
step = 0.01
first = ["J"]
input_tables = false
values = { theta_start = -0.3 }
plots = [{ y = ["theta"] }, { x = "theta", y = ["omega", "alpha"] }]

[explore.ranges]
J = { min = 0.01, max = 1, scale = "log" }

[[explore.presets]]
name = "Heavy"
values = { m = 2 }
"""


def _read(folder: Path, text: str) -> Settings:
    file = folder / "settings.toml"
    file.write_text(text)
    return read_settings(file)


def test_all_keys(tmp_path: Path) -> None:
    assert _read(tmp_path, _WHOLE) == Settings(
        title="A title",
        stop_time=2.0,
        step=0.01,
        first=("J",),
        input_tables=False,
        ranges={"J": Range(0.01, 1.0, "log")},
        values={"theta_start": -0.3},
        plots=(PlotChoice(("theta",)), PlotChoice(("omega", "alpha"), "theta")),
        presets=(Preset("Heavy", {"m": 2.0}),),
    )


def test_a_file_without_the_table_gives_the_defaults(tmp_path: Path) -> None:
    assert _read(tmp_path, "[other]\na = 1\n") == Settings()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("explore = 1", "explore = 1 must be a table"),
        ("[explore]\nstep = 0", "explore.step = 0.0 must be above 0"),
        ("[explore]\nstep = true", "explore.step = True must be a number"),
        ("[explore]\ncolor = 1", "explore.color = 1 must be one of the keys title, "),
        ("[explore]\nfirst = [1]", r"explore.first = \[1\] must be a list of names"),
        ("[explore.ranges]\nJ = {min=1}", "explore.ranges.J.max is missing; it must be a number"),
        ("[explore.ranges]\nJ = {min=1, max=1}", "explore.ranges.J.max = 1.0 must be above min, 1.0"),
        (
            "[explore.ranges]\nJ = {min=0, max=1, scale='log'}",
            "scale = 'log' must be min and max of the same",
        ),
        ("[[explore.presets]]\nvalues = {}", r"explore.presets\[0\].name is missing"),
        ("[[explore.plots]]\nx = 'time'", r"explore.plots\[0\].y = \[\] must be a list of names"),
        ("[explore", "is no TOML file"),
        (
            "[explore.ranges]\nJ = {min=1" + "0" * 400 + ", max=2}",
            "explore.ranges.J.min = 10+ must be a number",
        ),
    ],
)
def test_faults_name_file_key_and_value(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        _read(tmp_path, text)
    assert str(tmp_path) in str(caught.value)


def test_a_run_has_no_more_rows_than_a_page_can_show() -> None:
    assert run_length(0.0, 1.5, 0.001) == (1.5, 0.001)
    stop, step = run_length(0.0, 1e6, 1e-3)
    assert stop / step <= 50_000
    assert run_length(0.0, 2.0, 1e-12)[1] == pytest.approx(4e-5)
    for stop, step in ((0.0, 0.1), (math.inf, 0.1), (1.0, 2.0), (1.0, 0.0)):
        with pytest.raises(BuildError, match=r"explore\.(stop_time|step)"):
            run_length(0.0, stop, step)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (Settings(first=("K",)), "explore.first: 'K' is no parameter, input or start value of Models.Ball"),
        (Settings(values={"der(h)": 1.0}), "explore.values: 'der"),
        (Settings(plots=(PlotChoice(("z",)),)), "explore.plots: 'z' is no variable of Models.Ball"),
    ],
)
def test_names_that_the_model_does_not_have(pages: Pages, settings: Settings, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        explore_page(pages.fmu("Models.Ball"), settings)


def test_plots_that_the_settings_leave_open() -> None:
    """Outputs by their units; else states; else inner variables; and the plane of the first state."""
    gain = PageVariable("k", 1, "r", "parameter", settable=True, start=1.0)
    inner = [PageVariable("y", 2, "r", "local", unit="m"), PageVariable("z", 3, "r", "local", unit="N")]
    state = PageVariable("x", 4, "r", "local", unit="m", derivative="der(x)")
    outputs = [PageVariable("f", 5, "r", "output", unit="N"), PageVariable("g", 6, "r", "output", unit="N")]

    def plots(*variables: PageVariable) -> list[tuple[str | None, tuple[str, ...]]]:
        model = PageModel("M", "", 0.0, 1.0, 0.01, 0.0, (gain, *variables), {})
        return [(plot.x, plot.y) for plot in _plots(model)]

    assert plots() == []
    assert plots(*inner) == [(None, ("y",)), (None, ("z",))]
    assert plots(*inner, state) == [(None, ("x",)), ("x", ("der(x)",))]
    assert plots(*inner, state, *outputs) == [(None, ("f", "g")), ("x", ("der(x)",))]
