"""The progress of a sweep on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from pyjoystick.cli.console import print_warning, progress_bar


class _Rate(ProgressColumn):
    """Runs per second."""

    def render(self, task: Task) -> Text:
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:.3g} runs/s" if speed < 1000 else f"{speed:.0f} runs/s")


class SweepProgress:
    """Progress bar with rate and remaining time, and notes above it, each printed once."""

    def __init__(self, bar: Progress, total: int) -> None:
        self._bar = bar
        self._task = bar.add_task("running", total=total)
        self._said: set[str] = set()
        self._begun = False

    def show(self, done: int) -> None:
        """Set the number of finished runs."""
        if not self._begun:
            # Runs of an earlier session count as done, but not towards the rate.
            self._bar.reset(self._task, completed=done)
            self._begun = True
        self._bar.update(self._task, completed=done)

    def refresh(self) -> None:
        """Redraw now; the bar redraws itself ten times per second."""
        self._bar.refresh()

    def note(self, text: str) -> None:
        """Print a note, unless it was printed before."""
        if text not in self._said:
            self._said.add(text)
            print_warning(text)


@contextmanager
def progress(total: int) -> Iterator[SweepProgress]:
    """Progress of `total` runs, see `progress_bar`."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        _Rate(),
        TimeRemainingColumn(),
    )
    with progress_bar(*columns) as bar:
        yield SweepProgress(bar, total)
