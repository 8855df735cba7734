"""``pyjoystick import swing``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, model, motion
from pyjoystick.cli import options
from pyjoystick.cli.console import output, print_warning, write_json
from pyjoystick.cli.invocation import invocation
from pyjoystick.cli.parameter_updates import file_to_update, write_measured
from pyjoystick.cli.parsing import parse_angle, parse_assignments, refuse_given
from pyjoystick.cli.plausibility import require_plausible, require_uncertainties
from pyjoystick.support import ParameterError, check_outputs, positive

EXAMPLES: Final = """
Examples:

    pyjoystick import swing --time 8.09 --time 8.14 --time 8.05 --swings 10 --amplitude 10 \\
        -p joystick.toml

    pyjoystick import swing pendulum.csv -p joystick.toml --set m=0.87 --uncertainty m=0.001

Hang the joystick upside down, clear of its springs, and let it swing about its pivot.
"""
#: Quantities on which the moment of inertia depends, with their places in a parameter file.
_PLACES: Final = {"m": "body.m", "h": "body.h", "g": "gravity.g"}
_UNITS: Final = {"m": "kg", "h": "m", "g": "m/s2"}
#: Largest radius of gyration of a joystick (m).
_FARTHEST: Final = 1.0


def run(
    record: Annotated[
        Path | None, typer.Argument(metavar="RECORD.csv", help="Recorded swing: time (s), theta (deg).")
    ] = None,
    times: Annotated[
        list[float] | None,
        typer.Option("--time", metavar="SECONDS", help="Stopwatch reading; repeatable."),
    ] = None,
    swings: Annotated[
        int | None, typer.Option(min=1, help="Number of full swings per reading. Default: 1.")
    ] = None,
    amplitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Amplitude at the start of a reading, such as 10deg.")
    ] = None,
    end_amplitude: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Amplitude at the end of a reading. Default: --amplitude."),
    ] = None,
    amplitude_uncertainty: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Standard uncertainty of the amplitudes. Default: 1deg."),
    ] = None,
    reaction_time: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="Standard uncertainty common to all readings. Default: 0.05 s."),
    ] = None,
    parameters: options.ParametersToUpdate = None,
    assignments: options.Set = None,
    uncertainties: Annotated[list[str] | None, options.uncertainty("m, h or g (SI units)")] = None,
    json: Annotated[Path | None, options.json("the values and their uncertainties")] = None,
) -> None:
    """Find the moment of inertia from the pendulum period, upside down without contact (section 3.2)."""
    check_outputs(parameters, json)
    before = file_to_update(parameters)
    values = _known(before, assignments, uncertainties)
    if (record is None) == (not times):
        raise typer.BadParameter("give a recorded swing or stopwatch readings by --time")
    if record is not None:
        refuse_given(
            "is for stopwatch readings: leave it out",
            {
                "--swings": swings,
                "--amplitude": amplitude,
                "--end-amplitude": end_amplitude,
                "--amplitude-uncertainty": amplitude_uncertainty,
                "--reaction-time": reaction_time,
            },
        )
        period = laboratory.period_of_record(motion.read_record(record, free_oscillation=False))
    else:
        period = _of_readings(
            times or [],
            swings or 1,
            amplitude,
            end_amplitude,
            amplitude_uncertainty or "1deg",
            reaction_time,
        )
    found = laboratory.inertia_of_swing(period.period, values["m"], values["h"], values["g"])
    require_plausible({"J": found.value})
    _require_compact(found.value, values["m"].value)
    console = output()
    console.print(laboratory.swing_report(period), markup=False)
    console.print()
    estimates, friction = {"T (s)": period.period, "J (kg m2)": found}, None
    if period.decay is not None:
        friction = laboratory.friction_of_swing(period.decay, values["m"], values["h"], values["g"])
        estimates["T_c (N m)"] = friction
    console.print(laboratory.estimates_report(estimates), markup=False)
    if parameters is not None:
        readings = f"swing test, {len(times or [])} readings"
        source = readings if record is None else f"swing test {record.name}"
        write_measured(parameters, before, laboratory.measured_swing(found, values, source))
    write_json(json, lambda notes: laboratory.swing_json(period, found, friction, notes))


def _require_compact(inertia: float, mass: float) -> None:
    """Reject a J (kg m2) for which most of the mass (kg) would be farther from the pivot than 1 m."""
    radius = math.sqrt(inertia / mass)
    if radius > _FARTHEST and not invocation.implausible:
        allowed = f"below {_FARTHEST:g} m, as a joystick's is"
        raise model.ImplausibleError("radius of gyration", round(radius, 3), allowed, "how many --swings?")


def _known(
    file: model.ParameterFile, assignments: list[str] | None, uncertainties: list[str] | None
) -> Mapping[str, laboratory.Measured]:
    """Mass, center of mass and gravity, from the options or else from the file."""
    values = parse_assignments(assignments, "--set")
    errors = parse_assignments(uncertainties, "--uncertainty")
    for name, value in {**values, **errors}.items():
        if name not in _PLACES:
            raise ParameterError(name, value, "one of m, h, g")
    for name, value in values.items():
        positive(name, value, _UNITS[name])
    require_plausible(values)
    require_uncertainties(errors, file.joystick.to_names() | values)
    known = {}
    for name, place in _PLACES.items():
        in_file = 0.0 if name in values else file.uncertainties.get(place, 0.0)
        value = values.get(name, file.joystick.to_names()[name])
        known[name] = laboratory.Measured(value, errors.get(name, in_file))
        if known[name].uncertainty == 0.0 and name != "g":
            print_warning(
                f"{name} = {value:g} has no uncertainty and is taken as exact: --uncertainty {name}=..."
            )
    return known


def _of_readings(
    times: list[float],
    swings: int,
    first: str | None,
    last: str | None,
    uncertainty: str,
    reaction_time: float | None,
) -> laboratory.SwingPeriod:
    if first is None:
        raise typer.BadParameter("is required: the period depends on it", param_hint="--amplitude")
    for time in times:
        positive("--time", time, "s")
    error = _size(uncertainty, "--amplitude-uncertainty")
    return laboratory.period_of_readings(
        times,
        swings,
        laboratory.Measured(_size(first, "--amplitude"), error),
        None if last is None else laboratory.Measured(_size(last, "--end-amplitude"), error),
        reaction_time=laboratory.REACTION_TIME if reaction_time is None else reaction_time,
    )


def _size(text: str, option: str) -> float:
    angle = parse_angle(text, option)
    if angle < 0.0:
        raise typer.BadParameter(f"{text!r} must be 0deg or more", param_hint=option)
    return angle
