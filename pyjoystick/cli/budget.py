"""``pyjoystick budget``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import fmu, identification, laboratory, model, motion
from pyjoystick.cli import options, parsing
from pyjoystick.cli.console import output, print_error, print_warning, progress_console, write, write_json
from pyjoystick.cli.fit import DOUBTFUL
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.parameter_updates import write_update
from pyjoystick.cli.plausibility import require_uncertainties
from pyjoystick.support import ParameterError, check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick budget trial1.csv trial2.csv -p joystick.toml --curve forward=forward.csv \\
        --curve backward=backward.csv --uncertainty a=1e-5 --uncertainty scale=0.002 \\
        --uncertainty time_base=1e-4 --update

The parameter file must come from the same curves (`pyjoystick import load-curve`).
"""


def run(
    records: options.Records,
    parameters: Annotated[
        Path,
        typer.Option(
            "--parameters",
            "-p",
            metavar="FILE",
            help="Parameter file of the joystick, with constant damping; its uncertainties are used.",
        ),
    ],
    curves: Annotated[
        list[str] | None,
        typer.Option(
            "--curve",
            metavar="SIDE=FILE.csv",
            help="Load-deflection curve of one side; repeatable.",
        ),
    ] = None,
    uncertainties: Annotated[
        list[str] | None,
        options.uncertainty(
            "m, h, J, g, a, b, friction.T_c, friction.F_c, friction.T_s or friction.omega_s (SI units), or "
            "scale, time_base or force_scale (relative: of the angle, the clock and the load cell)"
        ),
    ] = None,
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    update: Annotated[
        bool,
        typer.Option("--update", help="Save J and C with their combined uncertainties."),
    ] = False,
    csv: Annotated[Path | None, options.csv("the table")] = None,
    json: Annotated[Path | None, options.json("the table and the fitted values")] = None,
) -> None:
    """Show how much each measured quantity adds to the errors of a run, and of J and C fitted to releases.

    The standard errors of `pyjoystick fit` cover only the noise of the records. This command repeats the fit
    with each quantity shifted by its standard uncertainty; those of a load-deflection curve are correlated.
    """
    check_outputs(parameters, csv, json)
    angle = parsing.parse_angle(release_angle)
    before = model.read_parameter_file(parameters)
    errors = parsing.parse_assignments(uncertainties, "--uncertainty")
    bench = _bench(before, parsing.parse_curves(curves), errors)
    releases = motion.read_repeats(records, counted=False)
    with (
        fmu.Fmu(found_or_built(bench.fmu)) as opened,
        progress_console().status("fitting"),
    ):
        found, contributions = identification.fit_contributions(releases, bench, opened, release_angle=angle)
    output().print(identification.contribution_table(contributions), markup=False)
    write(csv, lambda path: write_text(path, identification.contribution_csv(contributions)))
    write_json(
        json,
        lambda notes: identification.contribution_json(found, contributions, bench.exact, notes),
    )
    names = identification.FITTED
    values = [found.value(name) for name in names]
    parts = identification.combined(contributions)
    wholes = [value * part for value, part in zip(values, parts, strict=True)]
    rounded = [model.rounded(value, whole) for value, whole in zip(values, wholes, strict=True)]
    for name, value, whole in zip(names, rounded, wholes, strict=True):
        output().print(f"{name} = {value:.9g}, standard uncertainty {whole:.2g} (SI units)")
    if not found.trusted:
        failed = ", ".join(found.failed)
        print_error(f"do not trust the fit: it failed {failed}; pyjoystick fit shows why")
        raise typer.Exit(DOUBTFUL)
    if update:
        changes = dict(zip(names, rounded, strict=True))
        places = dict(zip(("body.J", "damping.constant.C"), wholes, strict=True))
        source = f"fit to {', '.join(path.name for path in records)}, uncertainty from the budget"
        joystick = bench.joystick.replace(changes)
        write_update(parameters, joystick, places, {"body": source, "damping.constant": source})


def _bench(
    file: model.ParameterFile, curves: dict[model.Side, Path], errors: dict[str, float]
) -> identification.Bench:
    """Bench measurements from the file and the options; reports quantities without an uncertainty."""
    allowed = (*identification.UNCERTAIN, *identification.OF_INSTRUMENTS)
    for name, value in errors.items():
        if name not in allowed:
            raise ParameterError(name, value, f"one of {', '.join(allowed)}")
    relative = dict.fromkeys(identification.OF_INSTRUMENTS, 1.0)
    require_uncertainties(errors, file.joystick.to_names() | relative)
    if file.law != "constant":
        raise typer.BadParameter("the file must choose constant damping", param_hint="--parameters")
    given = {name: value for name, value in errors.items() if name in identification.UNCERTAIN}
    bench = identification.Bench(
        joystick=file.joystick,
        curves=_fitted(file, curves),
        uncertainties=identification.stated_uncertainties(file) | given,
        **{name: errors.get(name, 0.0) for name in relative},
    )
    if bench.exact:
        print_warning(f"taken as exact: {', '.join(bench.exact)}")
    return bench


def _fitted(
    file: model.ParameterFile, curves: dict[model.Side, Path]
) -> dict[model.Side, laboratory.LoadCurveFit]:
    """Fits of the curves; they must be those that the file was made from."""
    found: dict[model.Side, laboratory.LoadCurveFit] = {}
    for side, path in curves.items():
        found[side] = fit = laboratory.fit_load_curve(laboratory.read_load_curve(path))
        known = file.curves[side]
        errors = (*fit.x_errors, *fit.k_errors)
        pairs = zip((*fit.table.x, *fit.table.k), (*known.x, *known.k), errors, strict=True)
        if any(abs(value - written) > error for value, written, error in pairs):
            what = f"[{side}] of {file.path} does not come from {path}"
            raise typer.BadParameter(f"{what}; import it first", param_hint="--curve")
    return found
