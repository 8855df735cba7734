"""``pyjoystick budget``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from pyjoystick.cli.console import messages, output, print_error, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import (
    DEFAULT_RELEASE_ANGLE,
    ReleaseAngle,
    parse_angle,
    parse_assignments,
    parse_names,
)
from pyjoystick.cli.parameter_updates import write_update
from pyjoystick.model import SIDES, ParameterFile, Side, law_name, read_parameter_file, rounded
from pyjoystick.support import ParameterError, check_outputs

if TYPE_CHECKING:
    from pyjoystick.identification import Bench
    from pyjoystick.laboratory import LoadCurveFit

EXAMPLES = """
Examples:

    pyjoystick budget trial1.csv trial2.csv -p joystick.toml --curve forward=forward.csv \\
        --curve backward=backward.csv --uncertainty a=1e-5 --uncertainty scale=0.002 --update

docs/your-joystick.md shows it at the end of the way from the bench to the fit.
"""
#: Places in a parameter file of what may be uncertain.
_PLACES: Final = {
    "m": "body.m",
    "h": "body.h",
    "J": "body.J",
    "g": "gravity.g",
    "a": "geometry.a",
    "b": "geometry.b",
}


def run(
    records: Annotated[
        list[Path],
        typer.Argument(metavar="RECORD.csv...", help="One file a release: columns time (s), theta (deg)."),
    ],
    parameters: Annotated[
        Path,
        typer.Option(
            "--parameters",
            "-p",
            metavar="FILE",
            help="The joystick, with constant damping and the uncertainties that it states.",
        ),
    ],
    curves: Annotated[
        list[str] | None,
        typer.Option("--curve", metavar="SIDE=FILE.csv", help="A load-deflection curve that is in the file."),
    ] = None,
    uncertainties: Annotated[
        list[str] | None,
        typer.Option(
            "--uncertainty",
            metavar="NAME=VALUE",
            help="Standard uncertainty of m, h, J, g, a, b (SI) or of the angle's scale, in parts of it.",
        ),
    ] = None,
    release_angle: ReleaseAngle = DEFAULT_RELEASE_ANGLE,
    update: Annotated[
        bool, typer.Option("--update", help="Write J and C with their whole uncertainty into the file.")
    ] = False,
) -> None:
    """Say what each measured quantity adds to the errors of a run, and of J and C fitted to releases.

    The standard errors of `pyjoystick fit` have the noise of the records alone. This fits J and C again with
    each quantity moved by its uncertainty, those of a load-deflection curve with their correlations.
    """
    check_outputs(parameters)
    angle = parse_angle(release_angle)
    before = read_parameter_file(parameters)
    errors = parse_assignments(uncertainties or [], "--uncertainty")
    files = {side: Path(file) for side, file in parse_names(curves, "--curve").items()}
    # SciPy and lmfit take a while to load, which the other commands need not wait for.
    from pyjoystick.cli.fit_steps import DOUBTFUL
    from pyjoystick.fmu import Fmu
    from pyjoystick.identification import FITTED, combined, contribution_table, fit_contributions
    from pyjoystick.motion import read_repeats

    bench = _bench(before, files, errors)
    releases = read_repeats(records)
    with Fmu(found_or_built("Joystick")) as fmu, messages().status("fitting with each quantity moved"):
        found, contributions = fit_contributions(releases, bench, fmu, release_angle=angle)
    output().print(contribution_table(contributions), markup=False)
    values = [found.value(name) for name in FITTED]
    wholes = [value * part for value, part in zip(values, combined(contributions), strict=True)]
    for name, value, whole in zip(FITTED, values, wholes, strict=True):
        output().print(f"{name} = {rounded(value, whole):.9g}, standard uncertainty {whole:.2g} (SI units)")
    if not found.trusted:
        failed = ", ".join(check.name for check in found.checks if not check.passed)
        print_error(f"the fit is not to be trusted: {failed}; pyjoystick fit says why")
        raise typer.Exit(DOUBTFUL)
    if update:
        changes = {n: rounded(v, u) for n, v, u in zip(FITTED, values, wholes, strict=True)}
        places = dict(zip(("body.J", "damping.constant.C"), wholes, strict=True))
        source = f"fit to {', '.join(path.name for path in records)}, uncertainty from the budget"
        joystick = bench.joystick.replace(changes)
        write_update(parameters, joystick, places, {"body": source, "damping.constant": source})


def _bench(file: ParameterFile, curves: dict[str, Path], errors: dict[str, float]) -> Bench:
    """What the file and the options say, with notes on what is taken as exact."""
    from pyjoystick.identification import Bench

    for name, value in errors.items():
        if name not in (*_PLACES, "scale"):
            raise ParameterError(name, value, f"one of {', '.join(_PLACES)}, scale")
    if law_name(file.joystick.damping) != "constant":
        raise typer.BadParameter("the file must choose constant damping", param_hint="--parameters")
    stated = {name: file.uncertainties.get(place, 0.0) for name, place in _PLACES.items()}
    exact = [name for name in ("m", "h", "a") if not errors.get(name, stated[name]) > 0.0]
    exact += [f"load curve {side}" for side in SIDES if side not in curves]
    if not errors.get("scale", 0.0) > 0.0:
        exact.append("scale")
    if exact:
        print_note(f"taken as exact: {', '.join(exact)}")
    return Bench(
        joystick=file.joystick,
        curves=_fitted(file, curves),
        uncertainties={**stated, **{name: value for name, value in errors.items() if name != "scale"}},
        scale=errors.get("scale", 0.0),
    )


def _fitted(file: ParameterFile, curves: dict[str, Path]) -> dict[Side, LoadCurveFit]:
    """The fits of the curves, which must be those that the file has."""
    from pyjoystick.laboratory import fit_load_curve, read_load_curve

    found: dict[Side, LoadCurveFit] = {}
    for name, path in curves.items():
        side = next((one for one in SIDES if one == name), None)
        if side is None:
            raise typer.BadParameter(f"{name!r} must be forward or backward", param_hint="--curve")
        found[side] = fit = fit_load_curve(read_load_curve(path))
        known = file.curves[side]
        errors = (*fit.x_errors, *fit.k_errors)
        pairs = zip((*fit.table.x, *fit.table.k), (*known.x, *known.k), errors, strict=True)
        if any(abs(value - written) > error for value, written, error in pairs):
            what = f"{path} is not the curve that [{side}] of {file.path} is from"
            raise typer.BadParameter(f"{what}; import it first", param_hint="--curve")
    return found
