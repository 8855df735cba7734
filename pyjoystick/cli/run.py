"""``pyjoystick run``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer
from rich.live import Live
from rich.markup import escape
from rich.table import Table

from pyjoystick import fmu, reports
from pyjoystick.cli.console import (
    output,
    print_error,
    print_progress,
    print_warning,
    print_warnings,
    progress_console,
)
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.invocation import INTERRUPTED

EXAMPLES: Final = """
Examples:

    pyjoystick run
    pyjoystick run --plan
    pyjoystick run laboratories/left_stick
"""
_COLORS: Final = {
    "done": "green",
    "working": "cyan",
    "failed": "bold red",
    "not done": "yellow",
    "missing": "yellow",
    "do": "cyan",
}


def run(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of the project.")] = Path(),
    plan: Annotated[bool, typer.Option("--plan", help="Only print what would be done, and why.")] = False,
) -> None:
    """Build the joystick of a project from its files: springs, inertia, fit, error budget, FMUs and report.

    Repeats only what has changed since the last run (contents of files, settings, versions) and what depends
    on it. After Ctrl-C, the next run continues. Outdated results are moved to `results/outdated`.
    The exit code is 1 if a step failed or could not be done.
    """
    if plan:
        steps = reports.plan_project(folder, find=fmu.find_fmu)
        output().print(_table(("step", "plan", "why"), [(one.name, one.plan, one.why) for one in steps]))
        return
    with _shown() as show:
        done = reports.run_project(folder, find=found_or_built, on_change=show)
    rows = [(one.name, one.state, _seconds(one), _first_line(one.remark)) for one in done.steps]
    output().print(_table(("step", "state", "s", "result"), rows))
    for one in done.steps:
        if one.state == "failed":
            print_error(f"{one.name}: {one.remark}")
        print_warnings(one.name, one.notes)
    for note in done.notes:
        print_warning(f"note: {note}")
    if done.interrupted:
        print_error("stopped; the next `pyjoystick run` continues from here")
        raise typer.Exit(INTERRUPTED)
    if not done.count("done", "unchanged", "failed"):
        print_error(
            f"nothing can be done yet: put the missing files into place, or edit {reports.LABORATORY_FILE}"
        )
        raise typer.Exit(1)
    if done.count("failed", "not done"):
        raise typer.Exit(1)


@contextmanager
def _shown() -> Iterator[reports.OnChange]:
    """Table of the steps in progress; outside terminals, one line for each finished step."""
    console = progress_console()
    told: set[str] = set()

    def lines(steps: Sequence[reports.StepState]) -> None:
        for one in steps:
            if one.state in ("done", "failed", "not done") and one.name not in told:
                told.add(one.name)
                print_progress(f"{one.name}: {one.state}{f' in {_seconds(one)} s' if one.seconds else ''}")

    if not console.is_terminal:
        yield lines
        return
    with Live(console=console, transient=True, auto_refresh=False) as live:

        def draw(steps: Sequence[reports.StepState]) -> None:
            rows = [(one.name, one.state, _seconds(one), _first_line(one.remark)) for one in steps]
            live.update(_table(("step", "state", "s", "result"), rows), refresh=True)

        yield draw


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    table = Table(*header, box=None, padding=(0, 2, 0, 0))
    for row in rows:
        color = _COLORS.get(row[1], "dim")
        table.add_row(escape(row[0]), f"[{color}]{row[1]}[/{color}]", *map(escape, row[2:]))
    return table


def _seconds(one: reports.StepState) -> str:
    return f"{one.seconds:.1f}" if one.seconds else ""


def _first_line(text: str) -> str:
    return text.partition("\n")[0]
