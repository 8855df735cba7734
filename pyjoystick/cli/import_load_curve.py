"""``pyjoystick import load-curve``."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pyjoystick.cli.console import output, print_note
from pyjoystick.cli.options import SideName, Units, parse_names
from pyjoystick.cli.parameter_updates import file_to_update, write_update
from pyjoystick.model import PAPER, ActuatorAssembly, JoystickParameters, rounded
from pyjoystick.support import ParameterError, check_outputs

if TYPE_CHECKING:
    from pyjoystick.laboratory import LoadCurveFit

EXAMPLES = """
Examples:

    pyjoystick import load-curve forward.csv --side forward --parameters joystick.toml --plot forward.png

    pyjoystick import load-curve forward.csv --column travel=Extension --column force=Load --unit force=kN

docs/parameters-from-measurements.md describes the file and the fit.
"""


def run(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.csv", help="One cycle: columns travel (mm), force (N).")
    ],
    side: Annotated[
        SideName | None,
        typer.Option("--side", help="Where it goes in --parameters.", show_default=False),
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(
            "--parameters",
            "-p",
            metavar="FILE",
            help="Parameter file to write the curve to; a new one begins as the paper's.",
            show_default=False,
        ),
    ] = None,
    segments: Annotated[int, typer.Option(min=1, max=12, help="Number of straight segments.")] = 4,
    columns: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help="Where travel or force is found."),
    ] = None,
    units: Units = None,
    travel_noise: Annotated[
        float | None,
        typer.Option(metavar="METRES", help="Standard deviation of travel; from its scatter if not given."),
    ] = None,
    force_noise: Annotated[
        float | None,
        typer.Option(metavar="NEWTON", help="Standard deviation of force; from its scatter if not given."),
    ] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", metavar="FILE", help="Draw curve and fit: .png, .pdf or .svg.")
    ] = None,
) -> None:
    """Fit straight segments to a load-deflection curve, which gives the springs of one side (Table 1)."""
    if (side is None) != (parameters is None):
        raise typer.BadParameter("give --side and --parameters together")
    if parameters is not None and segments != 4:
        raise typer.BadParameter("a parameter file has four segments a side", param_hint="--segments")
    # SciPy and Matplotlib take a while to load, which the other commands need not wait for.
    from pyjoystick.laboratory import fit_load_curve, load_curve_report, plot_load_curve, read_load_curve
    from pyjoystick.support import check_figure_path, save_figure

    if plot is not None:
        check_figure_path(plot)
    check_outputs(parameters, plot)
    before = PAPER if parameters is None else file_to_update(parameters)
    curve = read_load_curve(
        file, columns=parse_names(columns, "--column"), units=parse_names(units, "--unit")
    )
    fit = fit_load_curve(curve, segments, travel_noise=travel_noise, force_noise=force_noise)
    for note in fit.notes:
        print_note(f"{file}: {note}")
    output().print(load_curve_report(fit), markup=False)
    if plot is not None:
        save_figure(plot_load_curve(fit, title=f"Load-deflection curve, {file.name}"), plot)
        print_note(f"wrote {plot}")
    if parameters is not None and side is not None:
        joystick = _with_side(before.joystick, side, fit)
        write_update(parameters, joystick, _errors(side, fit), {side: f"load-deflection curve {file.name}"})


def _with_side(joystick: JoystickParameters, side: SideName, fit: LoadCurveFit) -> JoystickParameters:
    x = [rounded(value, error) for value, error in zip(fit.table.x, fit.x_errors, strict=True)]
    k = [rounded(value, error) for value, error in zip(fit.table.k, fit.k_errors, strict=True)]
    try:
        assembly = ActuatorAssembly.from_table(x, k)
    except ParameterError as error:
        raise error.within(side) from None
    if side is SideName.FORWARD:
        return dataclasses.replace(joystick, forward=assembly)
    return dataclasses.replace(joystick, backward=assembly)


def _errors(side: str, fit: LoadCurveFit) -> dict[str, float]:
    return {
        f"{side}.{key}[{i}]": float(error)
        for key, errors in (("x", fit.x_errors), ("k", fit.k_errors))
        for i, error in enumerate(errors)
    }
