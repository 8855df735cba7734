"""``pyjoystick fit``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli.options import Columns, DampingLaw, Parameters, Units, parse_names

EXAMPLES = """
Examples:

    pyjoystick fit trial1.csv trial2.csv trial3.csv trial4.csv
    pyjoystick fit trial*.csv --damping power-law --output results/fit
    pyjoystick fit trial*.csv --settings fit.toml --output results/fit
    pyjoystick fit trial*.csv --parameters joystick.toml --update

docs/fitting.md describes the settings file.
"""


def run(
    records: Annotated[
        list[Path],
        typer.Argument(metavar="RECORD.csv...", help="One file a release: columns time (s), theta (deg)."),
    ],
    settings: Annotated[
        Path | None,
        typer.Option(
            "--settings",
            metavar="FILE",
            help="What to fit and how, a TOML file; the damping and the release of each record if not given.",
            show_default=False,
        ),
    ] = None,
    damping: Annotated[
        DampingLaw | None,
        typer.Option(
            "--damping",
            help="Damping law to fit; that of --parameters or constant if not given.",
            show_default=False,
        ),
    ] = None,
    parameters: Parameters = None,
    update: Annotated[
        bool,
        typer.Option(
            "--update",
            help="Write the result into the file of --parameters, if every check is passed; a new one "
            "begins as the paper's.",
        ),
    ] = False,
    even_if_doubtful: Annotated[
        bool,
        typer.Option("--even-if-doubtful", help="Have --update write a result that is not to be trusted."),
    ] = False,
    target: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FOLDER",
            help="Write fit.md, fit.json and the figures there.",
            show_default=False,
        ),
    ] = None,
    columns: Columns = None,
    units: Units = None,
) -> None:
    """Fit parameters to measured motion, and say how sure the answer is.

    The exit code is 3 where the fit is done but not to be trusted; the reasons are printed. It is 130 after
    Ctrl-C; what was found until then is printed and written.
    """
    if settings is not None and damping is not None:
        raise typer.BadParameter("give --settings or --damping: the settings name the FMU themselves")
    if update and parameters is None:
        raise typer.BadParameter("needs --parameters, the file to write to", param_hint="--update")
    if even_if_doubtful and not update:
        raise typer.BadParameter("is for --update", param_hint="--even-if-doubtful")
    # SciPy, lmfit and Matplotlib take a while to load, which the other commands need not wait for.
    from pyjoystick.cli.fit_steps import Wanted, fit_and_show

    wanted = Wanted(target, parameters if update else None, even_if_doubtful)
    code = fit_and_show(
        records,
        settings,
        damping,
        parameters,
        wanted,
        columns=parse_names(columns, "--column"),
        units=parse_names(units, "--unit"),
    )
    if code:
        raise typer.Exit(code)
