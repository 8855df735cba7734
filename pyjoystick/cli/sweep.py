"""``pyjoystick sweep``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from rich.markup import escape
from rich.table import Table

from pyjoystick import runs
from pyjoystick.cli import options
from pyjoystick.cli.console import output, print_progress, print_warning, write, write_plot
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.invocation import INTERRUPTED
from pyjoystick.cli.sweep_progress import progress
from pyjoystick.support import OutputFileError, UnknownVariableError, check_outputs, write_text

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

EXAMPLES: Final = """
Examples:

    pyjoystick sweep scenarios/sweeps/release.toml --plot release.png
    pyjoystick sweep scenarios/sweeps/sensitivity.toml -o indices.parquet --indices indices.csv
    pyjoystick sweep settings.toml --scheduler tcp://10.0.0.1:8786

Settings of a sweep over a release angle and a damping coefficient:

    fmu.path = "Joystick"
    experiment = { duration = 1.0, output_interval = 0.001 }
    sampling.method = "grid"
    vary.theta_start = { from = "-20deg", to = "-5deg", count = 16 }
    vary."damping.C" = { from = 0.03, to = 0.06, count = 13 }
    results = [{ kind = "peaks", variable = "theta", derivative = "omega", count = 2 }]
"""


_MESSAGES_SHOWN: Final = 5


def run(
    settings: Annotated[
        Path, typer.Argument(metavar="SETTINGS", help="TOML file with the settings of the sweep.")
    ],
    target: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="File for the results, .parquet or .csv. Default: SETTINGS with the suffix .csv.",
        ),
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option(
            "--threads",
            metavar="NUMBER",
            min=1,
            help="Number of threads on this machine. Default: one per core.",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Run on the workers of a Dask scheduler, tcp://HOST:PORT.",
        ),
    ] = None,
    plots: Annotated[
        list[Path] | None,
        options.plot("the Sobol indices of a saltelli sweep, of any other its results; repeatable"),
    ] = None,
    scatters: Annotated[
        list[Path] | None,
        options.plot("results over the parameters, whatever the sampling method; repeatable", "--scatter"),
    ] = None,
    indices: Annotated[
        Path | None,
        options.file("--indices", text="Write the Sobol indices as CSV.", suffixes=(".csv",)),
    ] = None,
    results: Annotated[
        list[str] | None,
        typer.Option(
            "--result",
            metavar="NAME",
            help="Show and plot this result, such as theta.peak1; repeatable. Default: all results.",
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Discard saved progress and results, and start over.")
    ] = False,
) -> None:
    """Run an FMU for many values of its parameters, as described in a settings file.

    Progress is saved: after Ctrl-C or a crash, the same command (without --overwrite) continues where it
    stopped. Failed runs are counted and listed in the results with their messages. The exit code is 1 only if
    every run failed, 130 after Ctrl-C, and 143 after SIGTERM.
    """
    if threads is not None and scheduler is not None:
        raise typer.BadParameter(
            "use --threads or --scheduler, not both: the workers choose their own threads"
        )
    figures = plots or [], scatters or []
    target = target or settings.parent / f"{settings.stem}.csv"
    check_outputs(target, *figures[0], *figures[1], indices)
    sweep = runs.Sweep(runs.read_settings(settings, found_or_built))
    names = tuple(results or ())
    _check(sweep, names, indices)
    with progress(len(sweep.design)) as bar:
        outcome = runs.run_sweep(
            sweep,
            target,
            threads=threads,
            scheduler=scheduler,
            overwrite=overwrite,
            on_progress=bar.show,
            on_note=bar.note,
        )
    _print_outcome(sweep, outcome, overwrite=overwrite)
    if outcome.table is None:
        raise typer.Exit(INTERRUPTED)
    _warn_of_coarse_peaks(sweep, outcome.table)
    if outcome.failed == outcome.done:
        raise typer.Exit(1)
    found = None
    if sweep.settings.sampling.method == "saltelli":
        found = _print_sensitivity(outcome.table, names)
    if indices is not None:
        _write_indices(found, indices)
    _draw(sweep, outcome.table, found, names, *figures)


def _check(sweep: runs.Sweep, names: Sequence[str], indices: Path | None) -> None:
    """Reject options before the sweep that would fail after it."""
    method = sweep.settings.sampling.method
    if indices is not None and method != "saltelli":
        raise runs.SensitivityError(
            f"--indices requires the sampling method saltelli; this sweep has {method}"
        )
    for name in names:
        if name not in sweep.columns:
            raise UnknownVariableError(name, sweep.columns)


def _print_outcome(sweep: runs.Sweep, outcome: runs.Outcome, *, overwrite: bool) -> None:
    total = len(sweep.design)
    fmu = sweep.settings.fmu.path.name
    title = f"{sweep.settings.title}: " if sweep.settings.title else ""
    failed = f", {outcome.failed} failed" if outcome.failed else ""
    console = output()
    console.print(escape(f"{title}{outcome.done} of {total} runs of {fmu} done{failed}"))
    for line in _failures(outcome.messages):
        console.print(escape(line))
    if outcome.interrupted:
        command = "the command without --overwrite" if overwrite else "the same command"
        print_warning(f"interrupted; finished runs are kept, and {command} continues from here")
    elif outcome.found == total:
        print_progress(f"{outcome.path} was already complete; nothing was run")
    else:
        before = f" ({outcome.found} runs were finished before)" if outcome.found else ""
        print_progress(f"wrote {outcome.path}{before}")


def _warn_of_coarse_peaks(sweep: runs.Sweep, table: pd.DataFrame) -> None:
    for name in runs.coarse_peaks(table, sweep.settings.results, sweep.settings.time):
        print_warning(
            f"peaks of {name} come less than five samples after one another or the start, so they are "
            "inaccurate or missed: choose a shorter output_interval"
        )


def _failures(failures: dict[int, str]) -> list[str]:
    lines = [f"  run {run}: {message}" for run, message in list(failures.items())[:_MESSAGES_SHOWN]]
    more = len(failures) - len(lines)
    return [*lines, f"  and {more} more; all are in the column `message`"] if more > 0 else lines


def _print_sensitivity(table: pd.DataFrame, results: Sequence[str]) -> pd.DataFrame | None:
    """Print the indices; if there are none, print why and return None."""
    console = output()
    try:
        found = runs.sensitivity(table, results)
    except runs.SensitivityError as error:
        print_warning(f"no Sobol indices: {error}")
        return None
    for name, reason in found.attrs["left_out"].items():
        print_warning(f"no Sobol indices of {name}: it {reason}")
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
    console.print("Sobol indices: share of the variance due to each parameter")
    console.print(shown)
    return found


def _write_indices(found: pd.DataFrame | None, path: Path) -> None:
    if found is None:
        raise OutputFileError(path, "there are no Sobol indices")
    text = found.to_csv(index=False, lineterminator="\n")
    write(path, lambda path: write_text(path, text))


def _draw(
    sweep: runs.Sweep,
    table: pd.DataFrame,
    indices: pd.DataFrame | None,
    names: Sequence[str],
    plots: Sequence[Path],
    scatters: Sequence[Path],
) -> None:
    """Plot the Sobol indices or, for other sampling methods, the results; `scatters` plot results too."""
    title = sweep.settings.title
    if sweep.settings.sampling.method != "saltelli":
        scatters = (*plots, *scatters)
    elif plots:
        if indices is None:
            raise OutputFileError(plots[0], "there are no Sobol indices to draw")
        drawn = _first(list(dict.fromkeys(indices["result"])))
        _save(runs.plot_sensitivity(indices[indices["result"].isin(drawn)], title=title), plots)
    if scatters:
        drawn = _first(list(names or sweep.columns))
        _save(runs.plot_scatter(table, drawn, title=title), scatters)


def _save(figure: Figure, paths: Sequence[Path]) -> None:
    for path in paths:
        write_plot(path, lambda: figure)


def _first(results: list[str]) -> list[str]:
    if len(results) > runs.MOST_RESULTS:
        left_out = ", ".join(results[runs.MOST_RESULTS :])
        print_warning(
            f"a figure has room for {runs.MOST_RESULTS} results; left out: {left_out} (--result chooses)"
        )
    return results[: runs.MOST_RESULTS]
