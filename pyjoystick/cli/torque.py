"""``pyjoystick torque``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from pyjoystick import forced_motion, laboratory, model, motion, support
from pyjoystick.cli import joystick_choice, options, parsing, torque_results
from pyjoystick.cli.console import (
    note_stops,
    output,
    print_warning,
    progress_console,
    write,
    write_json,
    write_plot,
)
from pyjoystick.cli.plausibility import require_length
from pyjoystick.support import ParameterError, check_outputs

_PAPER: Final = laboratory.Chain()
_DEFAULTS: Final[Mapping[str, Any]] = {"amplitude": "15deg", "rise": 0.15, "shape": "minimum-jerk"}
#: Options of a motion in closed form, by attribute of `ForwardAndReturn`.
_OPTIONS: Final = {
    "amplitude": "--angle",
    "rise": "--stroke-time",
    "fall": "--return-time",
    "dwell": "--dwell",
    "shape": "--shape",
    "flat": "--flat",
}
EXAMPLES: Final = """
Examples:

    pyjoystick torque --angle 18deg --stroke-time 0.12 --plot torque.png

    pyjoystick torque -a -15deg --stroke-time 0.2 --dwell 0.5 --shape trapezoid --damping constant \\
        --csv torque.csv

    pyjoystick torque motion.csv --parameters joystick.toml --json torque.json

