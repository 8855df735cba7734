"""Results display themselves in notebooks, escaped; long tasks show their progress."""

from __future__ import annotations

import re
import sys
from types import SimpleNamespace
from typing import Any

import pytest
from matplotlib.figure import Figure

from pyjoystick.support import Drawn, notebook, notebook_progress
from tests.pyjoystick.reports.html_report.reading import read_page


class Result(Drawn):
    _shown_by = __name__


def summary(_: Result) -> str:
    return "Name `<script>` & <b>more</b>.\n\n| a | b |\n|---|--:|\n| x<y | 1 |"


def plot(_: Result) -> Figure:
    figure = Figure()
    figure.subplots().plot([0.0, 1.0])
    return figure


def test_a_result_is_shown_as_table_and_figure_and_tags_are_text() -> None:
    html = Result()._repr_html_()
    read = read_page(html)
    assert read.cells == ["a", "b", "x<y", "1"]
    assert "<script>" not in html
    assert "<b>" not in html
    assert read.images[0]["src"].startswith("data:image/svg+xml;base64,")
    assert Result().summary() in html or "&lt;b&gt;more&lt;/b&gt;" in html
    assert isinstance(Result().plot(), Figure)


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What a notebook would show, in its order."""
    found: list[str] = []

    class Handle:
        def update(self, content: str) -> None:
            found.append(content)

    def display(content: str, **_: Any) -> Handle:
        found.append(content)
        return Handle()

    monkeypatch.setattr(notebook, "is_notebook", lambda: True)
    monkeypatch.setitem(sys.modules, "IPython.display", SimpleNamespace(HTML=str, display=display))
    monkeypatch.setattr(notebook, "_INTERVAL", 0.0)
    return found


def test_progress_is_a_bar_that_goes_with_the_work(shown: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(notebook, "_PATIENCE", 0.0)
    with notebook_progress("fit") as tell:
        tell("a <b>", 0, 1)
        tell("profiles", 2, 5)
    assert re.fullmatch(r"<progress></progress> fit a &lt;b&gt;, 0 s", shown[0])
    assert shown[1].startswith('<progress value="2" max="5"></progress> fit profiles')
    assert shown[2:] == [""]


def test_short_work_shows_nothing(shown: list[str]) -> None:
    with notebook_progress("fit") as tell:
        tell("searching", 0, 1)
    assert shown == []


def test_elsewhere_nothing_is_shown(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(notebook, "_PATIENCE", 0.0)
    with notebook_progress("fit") as tell:
        tell("searching", 0, 1)
    assert capsys.readouterr() == ("", "")
    assert not notebook.is_notebook()


def test_a_notebook_draws_figures_that_pyplot_has_not_made(monkeypatch: pytest.MonkeyPatch) -> None:
    shells = pytest.importorskip("IPython.core.interactiveshell", reason="needs IPython")
    shell = shells.InteractiveShell()
    monkeypatch.setattr(notebook, "is_notebook", lambda: True)
    monkeypatch.setattr(notebook, "_shell", lambda: shell)
    drawn = Result().plot()
    assert "image/png" not in shell.display_formatter.format(drawn)[0]
    notebook.show_figures()
    assert shell.display_formatter.format(drawn)[0]["image/png"].startswith("iVBOR")
    shell.display_formatter.formatters["image/png"].for_type(Figure, lambda _: "as the user has it")
    notebook.show_figures()
    assert shell.display_formatter.format(drawn)[0]["image/png"] == "as the user has it"
