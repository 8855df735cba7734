"""``pyjoystick vibration``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer

from pyjoystick import fmu, forced_motion, model, runs, support
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import output, print_warning, write, write_json, write_plot
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.support import check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick vibration --plot vibration.png

    pyjoystick vibration --direction vertical --angle 15deg

    pyjoystick vibration --angle 15deg --hand-mass 0.6 --acceleration 1 --acceleration 5 --csv vibration.csv

Lines of the figure are small vibrations, points those of --acceleration.
"""
#: Numbers of frequencies for the table and the points, and for the lines.
_FEW: Final = 9
_MANY: Final = 300


def run(
    angle: Annotated[
        str, typer.Option("--angle", "-a", metavar="ANGLE", help="Angle at which the handle is held.")
    ] = "10deg",
    limits: Annotated[
        tuple[float, float], typer.Option("--range", metavar="LOW HIGH", help="Frequencies (Hz).")
    ] = (0.5, 50.0),
    accelerations: Annotated[
        list[float] | None,
        typer.Option(
            "--acceleration",
            metavar="M/S2",
            help="Also run the FMU with this amplitude of the base (rad/s2 for pitch); repeatable.",
        ),
    ] = None,
    direction: Annotated[
        forced_motion.Direction,
        typer.Option(
            "--direction", help="Direction of the base's motion; pitch is rotation about the pivot."
        ),
    ] = forced_motion.Direction.HORIZONTAL,
    stiffness: Annotated[
        float | None,
        typer.Option(
            "--hand-stiffness", metavar="N.M/RAD", help="Stiffness of hand and arm about the pivot."
        ),
    ] = None,
    hand_damping: Annotated[
        float | None,
        typer.Option("--hand-damping", metavar="N.M.S/RAD", help="Damping of hand and arm about the pivot."),
    ] = None,
    mass: Annotated[
        float,
        typer.Option("--hand-mass", metavar="KG", help="Mass of hand and arm that moves with the handle."),
    ] = 0.0,
    damping: options.Law = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    csv: Annotated[Path | None, options.csv("all responses")] = None,
    json: Annotated[Path | None, options.json("all responses")] = None,
    plot: Annotated[Path | None, options.plot("angle and transmissibility over the frequency")] = None,
) -> None:
    """Find how far the handle moves when its base shakes, as in a vehicle, alone and in a hand.

    The base shakes in the plane of the handle. The tables give the amplitude of the angle in degrees per m/s2
    (or rad/s2) of the base, and the acceleration of the handle's top in space over that of the base, in the
    same direction; with pitch, the handle's angular acceleration over the base's.
    """
    check_outputs(csv, json, plot)
    held = parsing.parse_angle(angle, "--angle")
    low, high = limits
    if not 0.0 < low < high:
        raise typer.BadParameter("two frequencies above 0, the lower one first", param_hint="--range")
    file = joystick_choice.parameter_file(parameters)
    joystick = joystick_choice.joystick_of(damping, parsing.parse_assignments(assignments, "--set"), file)
    top = file.pivot_to_top or model.PIVOT_TO_TOP
    given = {"stiffness": stiffness, "damping": hand_damping, "mass": mass, "distance": top}
    hand = forced_motion.Hand(**{name: value for name, value in given.items() if value is not None})
    with fmu.Fmu(found_or_built(runs.mounted_fmu(joystick))) as mounted:

        def mounted_handle(hand: forced_motion.Hand | None) -> forced_motion.MountedHandle:
            return forced_motion.MountedHandle(
                mounted, joystick, held, hand, direction=direction, pivot_to_top=top
            )

        handles = {"hand": mounted_handle(hand)}
        try:
            handles = {"alone": mounted_handle(None)} | handles
        except support.ParameterError as error:
            print_warning(f"without a hand: {error}")
        found = forced_motion.feedthrough(
            handles, np.geomspace(low, high, _FEW), np.geomspace(low, high, _MANY), accelerations or ()
        )
    output().print(forced_motion.feedthrough_report(found), markup=False)
    text = forced_motion.feedthrough_table(found).to_csv(index=False, lineterminator="\n")
    write(csv, lambda path: write_text(path, text))
    write_json(json, lambda notes: forced_motion.feedthrough_json(found, joystick, held, hand, notes))
    write_plot(
        plot,
        lambda: forced_motion.plot_transmissibility(found.small, found.driven, direction=direction),
    )
