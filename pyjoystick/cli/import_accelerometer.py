"""``pyjoystick import accelerometer``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import chain_options
from pyjoystick.cli.chain_options import PAPER, chain_of
from pyjoystick.cli.console import output, print_note
from pyjoystick.support import check_outputs

EXAMPLES = """
Examples:

    pyjoystick import accelerometer trial1_acc.csv --angle trial1.csv --distance 0.25

    pyjoystick import accelerometer long.npy --samples-per-second 1800 --unit V --sensitivity 0.01 \\
        --angle trial1.csv --distance 0.25 --delay 0.35 --output alpha1.csv

The file may be long: it is read a piece at a time, and only the part where the angle is known is kept.
"""


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="CSV with headings, or .npy.")],
    angle: Annotated[
        Path,
        typer.Option("--angle", metavar="FILE", help="Record of the angle: `pyjoystick import markers`."),
    ],
    distance: Annotated[
        float, typer.Option("--distance", metavar="METRES", help="From the pivot to the accelerometer.")
    ],
    result: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Where the acceleration goes.")
    ] = None,
    column: Annotated[
        str, typer.Option("--column", metavar="HEADING", help="Column of the readings.")
    ] = "acceleration",
    unit: Annotated[
        str | None,
        typer.Option("--unit", metavar="UNIT", help="m/s2, mm/s2, g, V or mV, if not in the heading."),
    ] = None,
    samples_per_second: Annotated[
        float | None,
        typer.Option("--samples-per-second", metavar="HZ", help="Rate of a file without a time."),
    ] = None,
    sensitivity: Annotated[
        float | None, typer.Option("--sensitivity", metavar="NUMBER", help="V/(m/s2), for voltages.")
    ] = None,
    full_scale: Annotated[
        float | None,
        typer.Option("--full-scale", metavar="NUMBER", help="Largest reading, in the unit of the file."),
    ] = None,
    delay: Annotated[
        float,
        typer.Option("--delay", metavar="SECONDS", help="Accelerometer's clock when the angle's shows zero."),
    ] = 0.0,
    backward: Annotated[
        bool, typer.Option("--backward", help="The accelerometer's positive direction is backward.")
    ] = False,
    rest: Annotated[
        tuple[float, float] | None,
        typer.Option(
            "--rest", metavar="START END", help="Stretch at rest (s); the last 0.25 s if not given."
        ),
    ] = None,
    rate: chain_options.Rate = PAPER.rate,
    cutoff: chain_options.Cutoff = PAPER.low_pass.cutoff,
    order: chain_options.Order = PAPER.low_pass.order,
    corrected: chain_options.Corrected = False,
    longest_gap: chain_options.LongestGap = PAPER.longest_gap,
    velocity_points: chain_options.VelocityPoints = PAPER.velocity_points,
    acceleration_points: chain_options.AccelerationPoints = PAPER.acceleration_points,
) -> None:
    """Compare an accelerometer with the differentiated angle (section 2 of the paper)."""
    # What it takes is loaded when it is wanted, so that the other commands start quickly.
    from pyjoystick.laboratory import (
        LARGEST_LAG,
        REST_TIME,
        acceleration_report,
        angular_acceleration,
        read_accelerometer,
        write_acceleration,
    )
    from pyjoystick.motion import read_record

    chain = chain_of(rate, cutoff, order, corrected, longest_gap, velocity_points, acceleration_points)
    check_outputs(result)
    measured = read_record(angle, free_oscillation=False)
    motion = chain.run(measured.time, measured.theta)
    record = read_accelerometer(
        file,
        window=(float(motion.time[0]), float(motion.time[-1])),
        column=column,
        unit=unit,
        rate=samples_per_second,
        sensitivity=sensitivity,
        full_scale=full_scale,
        delay=delay,
    )
    for note in record.notes:
        print_note(f"{file}: {note}")
    end = float(motion.time[-1])
    found = angular_acceleration(
        record,
        motion,
        distance=distance,
        rest=rest or (end - REST_TIME, end),
        low_pass=chain.low_pass,
        backward=backward,
    )
    if abs(found.lag) > 0.99 * LARGEST_LAG:
        print_note(f"{file}: the clocks may differ by more than {LARGEST_LAG:g} s: give --delay")
    if found.correlation < 0.0:
        print_note(f"{file}: goes against the angle: if its positive direction is backward, add --backward")
    if result is not None:
        comment = f"angular acceleration from {file.name}, less gravity, over {distance:g} m"
        write_acceleration(found, result, [comment])
        print_note(f"wrote {result}")
    output().print(acceleration_report(record, found))
