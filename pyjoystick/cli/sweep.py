"""``pyjoystick sweep``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

EXAMPLES = """
Examples:

    pyjoystick sweep scenarios/sweeps/release.toml --plot release.png
    pyjoystick sweep scenarios/sweeps/sensitivity.toml -o indices.parquet --indices indices.csv
    pyjoystick sweep settings.toml --scheduler tcp://10.0.0.1:8786

docs/sweeps.md describes the settings file and how to use a cluster.
"""


def run(
    settings: Annotated[
        Path, typer.Argument(metavar="SETTINGS", help="The settings, a TOML file.", show_default=False)
    ],
    target: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Where the results go, .parquet or .csv; SETTINGS with .csv if not given.",
            show_default=False,
        ),
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option(
            "--threads",
            metavar="NUMBER",
            min=1,
            help="Threads on this machine; all cores if not given.",
            show_default=False,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Run on the workers of a Dask scheduler, tcp://HOST:PORT.",
            show_default=False,
        ),
    ] = None,
    plot: Annotated[
        list[Path] | None,
        typer.Option(
            "--plot",
            metavar="FILE",
            help="Draw the Sobol indices of a saltelli sweep, results over parameters of any other: "
            ".png, .pdf or .svg; repeatable.",
            show_default=False,
        ),
    ] = None,
    scatter: Annotated[
        list[Path] | None,
        typer.Option(
            "--scatter",
            metavar="FILE",
            help="Draw results over parameters, whatever the method; repeatable.",
            show_default=False,
        ),
    ] = None,
    indices: Annotated[
        Path | None,
        typer.Option("--indices", metavar="FILE", help="Write the Sobol indices as CSV.", show_default=False),
    ] = None,
    result: Annotated[
        list[str] | None,
        typer.Option(
            "--result",
            metavar="NAME",
            help="Show and draw this result, such as theta.peak1; repeatable; all if not given.",
            show_default=False,
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Begin anew, whatever has been kept and written.")
    ] = False,
) -> None:
    """Run an FMU for many values of its parameters, as a settings file says.

    What is done is kept: after Ctrl-C or a crash the same command goes on where it stopped. Runs that fail
    are counted and stand in the results with their message; the exit code is 1 only if all of them failed,
    and 130 after Ctrl-C.
    """
    if threads is not None and scheduler is not None:
        raise typer.BadParameter("give --threads or --scheduler: the workers have threads of their own")
    # SciPy and Matplotlib take a while to load, which the other commands need not wait for.
    from pyjoystick.cli.sweep_steps import Wanted, sweep_and_show

    wanted = Wanted(tuple(result or ()), tuple(plot or ()), tuple(scatter or ()), indices)
    code = sweep_and_show(settings, target, threads, scheduler, overwrite, wanted)
    if code:
        raise typer.Exit(code)
