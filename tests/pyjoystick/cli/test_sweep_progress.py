"""The progress bar of a sweep on a terminal."""

from __future__ import annotations

import io

import pytest
from rich.console import Console

from pyjoystick.cli.sweep_progress import progress


def test_the_bar_shows_what_is_done_the_rate_and_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=100)
    monkeypatch.setattr("pyjoystick.cli.console.progress_console", lambda: console)
    with progress(1000) as bar:
        bar.show(100)
        for done in (200, 300):
            bar.show(done)
            bar.refresh()
    drawn = screen.getvalue()
    assert "300/1000" in drawn
    assert "runs/s" in drawn
    assert "-:--:--" in drawn or "0:00:" in drawn


def test_notes_are_said_once_and_nothing_is_drawn_without_a_terminal(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with progress(10) as bar:
        bar.show(3)
        bar.note("a worker was lost")
        bar.note("a worker was lost")
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", "a worker was lost\n")
