"""Tables of ``pyjoystick compare``."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pyjoystick import fmu, motion, runs

_TITLES: Final[Mapping[fmu.Interface, str]] = {
    "ModelExchange": "Model Exchange",
    "CoSimulation": "Co-Simulation",
}


def print_comparison(console: Console, comparison: runs.FmuComparison, every_run: bool) -> None:
    """Print a comparison of two FMUs: their identities, declarations, and differences of runs."""
    facts = Table.grid(padding=(0, 2))
    for label, one in (("first", comparison.first), ("second", comparison.second)):
        facts.add_row(f"[dim]{label}[/dim]", escape(str(one.path)), escape(one.model_name), _made_by(one))
    for column in facts.columns:
        column.overflow = "fold"
    console.print(facts)
    _print_declarations(console, comparison.declarations, every_run)
    for interface in dict.fromkeys(run.interface for run in comparison.runs):
        found = [run for run in comparison.runs if run.interface == interface]
        labels = "; ".join(run.experiment for run in found)
        solver = solver_text(interface, comparison.tolerances)
        console.print(f"\n[bold]{_TITLES[interface]}[/bold], {solver}: {escape(labels)}")
        if interface == "CoSimulation" and not any(run.judged for run in found):
            console.print("not judged, because each FMU has its own solver and step (judge with --cs-limit)")
        print_differences(console, found, every_run=every_run)


def print_differences(
    console: Console, found: Sequence[runs.RunComparison], *, every_run: bool = False
) -> None:
    """Table of the variables, each with its worst run or with all runs."""
    for run in found:
        for failure in run.failures:
            console.print(f"{escape(run.experiment)}: [bold red]failed[/bold red]: {escape(failure)}")
    several = len(found) > 1
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
    shown = (_all if every_run else _worst)(found)
    for run, one in shown:
        where = (escape(run.experiment),) if several else ()
        limit = "" if one.limit is None else f"{one.limit:.1e}"
        parted = "" if one.parted_at is None else f"{one.parted_at:.4g}"
        numbers = (f"{one.largest:.2e}", f"{one.relative:.1e}", f"{one.time:.4g}", limit, parted)
        table.add_row(escape(one.variable), escape(one.unit), *where, *numbers, _verdict(run, one))
    if table.row_count:
        console.print(table)


def _verdict(run: runs.RunComparison, one: motion.Difference) -> str:
    if one.variable not in run.judged:
        return ""
    return "ok" if one.within_limit else "[bold red]exceeded[/bold red]"


def _all(found: Iterable[runs.RunComparison]) -> Iterator[tuple[runs.RunComparison, motion.Difference]]:
    for run in found:
        for one in run.differences:
            yield run, one


def _worst(found: Iterable[runs.RunComparison]) -> Iterator[tuple[runs.RunComparison, motion.Difference]]:
    """For each variable, the run with the largest difference, relative to the limit if there is one."""
    by_name: dict[str, list[tuple[runs.RunComparison, motion.Difference]]] = {}
    for run, one in _all(found):
        by_name.setdefault(one.variable, []).append((run, one))
    for pairs in by_name.values():
        yield max(pairs, key=lambda pair: _size(*pair))


def _size(run: runs.RunComparison, one: motion.Difference) -> float:
    size = one.largest / (one.limit if one.limit and one.variable in run.judged else 1.0)
    return math.inf if math.isnan(size) else size


def solver_text(interface: fmu.Interface, tolerances: runs.Tolerances) -> str:
    """The solver and its tolerance."""
    if interface == "ModelExchange":
        return f"CVode at tolerance {tolerances.model_exchange:g}"
    return f"tolerance {tolerances.co_simulation:g}"


def _print_declarations(console: Console, declarations: runs.Declarations, every_variable: bool) -> None:
    groups = [
        ("only in the first", declarations.only_first),
        ("only in the second", declarations.only_second),
    ]
    internal = declarations.internal_only_first, declarations.internal_only_second
    if every_variable:
        groups += zip(("internal, only in the first", "internal, only in the second"), internal, strict=True)
    for title, names in groups:
        if names:
            console.print(f"{title}: {escape(', '.join(names))}")
    if not every_variable and any(internal):
        first, second = map(len, internal)
        console.print(
            f"internal variables of only one FMU: {first} of the first, {second} of the second (--all)"
        )
    if declarations.differences:
        table = Table("declared differently", "", "first", "second", box=None)
        for one in declarations.differences:
            cells = (one.variable, one.attribute, one.first or "none", one.second or "none")
            table.add_row(*map(escape, cells))
        console.print(table)


def _made_by(one: fmu.FmuDescription) -> str:
    return escape(f"made by {one.generation_tool}" if one.generation_tool else "")
