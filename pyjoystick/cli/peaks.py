"""``pyjoystick peaks``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from pyjoystick.cli import options
from pyjoystick.cli.console import messages, output, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.damping_estimate import constant_bias, estimate_damping, line_bias
from pyjoystick.damping_report import damping_report, releases_report
from pyjoystick.experiments import fmu_of_damping
from pyjoystick.measured_peaks import MeasuredPeaks, measured_peaks
from pyjoystick.parameters import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.records import read_repeats
from pyjoystick.simulated_releases import SimulatedReleases

EXAMPLES = """
Examples:

    pyjoystick peaks trial1.csv trial2.csv trial3.csv trial4.csv
    pyjoystick peaks trial*.csv --column theta=AngleX --unit theta=deg --unit time=s
    pyjoystick peaks trial1.csv --released backward --set J=0.012 --plot peaks.png
"""


def run(
    records: Annotated[
        list[Path],
        typer.Argument(metavar="RECORD.csv...", help="One file a repeat: columns time (s), theta (deg)."),
    ],
    columns: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help="Where time, theta or omega is found."),
    ] = None,
    units: Annotated[
        list[str] | None,
        typer.Option("--unit", metavar="NAME=UNIT", help="Unit of a column that has none in its heading."),
    ] = None,
    released: Annotated[
        str | None,
        typer.Option(metavar="SIDE", help="forward or backward: other records are refused."),
    ] = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    plot: Annotated[
        Path | None,
        typer.Option("--plot", metavar="FILE", help="Draw C over the peaks: .png, .pdf or .svg."),
    ] = None,
) -> None:
    """Estimate the damping from the peaks of free oscillations (eqs. 9 and 10), beside the bias of that."""
    if released not in (None, "forward", "backward"):
        raise typer.BadParameter(f"{released!r} must be forward or backward", param_hint="--released")
    if plot is not None:
        from pyjoystick.plots import check_figure_path

        check_figure_path(plot)
    joystick = options.joystick_of(
        None, options.parse_assignments(assignments or [], "--set"), options.parameter_file(parameters)
    )
    found = read_repeats(
        records,
        columns=options.parse_names(columns, "--column"),
        units=options.parse_names(units, "--unit"),
        released=released,  # type: ignore[arg-type]  # it was checked above
    )
    for record in found:
        for note in record.notes:
            print_note(f"{record.name}: {note}")
    releases = [measured_peaks(record) for record in found]
    estimate = estimate_damping(releases, joystick.J)
    for law in (NOMINAL, NOMINAL_POWER_LAW):
        found_or_built(fmu_of_damping(law.damping))
    with SimulatedReleases() as simulate, messages().status("simulating"):
        constants = constant_bias(estimate, joystick, _mean_angle(releases), simulate)
        lines = line_bias(estimate, joystick, _mean_angle(releases), simulate)
    console = output()
    console.print(releases_report(releases))
    console.print()
    console.print(damping_report(estimate, constants, lines))
    if plot is not None:
        from pyjoystick.damping_plots import plot_damping_estimate
        from pyjoystick.plots import save_figure

        save_figure(plot_damping_estimate(estimate, constant=constants["both"].corrected), plot)
        print_note(f"wrote {plot}")


def _mean_angle(releases: Sequence[MeasuredPeaks]) -> float:
    return float(np.mean([release.release_angle for release in releases]))
