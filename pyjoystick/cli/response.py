"""``pyjoystick response``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer

from pyjoystick import forced_motion
from pyjoystick.cli import options, parsing
from pyjoystick.cli.console import (
    note_stops,
    output,
    print_warning,
    print_warnings,
    progress_console,
    write,
    write_json,
    write_plot,
)
from pyjoystick.cli.fmus import opened
from pyjoystick.cli.plausibility import require_plausible
from pyjoystick.support import ParameterError, check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick response --torque 0.6 --frequency 4

    pyjoystick response --torque 0.6 --speed -6 --speed 0 --speed 6 --json basins.json

    pyjoystick response --torque 0.6 --vary frequency 3 5 --plot response.png --csv response.csv

    pyjoystick response --frequency 4 --vary torque 0.4 0.8 --periods 2 --json response.json

Where a motion is chaotic, no period is given: its exponent says how fast errors grow, and for how long a run
can be trusted.
"""
#: Smallest and largest torque (N m) and frequency (Hz).
_BOUNDS: Final = {"torque": (0.0, 50.0), "frequency": (0.1, 200.0)}
#: Release angles (deg), on both sides of the middle.
_RELEASES: Final = (0.1, 0.3, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0)


def run(
    torque: Annotated[
        float,
        typer.Option(
            "--torque",
            metavar="N.M",
            min=_BOUNDS["torque"][0],
            max=_BOUNDS["torque"][1],
            help="Amplitude of the sinusoidal torque (N m).",
        ),
    ] = 0.6,
    frequency: Annotated[
        float,
        typer.Option(
            "--frequency",
            metavar="HZ",
            min=_BOUNDS["frequency"][0],
            max=_BOUNDS["frequency"][1],
            help="Its frequency (Hz).",
        ),
    ] = 4.0,
    speeds: Annotated[
        list[float] | None,
        typer.Option(
            "--speed",
            metavar="RAD/S",
            min=-100.0,
            max=100.0,
            help="Release with this angular velocity from every angle; repeatable; 0 if not given.",
        ),
    ] = None,
    vary: Annotated[
        tuple[str, float, float] | None,
        typer.Option(
            "--vary",
            metavar="NAME LOW HIGH",
            help="Follow periodic motions over this parameter: frequency, torque, or one of the joystick.",
        ),
    ] = None,
    periods: Annotated[
        int,
        typer.Option(
            "--periods",
            metavar="NUMBER",
            min=1,
            max=8,
            help="With --vary: follow period doublings up to this many periods of the torque.",
        ),
    ] = 1,
    damping: options.Law = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    fmu: options.FmuFile = None,
    csv: Annotated[Path | None, options.csv("the branches of --vary")] = None,
    json: Annotated[Path | None, options.json("all numbers")] = None,
    plot: Annotated[
        Path | None, options.plot("the branches of --vary; without it, the motions in the phase plane")
    ] = None,
) -> None:
    """Find the response to a sinusoidal torque: periodic motions, jumps, chaos.

    Releases at 16 angles, from rest or at --speed, show where the joystick ends up. With --vary, periodic
    motions are followed over a parameter, unstable ones too, with folds (jumps), period doublings and
    grazings.
    """
    check_outputs(csv, json, plot)
    if vary is None:
        parsing.refuse_given("needs --vary", {"--csv": csv, "--periods": None if periods == 1 else periods})
    else:
        _check_range(*vary)
    shaking = forced_motion.Shaking(torque, frequency)
    response = None
    with (
        opened(damping, fmu, assignments, parameters) as (joystick_fmu, joystick),
        progress_console().status("releasing") as status,
    ):
        once = forced_motion.ShakenJoystick(joystick_fmu, joystick, shaking)
        # First, to reject parameters that cannot be varied before the long computation.
        if vary is not None:
            shaken = forced_motion.ShakenJoystick(joystick_fmu, joystick, shaking, free=vary[0])
            response = forced_motion.Response(
                shaken, vary[1:], most_periods=periods, on_progress=status.update
            )
        releases = np.radians([sign * angle for sign in (-1.0, 1.0) for angle in _RELEASES])
        found = forced_motion.basins(once, releases, speeds or (0.0,), on_progress=status.update)
        if response is not None:
            response.search()
        note_stops(max(one.largest for one in found.attractors), joystick)
        output().print(forced_motion.attractor_report(found, once), markup=False)
        if any(isinstance(one, forced_motion.UnsettledMotion) for one in found.attractors):
            print_warning("motions that did not become periodic are listed without a period")
        if response is None:
            write_plot(plot, lambda: forced_motion.plot_attractors(found, once))
        else:
            _give_branches(response, csv, plot)
        write_json(json, lambda notes: forced_motion.response_json(once, found, response, notes))


def _check_range(name: str, *ends: float) -> None:
    """Reject values of --vary that no joystick has, or that its own options do not take."""
    low, high = _BOUNDS.get(name, (-math.inf, math.inf))
    for end in ends:
        if not low <= end <= high:
            raise ParameterError(f"--vary {name}", end, f"from {low:g} to {high:g}")
        require_plausible({name: end}, options={name: f"--vary {name}"})


def _give_branches(response: forced_motion.Response, csv: Path | None, plot: Path | None) -> None:
    output().print(f"\n{forced_motion.branch_report(response)}", markup=False)
    print_warnings("not found", response.notes)
    text = forced_motion.branch_table(response).to_csv(index=False, lineterminator="\n")
    write(csv, lambda path: write_text(path, text))
    write_plot(plot, lambda: forced_motion.plot_response(response))
