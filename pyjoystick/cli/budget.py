"""``pyjoystick budget``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import fmu, identification, laboratory, model, motion, runs
from pyjoystick.cli import options
from pyjoystick.cli.console import messages, output, print_error, print_note, write
from pyjoystick.cli.fit import DOUBTFUL, failed_checks
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
#: Quantities that may have an uncertainty, and their places in a parameter file.
_PLACES: Final = {
    "m": "body.m",
    "h": "body.h",
    "J": "body.J",
    "g": "gravity.g",
    "a": "geometry.a",
    "b": "geometry.b",
}
#: Relative uncertainties of the records, which no residual shows.
_RELATIVE: Final = ("scale", "time_base")


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
            "m, h, J, g, a or b (SI units), or scale and time_base, the relative ones of angle and clock"
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
    """Show what each measured quantity adds to the errors of a run, and of J and C fitted to releases.

    The standard errors of `pyjoystick fit` cover only the noise of the records. This command repeats the fit
    with each quantity shifted by its standard uncertainty; those of a load-deflection curve are correlated.
    """
    check_outputs(parameters, csv, json)
    angle = options.parse_angle(release_angle)
    before = model.read_parameter_file(parameters)
    errors = options.parse_assignments(uncertainties, "--uncertainty")
    bench = _bench(before, options.parse_curves(curves), errors)
    releases = motion.read_repeats(records)
    with (
        fmu.Fmu(found_or_built(runs.fmu_of_joystick(bench.joystick))) as opened,
        messages().status("fitting"),
    ):
        found, contributions = identification.fit_contributions(releases, bench, opened, release_angle=angle)
    output().print(identification.contribution_table(contributions), markup=False)
    write(csv, lambda path: write_text(path, identification.contribution_csv(contributions)))
    write(json, lambda path: write_text(path, identification.contribution_json(found, contributions)))
    names = identification.FITTED
    values = [found.value(name) for name in names]
    parts = identification.combined(contributions)
    wholes = [value * part for value, part in zip(values, parts, strict=True)]
    rounded = [model.rounded(value, whole) for value, whole in zip(values, wholes, strict=True)]
    for name, value, whole in zip(names, rounded, wholes, strict=True):
        output().print(f"{name} = {value:.9g}, standard uncertainty {whole:.2g} (SI units)")
    if not found.trusted:
        print_error(f"do not trust the fit: it failed {failed_checks(found)}; pyjoystick fit shows why")
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
    """The measurements of the file and the options; quantities without an uncertainty are reported."""
    for name, value in errors.items():
        if name not in (*_PLACES, *_RELATIVE):
            raise ParameterError(name, value, f"one of {', '.join((*_PLACES, *_RELATIVE))}")
    require_uncertainties(errors, file.joystick.to_names() | dict.fromkeys(_RELATIVE, 1.0))
    if file.law != "constant":
        raise typer.BadParameter("the file must choose constant damping", param_hint="--parameters")
    stated = {name: file.uncertainties.get(place, 0.0) for name, place in _PLACES.items()}
    exact = [name for name in ("m", "h", "a") if not errors.get(name, stated[name]) > 0.0]
    exact += [f"load curve {side}" for side in model.SIDES if side not in curves]
    exact += [name for name in _RELATIVE if not errors.get(name, 0.0) > 0.0]
    if exact:
        print_note(f"taken as exact: {', '.join(exact)}")
    return identification.Bench(
        joystick=file.joystick,
        curves=_fitted(file, curves),
        uncertainties={**stated, **{name: value for name, value in errors.items() if name in _PLACES}},
        scale=errors.get("scale", 0.0),
        time_base=errors.get("time_base", 0.0),
    )


def _fitted(
    file: model.ParameterFile, curves: dict[model.Side, Path]
) -> dict[model.Side, laboratory.LoadCurveFit]:
    """Fits of the curves, which must be those that the file was made from."""
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
