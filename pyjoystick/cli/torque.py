"""``pyjoystick torque``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import chain_options, options
from pyjoystick.cli.console import messages, output, print_note
from pyjoystick.cli.stops import note_stops
from pyjoystick.cli.torque_motion import MotionOptions, refuse_given
from pyjoystick.support import DEFAULT_OUTPUT_INTERVAL, check_outputs, write_text

EXAMPLES = """
Examples:

    pyjoystick torque --angle 18deg --stroke-time 0.12 --plot torque.png

    pyjoystick torque -a -15deg --stroke-time 0.2 --dwell 0.5 --shape trapezoid --damping constant \\
        --csv torque.csv

    pyjoystick torque motion.csv --parameters joystick.toml --json torque.json

A measured motion is a CSV file with the columns time, theta and perhaps omega and alpha, such as `pyjoystick
import markers --motion` writes. Where omega or alpha is missing, the angle goes through the paper's filter
and rules of differentiation first. docs/forced-motion.md tells the rest.
"""


def run(
    record: Annotated[
        Path | None,
        typer.Argument(
            metavar="[MOTION.csv]",
            help="A measured motion; if not given, a stroke and its return in closed form.",
            show_default=False,
        ),
    ] = None,
    angle: Annotated[
        str | None,
        typer.Option(
            "--angle",
            "-a",
            metavar="ANGLE",
            help="How far the stroke goes: 15deg if not given.",
            show_default=False,
        ),
    ] = None,
    stroke_time: Annotated[
        float | None,
        typer.Option(
            "--stroke-time", metavar="SECONDS", help="Time of the stroke: 0.15.", show_default=False
        ),
    ] = None,
    return_time: Annotated[
        float | None,
        typer.Option(
            "--return-time", metavar="SECONDS", help="Time of the return: as the stroke.", show_default=False
        ),
    ] = None,
    dwell: Annotated[
        float | None,
        typer.Option("--dwell", metavar="SECONDS", help="Time held at the angle: 0.", show_default=False),
    ] = None,
    shape: Annotated[
        str | None,
        typer.Option(
            "--shape",
            metavar="NAME",
            help="minimum-jerk (if not given), raised-cosine, or trapezoid (of the velocity).",
            show_default=False,
        ),
    ] = None,
    flat: Annotated[
        float | None,
        typer.Option(
            "--flat",
            metavar="PART",
            help="Trapezoid: part of a stroke at constant velocity, a third if not given.",
            show_default=False,
        ),
    ] = None,
    columns: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help="Where time, theta, omega or alpha is found."),
    ] = None,
    units: Annotated[
        list[str] | None,
        typer.Option("--unit", metavar="NAME=UNIT", help="Unit of a column that has none in its heading."),
    ] = None,
    rate: chain_options.Rate = chain_options.PAPER.rate,
    cutoff: chain_options.Cutoff = chain_options.PAPER.low_pass.cutoff,
    damping: Annotated[
        options.DampingLaw | None,
        typer.Option(
            "--damping", help="One damping law; both that --parameters has if not given.", show_default=False
        ),
    ] = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    arm: Annotated[
        float | None,
        typer.Option(
            "--pivot-to-handle",
            metavar="METERS",
            help="Where the hand is: pivot_to_top of --parameters if not given.",
            show_default=False,
        ),
    ] = None,
    csv: Annotated[
        Path | None,
        typer.Option(
            "--csv", metavar="FILE", help="Write motion, torque and parts (SI units).", show_default=False
        ),
    ] = None,
    json: Annotated[
        Path | None,
        typer.Option("--json", metavar="FILE", help="Write the numbers in full as JSON.", show_default=False),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", metavar="FILE", help="Draw the torque and its parts (Fig. 15).", show_default=False
        ),
    ] = None,
    output_interval: options.OutputInterval = DEFAULT_OUTPUT_INTERVAL,
) -> None:
    """Compute the torque that a motion needs (eq. 13) by the inverse FMUs: parts, force, work, shares.

    With --csv the damping law is the chosen one, or that of the parameter file.
    """
    # What it takes is loaded when it is wanted, so that the other commands start quickly.
    from pyjoystick.cli import torque_results
    from pyjoystick.laboratory import Chain, LowPass
    from pyjoystick.motion import write_csv
    from pyjoystick.support import check_figure_path

    if plot is not None:
        check_figure_path(plot)
    check_outputs(csv, json, plot)
    chosen = MotionOptions(angle, stroke_time, return_time, dwell, shape, flat)
    file = options.parameter_file(parameters)
    changes = options.parse_assignments(assignments or [], "--set")
    joysticks = torque_results.joysticks_of(file, damping, changes)
    if record is None:
        refuse_given("is for a measured motion", {"--column": columns, "--unit": units})
        motion = torque_results.in_closed_form(chosen.motion(), output_interval)
    else:
        chosen.refuse_all()
        chain = Chain(rate=rate, low_pass=LowPass(cutoff=cutoff))
        headings = options.parse_names(columns, "--column")
        motion = torque_results.from_file(record, chain, headings, options.parse_names(units, "--unit"))
    for note in motion.notes:
        print_note(note)
    with messages().status("computing"):
        results = torque_results.compute(motion, joysticks, torque_results.arm_of(file, arm))
    note_stops(float(next(iter(results.values())).table["theta"].abs().max()))
    output().print(torque_results.text(motion, results), markup=False)
    if csv is not None:
        write_csv(next(iter(results.values())).table, csv)
        print_note(f"wrote {csv}")
    if json is not None:
        write_text(json, torque_results.as_json(motion, results))
        print_note(f"wrote {json}")
    if plot is not None:
        torque_results.draw(results, plot)
        print_note(f"wrote {plot}")
