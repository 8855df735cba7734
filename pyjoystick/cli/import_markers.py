"""``pyjoystick import markers``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import chain_options
from pyjoystick.cli.chain_options import PAPER, chain_of
from pyjoystick.cli.console import output, print_note
from pyjoystick.cli.options import Released, SideName, parameter_file, side_of
from pyjoystick.support import check_outputs

EXAMPLES = """
Examples:

    pyjoystick import markers trial1.c3d --top TOP --base BASE1 BASE2 --output trial1.csv

    pyjoystick import markers nexus.csv --top TOP --base BASE1 BASE2 --forward -y --released backward \\
        --output trial1.csv --motion motion1.csv

    pyjoystick import markers trial1.c3d --top TOP --base BASE1 BASE2 --radius 0.266 --rests backward \\
        --parameters joystick.toml --output trial1.csv

The record has the angle as measured, which `pyjoystick peaks` and `pyjoystick fit` want: the filter of the
chain lowers the peaks of the velocity and makes the noise of neighboring samples alike. The motion is what
the chain gives: angle, velocity and acceleration.
"""


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="C3D, Nexus CSV or plain CSV.")],
    top: Annotated[str, typer.Option("--top", metavar="NAME", help="Marker on top of the joystick.")],
    base: Annotated[
        tuple[str, str], typer.Option("--base", metavar="NAME NAME", help="The two markers on the base.")
    ],
    record_file: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="Where the record goes: time and angle.")
    ],
    motion_file: Annotated[
        Path | None, typer.Option("--motion", metavar="FILE", help="Where the filtered motion goes.")
    ] = None,
    forward: Annotated[
        str, typer.Option("--forward", metavar="AXIS", help="Axis that points forward: x, -x, y, -y, z, -z.")
    ] = "x",
    up: Annotated[
        str | None,
        typer.Option(
            "--up", metavar="AXIS", help="Axis in the plane of motion, where this is not to be found."
        ),
    ] = None,
    middle: Annotated[
        bool, typer.Option("--middle", help="The pivot is the middle of the base, not the center of the arc.")
    ] = False,
    radius: Annotated[
        float | None,
        typer.Option(
            "--radius",
            metavar="METRES",
            help="From the pivot to the top marker, where measured; that of its arc if not given.",
        ),
    ] = None,
    moving_base: Annotated[
        bool, typer.Option("--moving-base", help="Take the angle relative to the base in each frame.")
    ] = False,
    rest: Annotated[
        tuple[float, float] | None,
        typer.Option(
            "--rest", metavar="START END", help="Stretch at rest (s); the last 0.25 s if not given."
        ),
    ] = None,
    rests: Annotated[
        SideName | None,
        typer.Option(
            "--rests",
            help="Side to which it leans at rest: zero is then the middle of the clearance of --parameters.",
            show_default=False,
        ),
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(
            "--parameters", "-p", metavar="FILE", help="The joystick, for --rests.", show_default=False
        ),
    ] = None,
    released: Released = None,
    unit: Annotated[
        str | None, typer.Option("--unit", metavar="UNIT", help="m, cm or mm, where the file does not say.")
    ] = None,
    rate: chain_options.Rate = PAPER.rate,
    cutoff: chain_options.Cutoff = PAPER.low_pass.cutoff,
    order: chain_options.Order = PAPER.low_pass.order,
    corrected: chain_options.Corrected = False,
    longest_gap: chain_options.LongestGap = PAPER.longest_gap,
    velocity_points: chain_options.VelocityPoints = PAPER.velocity_points,
    acceleration_points: chain_options.AccelerationPoints = PAPER.acceleration_points,
) -> None:
    """Make a record of the joystick's angle from motion capture (section 2 of the paper)."""
    # What it takes is loaded when it is wanted, so that the other commands start quickly.
    from pyjoystick.laboratory import (
        chain_report,
        markers_report,
        measure_angle,
        read_markers,
        rest_angle,
        write_motion,
        write_record,
    )
    from pyjoystick.motion import check_free_oscillation

    chain = chain_of(rate, cutoff, order, corrected, longest_gap, velocity_points, acceleration_points)
    if (rests is None) != (parameters is None):
        raise typer.BadParameter("give --rests and --parameters together")
    if middle and radius is not None:
        raise typer.BadParameter("give --middle or --radius: the pivot is one or the other")
    check_outputs(record_file, motion_file)
    leaning = side_of(rests)
    at_rest = 0.0 if leaning is None else rest_angle(parameter_file(parameters).joystick, leaning)
    markers = read_markers(file, unit=unit)
    measured = measure_angle(
        markers,
        top=top,
        base=base,
        forward=forward,
        up=up,
        origin="middle" if middle else "arc",
        radius=radius,
        base_motion="moving" if moving_base else "still",
        rest=rest,
        rest_angle=at_rest,
    )
    record = measured.record(record_file.stem)
    if released is not None:
        record = check_free_oscillation(record, released=side_of(released))
    for note in record.notes:
        print_note(f"{file}: {note}")
    motion = chain.run(measured.time, measured.theta)
    origin = f"angle from {file.name}: top {top}, base {base[0]} and {base[1]}, forward {forward}"
    write_record(record, record_file, [origin])
    print_note(f"wrote {record_file}")
    if motion_file is not None:
        filtered = f"filtered at {cutoff:g} Hz, order {order}, forward and reverse, {rate:g} Hz"
        write_motion(motion, motion_file, [origin, filtered])
        print_note(f"wrote {motion_file}")
    console = output()
    console.print(markers_report(markers, (top, *base), measured))
    console.print()
    console.print(chain_report(chain, motion))
