"""``pyjoystick free-oscillation``."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from rich.table import Table

from pyjoystick import forced_motion, model, motion, runs, support
from pyjoystick.cli import options, parsing
from pyjoystick.cli.console import note_stops, output, progress_console, write, write_json, write_plot
from pyjoystick.cli.fmus import opened

if TYPE_CHECKING:
    import pandas as pd

_PEAKS_SHOWN: Final = 10
EXAMPLES: Final = """
Examples:

    pyjoystick free-oscillation --csv run.csv --plot run.png
    pyjoystick free-oscillation -a 15deg --damping power-law
    pyjoystick free-oscillation -a -0.3rad -d 3 --set J=0.012 --set b=0.006
    pyjoystick free-oscillation --parameters joystick.toml
    pyjoystick free-oscillation --json - | jq '.peaks[0]'
"""


def run(
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    duration: options.Duration = support.DEFAULT_DURATION,
    damping: options.Law = None,
    parameters_file: options.Parameters = None,
    assignments: options.Set = None,
    fmu: options.FmuFile = None,
    csv: Annotated[Path | None, options.csv("the motion")] = None,
    json: Annotated[Path | None, options.json("the peaks and what was run")] = None,
    plot: Annotated[Path | None, options.plot("displacement, velocity and acceleration")] = None,
    output_interval: options.OutputInterval = support.DEFAULT_OUTPUT_INTERVAL,
    tolerance: options.Tolerance = support.DEFAULT_TOLERANCE,
    trusted: Annotated[
        bool,
        typer.Option(
            "--trusted",
            help="Also report until when the run can be trusted, from a second run whose angle differs by "
            "the tolerance.",
        ),
    ] = False,
) -> None:
    """Release the joystick from rest, let it oscillate, and print the peaks of its motion."""
    start = parsing.parse_angle(release_angle)
    support.check_outputs(csv, json, plot)
    with (
        opened(damping, fmu, assignments, parameters_file) as (joystick, parameters),
        progress_console().status("simulating"),
    ):
        release = partial(
            runs.free_oscillation,
            start,
            fmu=joystick,
            parameters=parameters,
            duration=duration,
            tolerance=tolerance,
        )
        table = release(output_interval=output_interval)
        # Peaks between rows that are far apart would be wrong or missed.
        fine = table
        if output_interval > support.DEFAULT_OUTPUT_INTERVAL:
            fine = release(output_interval=support.DEFAULT_OUTPUT_INTERVAL)
        description = joystick.description
        until = None
        if trusted:
            until = forced_motion.trusted_until(
                joystick,
                table.index,
                theta_start=start,
                parameters=dict(model.values_for(parameters, joystick.description.variables)),
                tolerance=tolerance,
            )
    name, degrees = description.path.name, math.degrees(start)
    note_stops(abs(start), parameters)
    _print_peaks(fine, f"{name}: free oscillation from {degrees:.6g} deg ({start:.6g} rad), {duration:g} s")
    if until is not None:
        end = "the end" if math.isinf(until) else f"{until:.4g} s"
        output().print(
            f"trusted until {end}: up to there an error as large as the tolerance stays below 1 % of the "
            "largest angle"
        )
    write(csv, lambda path: motion.write_csv(table, path))
    write_json(
        json,
        lambda notes: runs.release_json(
            fine,
            description,
            parameters,
            tolerance=tolerance,
            trusted_until=until,
            notes=notes,
        ),
    )
    title = f"Free oscillation from {degrees:.6g} deg"
    write_plot(plot, lambda: support.plot_motion({name: table}, title=title))


def _print_peaks(run: pd.DataFrame, title: str) -> None:
    peaks = runs.release_peak_rows(run)
    console = output()
    console.print(title)
    if not peaks:
        console.print("the run has no peak of the displacement")
        return
    table = Table("peak", "time (s)", "displacement (deg)", "half period (s)", box=None)
    for column in table.columns:
        column.justify = "right"
    shown = peaks[:_PEAKS_SHOWN]
    for number, one in enumerate(shown, start=1):
        half_period = "" if math.isnan(one.half_period) else f"{one.half_period:.5f}"
        table.add_row(str(number), f"{one.time:.5f}", f"{math.degrees(one.theta):+.4f}", half_period)
    console.print(table)
    if len(peaks) > len(shown):
        console.print(f"and {len(peaks) - len(shown)} more")
