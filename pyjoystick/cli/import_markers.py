"""``pyjoystick import markers``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, model
from pyjoystick.cli import joystick_choice, options
from pyjoystick.cli.console import output, print_progress, print_warnings, write_json
from pyjoystick.cli.plausibility import require_length
from pyjoystick.support import check_outputs

_PAPER: Final = laboratory.Chain()
EXAMPLES: Final = """
Examples:

    pyjoystick import markers trial1.c3d --top TOP --base BASE1 BASE2 --output trial1.csv

    pyjoystick import markers nexus.csv --top TOP --base BASE1 BASE2 --forward -y \\
        --released backward --output trial1.csv --motion motion1.csv

    pyjoystick import markers trial1.c3d --top TOP --base BASE1 BASE2 --radius 0.266 \\
        --rests backward --parameters joystick.toml --output trial1.csv

The record contains the unfiltered angle, as `pyjoystick peaks` and `pyjoystick fit` require: the filter would
lower the peaks of the velocity and correlate the noise of neighboring samples. The motion contains the
filtered angle, velocity and acceleration.
"""


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="C3D, Nexus CSV or plain CSV.")],
    top: Annotated[str, typer.Option("--top", metavar="NAME", help="Marker on top of the joystick.")],
    base: Annotated[
        tuple[str, str], typer.Option("--base", metavar="NAME NAME", help="The two markers on the base.")
    ],
    record_file: Annotated[Path, options.csv("the record, time and angle,", "--output", "-o")],
    motion_file: Annotated[Path | None, options.csv("the filtered motion", "--motion")] = None,
    json: Annotated[Path | None, options.json("what the markers and the filtered motion are")] = None,
    forward: Annotated[
        str, typer.Option("--forward", metavar="AXIS", help="Axis that points forward: x, -x, y, -y, z, -z.")
    ] = "x",
    up: Annotated[
        str | None,
        typer.Option(
            "--up",
            metavar="AXIS",
            help="Axis in the plane of motion, if it cannot be found from the markers.",
        ),
    ] = None,
    middle: Annotated[
        bool,
        typer.Option(
            "--middle", help="Use the middle of the base as the pivot instead of the center of the arc."
        ),
    ] = False,
    radius: Annotated[
        float | None,
        options.quantity(
            "length",
            "--radius",
            metavar="LENGTH",
            text="Measured distance from the pivot to the top marker: 0.266 (m) or 266mm. Default: the "
            "radius of its arc.",
        ),
    ] = None,
    moving_base: Annotated[
        bool, typer.Option("--moving-base", help="Measure the angle relative to the base in each frame.")
    ] = False,
    rest: options.Rest = None,
    rests: Annotated[
        model.Side | None,
        typer.Option(
            "--rests",
            help="Side to which the joystick leans at rest; the zero of the angle is then the middle of the "
            "clearance of --parameters.",
        ),
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(
            "--parameters", "-p", metavar="FILE", help="Parameter file of the joystick, for --rests."
        ),
    ] = None,
    released: options.Released = None,
    unit: Annotated[
        str | None, typer.Option("--unit", metavar="UNIT", help="m, cm, mm or in, if the file gives no unit.")
    ] = None,
    rate: options.Rate = _PAPER.rate,
    cutoff: options.Cutoff = _PAPER.low_pass.cutoff,
    order: options.Order = _PAPER.low_pass.order,
    corrected: options.Corrected = False,
    longest_gap: options.LongestGap = _PAPER.longest_gap,
    velocity_points: options.VelocityPoints = _PAPER.velocity_points,
    acceleration_points: options.AccelerationPoints = _PAPER.acceleration_points,
) -> None:
    """Make a record of the joystick's angle from motion capture (section 2 of the paper)."""
    chain = options.chain_of(
        rate, cutoff, order, corrected, longest_gap, velocity_points, acceleration_points
    )
    if (rests is None) != (parameters is None):
        raise typer.BadParameter("give --rests and --parameters together")
    if middle and radius is not None:
        raise typer.BadParameter("use --middle or --radius, not both: the pivot is one or the other")
    require_length("--radius", radius)
    check_outputs(record_file, motion_file, json)
    setup = laboratory.MarkerSetup(
        top=top,
        base=base,
        forward=forward,
        up=up,
        middle=middle,
        radius=radius,
        moving_base=moving_base,
        rest=rest,
        rests=rests,
        released=released,
        unit=unit,
        chain=chain,
    )
    joystick = None if rests is None else joystick_choice.parameter_file(parameters).joystick
    trial = laboratory.read_trial(file, setup, name=record_file.stem, joystick=joystick)
    print_warnings(file, trial.record.notes)
    trial.write(record_file, motion_file)
    for path in filter(None, (record_file, motion_file)):
        print_progress(f"wrote {path}")
    output().print(trial.report())
    write_json(json, lambda notes: laboratory.trial_json(trial, notes))
