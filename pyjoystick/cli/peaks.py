"""``pyjoystick peaks``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import options

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
    columns: options.Columns = None,
    units: options.Units = None,
    released: options.Released = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    plot: Annotated[
        Path | None,
        typer.Option("--plot", metavar="FILE", help="Draw C over the peaks: .png, .pdf or .svg."),
    ] = None,
) -> None:
    """Estimate the damping from the peaks of free oscillations (eqs. 9 and 10), beside the bias of that."""
    if plot is not None:
        from pyjoystick.support import check_figure_path

        check_figure_path(plot)
    joystick = options.joystick_of(
        None, options.parse_assignments(assignments or [], "--set"), options.parameter_file(parameters)
    )
    # SciPy takes a while to load, which the other commands need not wait for.
    from pyjoystick.cli.peaks_steps import estimate_and_show

    estimate_and_show(
        records,
        joystick,
        columns=options.parse_names(columns, "--column"),
        units=options.parse_names(units, "--unit"),
        released=options.side_of(released),
        plot=plot,
    )
