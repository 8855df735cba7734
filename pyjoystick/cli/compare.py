"""``pyjoystick compare``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated

import typer
from rich.table import Table

from pyjoystick import experiments
from pyjoystick.cli import options
from pyjoystick.cli.console import messages, output
from pyjoystick.cli.setup import opened
from pyjoystick.comparison import Difference, within_limits
from pyjoystick.comparison import compare as compare_tables
from pyjoystick.fmu import DEFAULT_TOLERANCE

_DEFAULT_LIMITS = ["theta=1e-7"]
EXAMPLES = """
Examples:

    pyjoystick compare
    pyjoystick compare --damping power-law --limit theta=1e-7 --limit E=1e-8
    pyjoystick compare --fmu other/Joystick.fmu -a 15deg --set damping.C=0.06
"""


def run(
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    duration: options.Duration = experiments.DEFAULT_DURATION,
    damping: options.Law = None,
    assignments: options.Set = None,
    fmu: options.FmuFile = None,
    limit: Annotated[
        list[str],
        typer.Option(
            "--limit",
            "-l",
            metavar="NAME=VALUE",
            help="Largest difference allowed in a variable, in SI units; repeatable.",
        ),
    ] = _DEFAULT_LIMITS,
    output_interval: options.OutputInterval = experiments.DEFAULT_OUTPUT_INTERVAL,
    tolerance: options.Tolerance = DEFAULT_TOLERANCE,
) -> None:
    """Compare the FMU with the pure-Python reference over a free oscillation.

    Prints the largest difference of every variable; the exit code is 1 where one exceeds its limit.
    """
    start = options.parse_angle(release_angle)
    limits = options.parse_assignments(limit, "--limit")
    with opened(damping, fmu, assignments) as (joystick, parameters), messages().status("") as status:
        status.update(f"running {joystick.description.path.name}")
        table = experiments.free_oscillation(
            start,
            fmu=joystick,
            parameters=parameters,
            duration=duration,
            output_interval=output_interval,
            tolerance=tolerance,
        )
        status.update("integrating the reference")
        expected = experiments.reference_free_oscillation(
            start, parameters=parameters, duration=duration, output_interval=output_interval
        )
        name = joystick.description.path.name
    differences = compare_tables(table, expected, limits=limits)
    _print_differences(
        differences,
        f"{name} against the reference: free oscillation from {math.degrees(start):.6g} deg, "
        f"{duration:g} s, tolerance {tolerance:g}",
    )
    if not within_limits(differences):
        raise typer.Exit(1)


def _print_differences(differences: Sequence[Difference], title: str) -> None:
    console = output()
    console.print(title)
    table = Table("variable", "unit", "largest difference", "relative", "at (s)", "limit", "", box=None)
    for column in table.columns[2:6]:
        column.justify = "right"
    for one in differences:
        limit = "" if one.limit is None else f"{one.limit:.1e}"
        verdict = "" if one.limit is None else ("ok" if one.within_limit else "[bold red]exceeded[/bold red]")
        numbers = (f"{one.largest:.2e}", f"{one.relative:.1e}", f"{one.time:.4g}")
        table.add_row(one.variable, one.unit, *numbers, limit, verdict)
    console.print(table)