A measured motion is a CSV file with the columns time and theta and optionally omega and alpha, such as
`pyjoystick import markers --motion` writes. Without omega or alpha, the angle is filtered and differentiated
as in the paper.
"""


def run(
    record: Annotated[
        Path | None,
        typer.Argument(
            metavar="MOTION.csv",
            help="Measured motion. Default: a stroke and its return in closed form.",
        ),
    ] = None,
    angle: Annotated[
        str | None,
        typer.Option(
            "--angle",
            "-a",
            metavar="ANGLE",
            help="Amplitude of the stroke. Default: 15deg.",
        ),
    ] = None,
    stroke_time: Annotated[
        float | None,
        typer.Option("--stroke-time", metavar="SECONDS", help="Duration of the stroke. Default: 0.15."),
    ] = None,
    return_time: Annotated[
        float | None,
        typer.Option(
            "--return-time", metavar="SECONDS", help="Duration of the return. Default: --stroke-time."
        ),
    ] = None,
    dwell: Annotated[
        float | None,
        typer.Option("--dwell", metavar="SECONDS", help="Time held at the angle. Default: 0."),
    ] = None,
    shape: Annotated[
        str | None,
        typer.Option(
            "--shape",
            metavar="NAME",
            help="minimum-jerk, raised-cosine or trapezoid (velocity profile). Default: minimum-jerk.",
        ),
    ] = None,
    flat: Annotated[
        float | None,
        typer.Option(
            "--flat",
            metavar="PART",
            help="Trapezoid: fraction of the stroke at constant velocity. Default: 1/3.",
        ),
    ] = None,
    columns: Annotated[list[str] | None, options.column("time, theta, omega or alpha")] = None,
    units: options.Units = None,
    rate: Annotated[
        float | None,
        typer.Option(
            "--rate", metavar="HZ", help=f"Sampling rate after interpolation. Default: {_PAPER.rate:g}."
        ),
    ] = None,
    cutoff: Annotated[
        float | None,
        typer.Option(
            "--cutoff",
            metavar="HZ",
            help=f"Cut-off frequency of the Butterworth filter. Default: {_PAPER.low_pass.cutoff:g}.",
        ),
    ] = None,
    damping: Annotated[
        model.LawName | None,
        typer.Option("--damping", help="Damping law. Default: all laws of --parameters."),
    ] = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    arm: Annotated[
        float | None,
        options.quantity(
            "length",
            "--pivot-to-handle",
            metavar="LENGTH",
            text="Distance from the pivot to the hand: 0.266 (m) or 266mm. Default: pivot_to_top of "
            "--parameters.",
        ),
    ] = None,
    csv: Annotated[Path | None, options.csv("motion, torque and its parts")] = None,
    json: Annotated[Path | None, options.json("all numbers")] = None,
    plot: Annotated[Path | None, options.plot("the torque and its parts (Fig. 15)")] = None,
    output_interval: Annotated[
        float | None,
        typer.Option(
            "--output-interval",
            metavar="SECONDS",
            help="Time between two rows of the result for a motion in closed form. Default: "
            f"{support.DEFAULT_OUTPUT_INTERVAL:g}.",
        ),
    ] = None,
) -> None:
    """Compute the torque that a motion requires (eq. 13) with the inverse FMUs: parts, force, work, shares.

    The table of --csv is for the damping law of --damping, or else of the parameter file.
    """
    require_length("--pivot-to-handle", arm)
    check_outputs(csv, json, plot)
    given = dict(zip(_OPTIONS, (angle, stroke_time, return_time, dwell, shape, flat), strict=True))
    file = joystick_choice.parameter_file(parameters)
    changes = parsing.parse_assignments(assignments, "--set")
    joysticks = torque_results.joysticks_of(file, damping, changes)
    if record is None:
        of_a_file = {"--column": columns, "--unit": units, "--rate": rate, "--cutoff": cutoff}
        parsing.refuse_given("is for a measured motion", of_a_file)
        interval = support.DEFAULT_OUTPUT_INTERVAL if output_interval is None else output_interval
        chosen = torque_results.in_closed_form(_motion(given), interval)
    else:
        of_closed_form = {option: given[name] for name, option in _OPTIONS.items()}
        reason = "is for a motion in closed form, and MOTION.csv is a measured one"
        parsing.refuse_given(reason, {**of_closed_form, "--output-interval": output_interval})
        chosen = torque_results.from_file(
            record, _chain(rate, cutoff), **parsing.parse_headings(columns, units)
        )
        if not chosen.description["differentiated"]:
            reason = "is for a motion without omega or alpha, and MOTION.csv has both"
            parsing.refuse_given(reason, {"--rate": rate, "--cutoff": cutoff})
    for note in chosen.notes:
        print_warning(note)
    with progress_console().status("computing"):
        results = torque_results.compute(chosen, joysticks, torque_results.arm_of(file, arm))
    table = next(iter(results.values())).table
    note_stops(float(table["theta"].abs().max()), next(iter(joysticks.values())))
    output().print(torque_results.text(chosen, results), markup=False)
    write(csv, lambda path: motion.write_csv(table, path))
    write_json(json, lambda notes: torque_results.as_json(chosen, joysticks, results, notes))
    tables = {law: result.table for law, result in results.items()}
    write_plot(plot, lambda: forced_motion.plot_torque(tables))


def _chain(rate: float | None, cutoff: float | None) -> laboratory.Chain:
    """The paper's signal chain with these settings; raises ParameterError."""
    low_pass = _PAPER.low_pass if cutoff is None else laboratory.LowPass(cutoff=cutoff)
    return laboratory.Chain(rate=_PAPER.rate if rate is None else rate, low_pass=low_pass)


def _motion(given: Mapping[str, Any]) -> forced_motion.ForwardAndReturn:
    """Motion in closed form from these options; None stands for the default.

    Raises:
        BadParameter: a value is not allowed
    """
    if given["flat"] is not None and given["shape"] != "trapezoid":
        raise typer.BadParameter("is for --shape trapezoid", param_hint="--flat")
    values = {**_DEFAULTS} | {name: value for name, value in given.items() if value is not None}
    angle = parsing.parse_angle(values.pop("amplitude"), "--angle")
    try:
        return forced_motion.ForwardAndReturn(amplitude=angle, **values)
    except ParameterError as error:
        text = f"{error.value} must be {error.allowed}"
        raise typer.BadParameter(text, param_hint=_OPTIONS[error.field]) from None
