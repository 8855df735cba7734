"""``pyjoystick free-oscillation``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from pyjoystick.cli import options
from pyjoystick.cli.console import messages, output, print_note
from pyjoystick.cli.setup import opened
from pyjoystick.cli.stops import note_stops
from pyjoystick.support import DEFAULT_DURATION, DEFAULT_OUTPUT_INTERVAL, DEFAULT_TOLERANCE, check_outputs

if TYPE_CHECKING:
    import pandas as pd

_PEAKS_SHOWN = 10
EXAMPLES = """
Examples:

    pyjoystick free-oscillation --csv run.csv --plot run.png
    pyjoystick free-oscillation -a 15deg --damping power-law
    pyjoystick free-oscillation -a -0.3rad -d 3 --set J=0.012 --set b=0.006
    pyjoystick free-oscillation --parameters joystick.toml
"""


def run(
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    duration: options.Duration = DEFAULT_DURATION,
    damping: options.Law = None,
    parameters_file: options.Parameters = None,
    assignments: options.Set = None,
    fmu: options.FmuFile = None,
    csv: Annotated[
        Path | None,
        typer.Option(
            "--csv", metavar="FILE", help="Write the motion as CSV, in SI units.", show_default=False
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot",
            metavar="FILE",
            help="Draw displacement, velocity and acceleration: .png, .pdf or .svg.",
            show_default=False,
        ),
    ] = None,
    output_interval: options.OutputInterval = DEFAULT_OUTPUT_INTERVAL,
    tolerance: options.Tolerance = DEFAULT_TOLERANCE,
) -> None:
    """Release the joystick from rest and let it oscillate; prints the peaks of its motion."""
    # What it takes is loaded when it is wanted, so that the other commands start quickly.
    from pyjoystick.motion import write_csv
    from pyjoystick.runs import free_oscillation as released

    start = options.parse_angle(release_angle)
    if plot is not None:
        from pyjoystick.support import check_figure_path, plot_motion, save_figure

        check_figure_path(plot)
    check_outputs(csv, plot)
    with (
        opened(damping, fmu, assignments, parameters_file) as (joystick, parameters),
        messages().status("simulating"),
    ):
        table = released(
            start,
            fmu=joystick,
            parameters=parameters,
            duration=duration,
            output_interval=output_interval,
            tolerance=tolerance,
        )
        name = joystick.description.path.name
    degrees = math.degrees(start)
    note_stops(abs(start))
    _print_peaks(table, f"{name}: free oscillation from {degrees:.6g} deg ({start:.6g} rad), {duration:g} s")
    if csv is not None:
        write_csv(table, csv)
        print_note(f"wrote {csv}")
    if plot is not None:
        save_figure(plot_motion({name: table}, title=f"Free oscillation from {degrees:.6g} deg"), plot)
        print_note(f"wrote {plot}")


def _print_peaks(motion: pd.DataFrame, title: str) -> None:
    from pyjoystick.motion import find_peaks

    peaks = find_peaks(motion.index, motion["theta"], motion["omega"]) if len(motion) > 2 else None
    console = output()
    console.print(title)
    if peaks is None or peaks.empty:
        console.print("no peak of the displacement within the run")
        return
    table = Table("peak", "time (s)", "displacement (deg)", "half period (s)", box=None)
    for column in table.columns:
        column.justify = "right"
    shown = peaks.head(_PEAKS_SHOWN)
    before = math.nan
    for number, (time, value) in enumerate(zip(shown["time"], shown["value"], strict=True), start=1):
        half_period = "" if number == 1 else f"{time - before:.5f}"
        table.add_row(str(number), f"{time:.5f}", f"{math.degrees(value):+.4f}", half_period)
        before = time
    console.print(table)
    if len(peaks) > len(shown):
        console.print(f"and {len(peaks) - len(shown)} more")
