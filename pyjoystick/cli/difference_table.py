"""How differences of runs are shown."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pyjoystick.motion import Difference
from pyjoystick.runs import RunComparison


def print_differences(console: Console, runs: Sequence[RunComparison], *, every_run: bool = False) -> None:
    """A table of the variables, each with its worst run, or with every run."""
    for run in runs:
        for failure in run.failures:
            console.print(f"{escape(run.experiment)}: [bold red]failed[/bold red]: {escape(failure)}")
    several = len(runs) > 1
    columns = ("variable", "unit", "experiment" if every_run else "worst in")[: 3 if several else 2]
    table = Table(
        *columns, "largest\ndifference", "relative", "at (s)", "limit", "passed\nat (s)", "", box=None
    )
    for column in table.columns:
        column.overflow = "fold"
    for column in table.columns[-6:]:
        column.no_wrap = True
    for column in table.columns[-6:-1]:
        column.justify = "right"
    shown = (_all if every_run else _worst)(runs)
    for run, one in shown:
        where = (escape(run.experiment),) if several else ()
        limit = "" if one.limit is None else f"{one.limit:.1e}"
        parted = "" if one.parted_at is None else f"{one.parted_at:.4g}"
        numbers = (f"{one.largest:.2e}", f"{one.relative:.1e}", f"{one.time:.4g}", limit, parted)
        table.add_row(escape(one.variable), escape(one.unit), *where, *numbers, _verdict(run, one))
    if table.row_count:
        console.print(table)


def _verdict(run: RunComparison, one: Difference) -> str:
    if one.variable not in run.judged:
        return ""
    return "ok" if one.within_limit else "[bold red]exceeded[/bold red]"


def _all(runs: Iterable[RunComparison]) -> Iterator[tuple[RunComparison, Difference]]:
    for run in runs:
        for one in run.differences:
            yield run, one


def _worst(runs: Iterable[RunComparison]) -> Iterator[tuple[RunComparison, Difference]]:
    """For each variable the run in which it is largest, in parts of the limit where it is judged."""
    by_name: dict[str, list[tuple[RunComparison, Difference]]] = {}
    for run, one in _all(runs):
        by_name.setdefault(one.variable, []).append((run, one))
    for found in by_name.values():
        yield max(found, key=lambda pair: _size(*pair))


def _size(run: RunComparison, one: Difference) -> float:
    size = one.largest / (one.limit if one.limit and one.variable in run.judged else 1.0)
    return math.inf if math.isnan(size) else size
