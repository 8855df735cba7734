"""``pyjoystick export``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Literal

import typer

from pyjoystick import model, reports
from pyjoystick.cli import joystick_choice, options
from pyjoystick.cli.console import print_progress, print_warning, progress_console, write
from pyjoystick.cli.invocation import invocation
from pyjoystick.support import write_text

EXAMPLES = """
Examples:

    pyjoystick export -p joystick.toml -o fmus
    pyjoystick export -p joystick.toml -o fmus --fit fit/fit.json
    pyjoystick export -p joystick.toml -o fmus --name LeftStick --fmi 3 --platform all
    pyjoystick export -p joystick.toml -o model --no-fmu --modelica --json
"""


def run(
    folder: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="FOLDER", help="Folder for the files.", show_default=False),
    ],
    parameters: options.Parameters = None,
    damping: options.Law = None,
    name: Annotated[
        str | None,
        typer.Option(
            "--name",
            metavar="NAME",
            help="Name of the FMUs; by default that of the parameter file.",
            show_default=False,
        ),
    ] = None,
    fmi: Annotated[Literal["2", "3"], typer.Option("--fmi", help="Version of the FMI standard.")] = "2",
    platforms: Annotated[
        list[str] | None,
        typer.Option(
            "--platform",
            metavar="PLATFORM",
            help="Platform such as x86_64-windows, or all; repeatable. Default: this machine's.",
            show_default=False,
        ),
    ] = None,
    fit: Annotated[
        Path | None,
        typer.Option(
            "--fit",
            metavar="FILE",
            help="fit.json of the fit that the values come from, for the documentation of the FMUs.",
        ),
    ] = None,
    fmus: Annotated[bool, typer.Option("--fmu/--no-fmu", help="Build the FMUs.")] = True,
    modelica: Annotated[
        bool, typer.Option("--modelica", help="Write a Modelica class that extends the library's joystick.")
    ] = False,
    ssp: Annotated[
        bool,
        typer.Option(
            "--ssp", help="Write an SSP archive of the FMU, with its values and uncertainties (SSV)."
        ),
    ] = False,
    json: Annotated[
        bool,
        typer.Option(
            "--json", help="Write the parameters as JSON, by FMU name, with units and uncertainties."
        ),
    ] = False,
) -> None:
    """Write a joystick as FMUs with its parameters as start values, for use in other tools.

    FMU NAME computes the motion from the torque, NAMEInverse the torque from the motion.
    """
    if ssp and not fmus:
        raise typer.BadParameter("needs the FMU, which --no-fmu leaves out", param_hint="--ssp")
    if not (fmus or modelica or json):
        raise typer.BadParameter("leaves nothing to write; add --modelica or --json", param_hint="--no-fmu")
    file = joystick_choice.parameter_file(parameters)
    own = reports.check_name(name or reports.default_name(file))
    law = damping or file.law
    values = model.fmu_values(file, law)
    more = "" if fit is None else reports.fit_page(fit, values)
    if modelica:
        text = reports.modelica_class(own, values, law=law, title=file.title, more=more)
        write(folder / f"{own}.mo", lambda path: write_text(path, text))
    if json:
        write(
            folder / f"{own}.json",
            lambda path: write_text(path, model.values_json(file, law, invocation.notes)),
        )
    if fmus:
        with progress_console().status(f"building {own}") as status:
            built = reports.export_fmus(
                file,
                folder,
                name=own,
                law=law,
                fmi_version="3.0" if fmi == "3" else "2.0",
                platforms=platforms or (),
                fit=fit,
                on_stage=status.update,
            )
        for path in built:
            print_progress(f"wrote {path}")
        if file.joystick.stops:
            limit = math.degrees(file.joystick.stops.theta_stop)
            print_warning(f"{built[-1].name} has no stops: its torque is valid up to {limit:.6g} degrees")
        write(
            folder / f"{own}.ssp" if ssp else None,
            lambda path: reports.export_ssp(file, built[0], path, law=law),
        )
