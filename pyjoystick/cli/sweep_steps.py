"""The steps of ``pyjoystick sweep``: carry it out, print what came of it, draw it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import pandas as pd
from matplotlib.figure import Figure
from rich.markup import escape
from rich.table import Table

from pyjoystick.cli.console import output, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.sweep_progress import progress
from pyjoystick.runs import (
    MOST_RESULTS,
    Outcome,
    SensitivityError,
    Sweep,
    plot_scatter,
    plot_sensitivity,
    read_settings,
    run_sweep,
    sensitivity,
)
from pyjoystick.support import (
    OutputFileError,
    UnknownVariableError,
    check_figure_path,
    check_outputs,
    replacing,
    save_figure,
)

#: Exit code after Ctrl-C, as shells have it.
INTERRUPTED: Final = 130
_MESSAGES_SHOWN: Final = 5


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be shown and written beside the results.

    Attributes:
        results: names of results, all if empty
        plots: files of the figure that suits the method
        scatters: files of the figure of results over parameters
        indices: file of the Sobol indices, or None
    """

    results: tuple[str, ...]
    plots: tuple[Path, ...]
    scatters: tuple[Path, ...]
    indices: Path | None


def sweep_and_show(
    settings: Path,
    target: Path | None,
    threads: int | None,
    scheduler: str | None,
    overwrite: bool,
    wanted: Wanted,
) -> int:
    """Carry out the sweep of a settings file, print and draw what is wanted; returns the exit code."""
    for path in (*wanted.plots, *wanted.scatters):
        check_figure_path(path)
    target = target or settings.with_suffix(".csv")
    check_outputs(target, *wanted.plots, *wanted.scatters, wanted.indices)
    sweep = Sweep(read_settings(settings, found_or_built))
    _check(sweep, wanted)
    with progress(len(sweep.design)) as bar:
        outcome = run_sweep(
            sweep,
            target,
            threads=threads,
            scheduler=scheduler,
            overwrite=overwrite,
            on_progress=bar.show,
            on_note=bar.note,
        )
    _print_outcome(sweep, outcome)
    if outcome.table is None:
        return INTERRUPTED
    if outcome.failed == outcome.done:
        return 1
    indices = None
    if sweep.settings.sampling.method == "saltelli":
        indices = _print_sensitivity(outcome.table, wanted.results)
    if wanted.indices is not None:
        _write_indices(indices, wanted.indices)
    _draw(sweep, outcome.table, indices, wanted)
    return 0


def _check(sweep: Sweep, wanted: Wanted) -> None:
    """Refuse before anything is run what cannot be shown after it."""
    method = sweep.settings.sampling.method
    if wanted.indices is not None and method != "saltelli":
        raise SensitivityError(f"--indices needs a sweep with method saltelli, this one has {method}")
    for name in wanted.results:
        if name not in sweep.columns:
            raise UnknownVariableError(name, sweep.columns)


def _print_outcome(sweep: Sweep, outcome: Outcome) -> None:
    total = len(sweep.design)
    fmu = sweep.settings.fmu.path.name
    title = f"{sweep.settings.title}: " if sweep.settings.title else ""
    failed = f", {outcome.failed} failed" if outcome.failed else ""
    console = output()
    console.print(escape(f"{title}{outcome.done} of {total} runs of {fmu} done{failed}"))
    for line in _failures(outcome.messages):
        console.print(escape(line))
    if outcome.interrupted:
        print_note("interrupted; what is done is kept, and the same command goes on from here")
    elif outcome.found == total:
        print_note(f"{outcome.path} was complete already; nothing was run")
    else:
        before = f" ({outcome.found} runs were done before)" if outcome.found else ""
        print_note(f"wrote {outcome.path}{before}")


def _failures(messages: dict[int, str]) -> list[str]:
    lines = [f"  run {run}: {message}" for run, message in list(messages.items())[:_MESSAGES_SHOWN]]
    more = len(messages) - len(lines)
    return [*lines, f"  and {more} more; column `message` has them all"] if more > 0 else lines


def _print_sensitivity(table: pd.DataFrame, results: Sequence[str]) -> pd.DataFrame | None:
    """Print the indices; None where there are none, which is told."""
    console = output()
    try:
        found = sensitivity(table, results)
    except SensitivityError as error:
        print_note(f"no Sobol indices: {error}")
        return None
    for name, reason in found.attrs["left_out"].items():
        print_note(f"no Sobol indices of {name}: it {reason}")
    shown = Table("", "first order", "95 %", "total", "95 %", box=None)
    shown.columns[0].overflow = "fold"
    for column in shown.columns[1:]:
        column.justify = "right"
        column.no_wrap = True
    for result, rows in found.groupby("result", sort=False):
        shown.add_row(escape(str(result)))
        for row in rows.itertuples(index=False):
            first = (f"{row.first:z.2f}", f"{row.first_low:z.2f} to {row.first_high:z.2f}")
            total = (f"{row.total:z.2f}", f"{row.total_low:z.2f} to {row.total_high:z.2f}")
            shown.add_row(f"  {escape(str(row.parameter))}", *first, *total)
    console.print("Sobol indices: the share of the variance that comes from each parameter")
    console.print(shown)
    return found


def _write_indices(found: pd.DataFrame | None, path: Path) -> None:
    if found is None:
        raise OutputFileError(path, "there are no Sobol indices")
    with replacing(path) as temporary:
        found.to_csv(temporary, index=False, lineterminator="\n")
    print_note(f"wrote {path}")


def _draw(sweep: Sweep, table: pd.DataFrame, indices: pd.DataFrame | None, wanted: Wanted) -> None:
    title = sweep.settings.title
    scatters = wanted.scatters
    if sweep.settings.sampling.method != "saltelli":
        scatters = (*wanted.plots, *scatters)
    elif wanted.plots:
        if indices is None:
            raise OutputFileError(wanted.plots[0], "there are no Sobol indices to draw")
        drawn = _first(list(dict.fromkeys(indices["result"])))
        _save(plot_sensitivity(indices[indices["result"].isin(drawn)], title=title), wanted.plots)
    if scatters:
        drawn = _first(list(wanted.results or sweep.columns))
        _save(plot_scatter(table, drawn, title=title), scatters)


def _save(figure: Figure, paths: Sequence[Path]) -> None:
    for path in paths:
        save_figure(figure, path)
        print_note(f"wrote {path}")


def _first(results: list[str]) -> list[str]:
    if len(results) > MOST_RESULTS:
        left_out = ", ".join(results[MOST_RESULTS:])
        print_note(f"a figure has room for {MOST_RESULTS} results; left out: {left_out} (--result chooses)")
    return results[:MOST_RESULTS]
