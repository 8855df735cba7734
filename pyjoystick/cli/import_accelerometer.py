"""``pyjoystick import accelerometer``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, motion
from pyjoystick.cli import options
from pyjoystick.cli.console import output, print_warnings, write, write_json
from pyjoystick.cli.plausibility import require_length
from pyjoystick.support import check_outputs

_PAPER: Final = laboratory.Chain()
EXAMPLES: Final = """
Examples:

    pyjoystick import accelerometer trial1_acc.csv --angle trial1.csv --distance 0.25

    pyjoystick import accelerometer long.npy --samples-per-second 1800 --unit V --sensitivity 0.01 \\
        --angle trial1.csv --distance 0.25 --delay 0.35 --output alpha1.csv

The file may be long: it is read in pieces, and only the part that the angle covers is kept.
"""


def _unnamed(given: str) -> str:
    """Return the value for the only column, given alone or as NAME=VALUE, as for tables with more columns."""
    return given.removeprefix("acceleration=")


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="CSV with headings, or .npy.")],
    angle: Annotated[
        Path,
        typer.Option("--angle", metavar="FILE", help="Record of the angle from `pyjoystick import markers`."),
    ],
    distance: Annotated[
        float,
        options.quantity(
            "length",
            "--distance",
            metavar="LENGTH",
            text="Distance from the pivot to the accelerometer: 0.25 (m) or 250mm.",
        ),
    ],
    result: Annotated[Path | None, options.csv("the angular acceleration", "--output", "-o")] = None,
    json: Annotated[Path | None, options.json("the comparison")] = None,
    column: Annotated[
        str,
        typer.Option(
            "--column", metavar="[acceleration=]HEADING", parser=_unnamed, help="Heading of the readings."
        ),
    ] = "acceleration",
    unit: Annotated[
        str | None,
        typer.Option(
            "--unit",
            metavar="[acceleration=]UNIT",
            parser=_unnamed,
            help="Unit if the heading gives none: m/s2, mm/s2, g, V, mV.",
        ),
    ] = None,
    samples_per_second: Annotated[
        float | None,
        typer.Option(
            "--samples-per-second", metavar="HZ", help="Sampling rate of a file without a time column."
        ),
    ] = None,
    sensitivity: Annotated[
        float | None,
        typer.Option("--sensitivity", metavar="NUMBER", help="Sensitivity in V/(m/s2), for voltages."),
    ] = None,
    full_scale: Annotated[
        float | None,
        typer.Option(
            "--full-scale",
            metavar="NUMBER",
            help="Full-scale reading in the unit of the file, to detect saturation.",
        ),
    ] = None,
    delay: Annotated[
        float,
        options.quantity(
            "time",
            "--delay",
            metavar="TIME",
            text="Time on the accelerometer's clock at time zero of the angle: 0.35 (s) or 350ms.",
        ),
    ] = 0.0,
    backward: Annotated[
        bool, typer.Option("--backward", help="The accelerometer's positive direction is backward.")
    ] = False,
    rest: options.Rest = None,
    rate: options.Rate = _PAPER.rate,
    cutoff: options.Cutoff = _PAPER.low_pass.cutoff,
    order: options.Order = _PAPER.low_pass.order,
    corrected: options.Corrected = False,
    longest_gap: options.LongestGap = _PAPER.longest_gap,
    velocity_points: options.VelocityPoints = _PAPER.velocity_points,
    acceleration_points: options.AccelerationPoints = _PAPER.acceleration_points,
) -> None:
    """Compare an accelerometer with the differentiated angle (section 2 of the paper)."""
    chain = options.chain_of(
        rate, cutoff, order, corrected, longest_gap, velocity_points, acceleration_points
    )
    require_length("--distance", distance)
    check_outputs(result, json)
    setup = laboratory.AccelerometerSetup(
        distance=distance,
        column=column,
        unit=unit,
        rate=samples_per_second,
        sensitivity=sensitivity,
        full_scale=full_scale,
        delay=delay,
        backward=backward,
        rest=rest,
        chain=chain,
    )
    measured = motion.read_record(angle, free_oscillation=False)
    found = laboratory.compare_accelerometer(file, measured, setup)
    print_warnings(file, found.notes)
    write(result, found.write)
    output().print(found.report())
    write_json(json, lambda notes: laboratory.comparison_json(found, notes))
