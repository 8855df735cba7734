"""``pyjoystick import swing`` and ``pyjoystick import parts``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pyjoystick.cli.console import output, print_note
from pyjoystick.cli.options import Set, parse_angle, parse_assignments
from pyjoystick.cli.parameter_updates import file_to_update, write_update
from pyjoystick.model import PAPER, ParameterFile, rounded
from pyjoystick.support import ParameterError, check_outputs

if TYPE_CHECKING:
    from pyjoystick.laboratory import Estimate, Measured, SwingPeriod

SWING_EXAMPLES = """
Examples:

    pyjoystick import swing --time 8.09 --time 8.14 --time 8.05 --swings 10 --amplitude 10 -p joystick.toml

    pyjoystick import swing pendulum.csv -p joystick.toml --set m=0.87 --uncertainty m=0.001

docs/parameters-from-measurements.md describes the test.
"""
PARTS_EXAMPLES = """
Examples:

    pyjoystick import parts parts.csv -p joystick.toml

The headings are part, mass (g), height (mm), inertia (g.cm2), and perhaps offset (mm), u_mass (g) and so on.
"""
_PLACES = {"m": "body.m", "h": "body.h", "g": "gravity.g"}

Target = Annotated[
    Path | None,
    typer.Option(
        "--parameters",
        "-p",
        metavar="FILE",
        help="Parameter file to take m, h and g from and to write to; a new one begins as the paper's.",
        show_default=False,
    ),
]


def swing(
    record: Annotated[
        Path | None, typer.Argument(metavar="[RECORD.csv]", help="A recorded swing: time (s), theta (deg).")
    ] = None,
    times: Annotated[
        list[float] | None,
        typer.Option("--time", metavar="SECONDS", help="A stopwatch reading; repeatable."),
    ] = None,
    swings: Annotated[int, typer.Option(min=1, help="Full swings in a reading.")] = 1,
    amplitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Amplitude at the start of a reading: 10deg.")
    ] = None,
    end_amplitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Amplitude at its end; the same if not given.")
    ] = None,
    amplitude_uncertainty: Annotated[
        str, typer.Option(metavar="ANGLE", help="Standard uncertainty of the amplitudes.")
    ] = "1deg",
    reaction_time: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="Standard uncertainty that all readings share; 0.05 s."),
    ] = None,
    parameters: Target = None,
    assignments: Set = None,
    uncertainty: Annotated[
        list[str] | None,
        typer.Option("--uncertainty", metavar="NAME=VALUE", help="Standard uncertainty of m, h or g (SI)."),
    ] = None,
) -> None:
    """Moment of inertia from the period as a pendulum, hung upside down without contact (section 3.2)."""
    from pyjoystick.laboratory import inertia_of_swing

    check_outputs(parameters)
    before = PAPER if parameters is None else file_to_update(parameters)
    values = _known(before, assignments, uncertainty)
    if (record is None) == (not times):
        raise typer.BadParameter("give a recorded swing or stopwatch readings by --time")
    if record is not None:
        period = _of_record(record)
    else:
        period = _of_readings(
            times or [], swings, amplitude, end_amplitude, amplitude_uncertainty, reaction_time
        )
    found = inertia_of_swing(period.period, values["m"], values["h"], values["g"])
    output().print(_period_text(period), markup=False)
    _print_budget({"T (s)": period.period, "J (kg m2)": found})
    if parameters is not None:
        source = (
            f"swing test {record.name}" if record is not None else f"swing test, {len(times or [])} readings"
        )
        changed = {name: one.value for name, one in values.items()}
        joystick = before.joystick.replace(changed | {"J": rounded(found.value, found.uncertainty)})
        errors = {_PLACES[name]: one.uncertainty for name, one in values.items() if one.uncertainty > 0.0}
        write_update(parameters, joystick, errors | {"body.J": found.uncertainty}, {"body": source})


def parts(
    file: Annotated[Path, typer.Argument(metavar="PARTS.csv", help="One part a row.")],
    parameters: Target = None,
) -> None:
    """Mass, center of mass and moment of inertia from the parts, by the parallel-axis theorem."""
    from pyjoystick.laboratory import from_parts, read_parts

    check_outputs(parameters)
    before = PAPER if parameters is None else file_to_update(parameters)
    found = from_parts(read_parts(file))
    for note in found.notes:
        print_note(f"{file}: {note}")
    estimates = {"m (kg)": found.m, "h (m)": found.h, "J (kg m2)": found.J}
    _print_budget(estimates)
    if parameters is not None:
        by_name = {name.split()[0]: one for name, one in estimates.items()}
        values = {name: rounded(one.value, one.uncertainty) for name, one in by_name.items()}
        errors = {f"body.{name}": one.uncertainty for name, one in by_name.items() if one.uncertainty > 0.0}
        write_update(parameters, before.joystick.replace(values), errors, {"body": f"parts {file.name}"})


def _known(
    file: ParameterFile, assignments: list[str] | None, uncertainty: list[str] | None
) -> Mapping[str, Measured]:
    """The mass, its center and gravity: from the options, else from the file."""
    from pyjoystick.laboratory import Measured

    values = parse_assignments(assignments or [], "--set")
    errors = parse_assignments(uncertainty or [], "--uncertainty")
    for name, value in {**values, **errors}.items():
        if name not in _PLACES:
            raise ParameterError(name, value, "one of m, h, g")
    known = {}
    for name, place in _PLACES.items():
        in_file = 0.0 if name in values else file.uncertainties.get(place, 0.0)
        value = values.get(name, file.joystick.to_names()[name])
        known[name] = Measured(value, errors.get(name, in_file))
        if known[name].uncertainty == 0.0 and name != "g":
            print_note(
                f"{name} = {value:g} has no uncertainty and is taken as exact: --uncertainty {name}=..."
            )
    return known


def _of_record(path: Path) -> SwingPeriod:
    from pyjoystick.laboratory import period_of_record
    from pyjoystick.motion import read_record

    return period_of_record(read_record(path, free_oscillation=False))


def _of_readings(
    times: list[float],
    swings: int,
    first: str | None,
    last: str | None,
    uncertainty: str,
    reaction_time: float | None,
) -> SwingPeriod:
    from pyjoystick.laboratory import REACTION_TIME, Measured, period_of_readings

    if first is None:
        raise typer.BadParameter("is needed: the period grows with it", param_hint="--amplitude")
    error = parse_angle(uncertainty, "--amplitude-uncertainty")
    return period_of_readings(
        times,
        swings,
        Measured(parse_angle(first, "--amplitude"), error),
        None if last is None else Measured(parse_angle(last, "--end-amplitude"), error),
        reaction_time=REACTION_TIME if reaction_time is None else reaction_time,
    )


def _period_text(found: SwingPeriod) -> str:
    small = found.period
    damping = found.damping_ratio
    decay = (
        ""
        if damping is None
        else f", damping ratio {damping.value:.5f} (standard error {damping.uncertainty:.1g})"
    )
    return (
        f"Period {found.measured:.6g} s as measured; the amplitude lengthens it by "
        f"{100.0 * (found.amplitude_factor - 1.0):.3g} %{decay}.\n"
        f"Period T of small undamped swings {small.value:.6g} s."
    )


def _print_budget(estimates: Mapping[str, Estimate]) -> None:
    from pyjoystick.support import TextTable

    rows = []
    for name, one in estimates.items():
        low, high = one.interval
        rows.append([name, f"{one.value:.6g}", f"{one.uncertainty:.2g}", f"{low:.6g} to {high:.6g}"])
        rows += [
            [f"  from {quantity}", "", f"{part:.2g}", ""]
            for quantity, part in one.budget.items()
            if part > 0.0
        ]
    console = output()
    console.print()
    console.print(
        TextTable(["", "value", "standard uncertainty", "95 % interval"], rows).markdown(), markup=False
    )
