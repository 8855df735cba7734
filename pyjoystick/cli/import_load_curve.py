"""``pyjoystick import load-curve``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, model
from pyjoystick.cli import options, parsing, table_options
from pyjoystick.cli.console import output, print_warning, print_warnings, write_json, write_plot
from pyjoystick.cli.parameter_updates import file_to_update, write_measured
from pyjoystick.cli.plausibility import require_plausible
from pyjoystick.support import check_outputs

EXAMPLES: Final = """
Examples:

    pyjoystick import load-curve forward.csv --side forward --parameters joystick.toml \\
        --plot forward.png

    pyjoystick import load-curve forward.csv --column travel=Extension --column force=Load \\
        --unit force=kN

The cycle begins before contact, with travel zero in the middle position, and goes out and back slowly.
"""


def run(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.csv", help="One cycle: columns travel (mm), force (N).")
    ],
    side: Annotated[model.Side | None, typer.Option("--side", help="Side of --parameters to update.")] = None,
    parameters: options.ParametersToUpdate = None,
    friction: Annotated[
        bool,
        typer.Option(
            "--friction",
            help="Save half the hysteresis in --parameters as well, as the dry friction along the plungers "
            "(F_c). The testing machine must have none of its own.",
        ),
    ] = False,
    segments: Annotated[int, typer.Option(min=1, max=12, help="Number of straight segments.")] = 4,
    columns: Annotated[list[str] | None, options.column("travel or force")] = None,
    units: options.Units = None,
    travel_noise: Annotated[
        float | None,
        options.quantity(
            "length",
            metavar="LENGTH",
            text="Standard deviation of travel: 1e-6 (m) or 1um. Default: from its scatter.",
        ),
    ] = None,
    force_noise: Annotated[
        float | None,
        options.quantity(
            "force",
            metavar="FORCE",
            text="Standard deviation of force: 0.05 (N) or 50mN. Default: from its scatter.",
        ),
    ] = None,
    sheet: table_options.Sheet = "",
    delimiter: table_options.Delimiter = "",
    decimal: table_options.Decimal = "",
    encoding: table_options.Encoding = "",
    json: Annotated[Path | None, options.json("segments, springs and noise")] = None,
    plot: Annotated[Path | None, options.plot("the curve and the fit")] = None,
) -> None:
    """Fit straight segments to a load-deflection curve to find the springs of one side (Table 1)."""
    if (side is None) != (parameters is None):
        raise typer.BadParameter("give --side and --parameters together")
    if friction and parameters is None:
        raise typer.BadParameter("needs --parameters, the file to save it in", param_hint="--friction")
    if parameters is not None and segments != 4:
        raise typer.BadParameter("a parameter file has four segments per side", param_hint="--segments")
    require_plausible(
        {"travel_noise": travel_noise or 0.0, "force_noise": force_noise or 0.0},
        options={"travel_noise": "--travel-noise", "force_noise": "--force-noise"},
    )
    layout = table_options.layout(delimiter, decimal, encoding, sheet)
    check_outputs(parameters, json, plot)
    before = file_to_update(parameters)
    curve = laboratory.read_load_curve(file, **parsing.parse_headings(columns, units), layout=layout)
    fit = laboratory.fit_load_curve(curve, segments, travel_noise=travel_noise, force_noise=force_noise)
    springs = {name: value for name, (value, _) in fit.springs().items()} if fit.has_springs else {}
    require_plausible(springs, options={name: f"{file}: {name}" for name in springs})
    print_warnings(file, fit.notes)
    output().print(laboratory.load_curve_report(fit), markup=False)
    title = f"Load-deflection curve, {file.name}"
    write_plot(plot, lambda: laboratory.plot_load_curve(fit, title=title))
    if parameters is not None and side is not None:
        found = laboratory.measured_springs(fit, side, f"load-deflection curve {file.name}")
        if friction:
            source = f"hysteresis of the load-deflection curve {file.name}"
            measured = laboratory.measured_friction(fit, source)
            _tell_of_replaced(before, measured)
            found = found.with_more(measured)
        write_measured(parameters, before, found)
    write_json(json, lambda notes: laboratory.load_curve_json(fit, side, notes))


def _tell_of_replaced(before: model.ParameterFile, found: laboratory.MeasuredValues) -> None:
    """Note that F_c is replaced: both sides share it."""
    old, place = before.joystick.friction.F_c, "friction.F_c"
    if old:
        origin = before.sources.get("friction") or "an unknown source"
        print_warning(f"F_c = {found.values[place]:.4g} N replaces {old:.4g} N ({origin})")
