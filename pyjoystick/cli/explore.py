"""``pyjoystick explore``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import motion
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.live_page import write_live_page
from pyjoystick.support import check_outputs

EXAMPLES: Final = """
Examples:

    pyjoystick explore -o joystick.html
    pyjoystick explore --damping power-law --set m=0.95 -o joystick.html
    pyjoystick explore -p joystick.toml --record run_1.csv --record run_2.csv -o joystick.html
"""


def run(
    target: options.HtmlFile,
    parameters_file: options.Parameters = None,
    damping: options.Law = None,
    assignments: options.Set = None,
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    records: Annotated[
        list[Path] | None,
        typer.Option("--record", metavar="RECORD.csv", help="Measured free oscillation; repeatable."),
    ] = None,
    title: options.Title = "",
) -> None:
    """Write a page in which the joystick runs live: sliders, plots, the moving mechanism, records.

    The page is a single HTML file that needs no network. Its values can be saved as a parameter file.
    """
    start = parsing.parse_angle(release_angle)
    check_outputs(target)
    file = joystick_choice.parameter_file(parameters_file)
    joystick = joystick_choice.joystick_of(damping, parsing.parse_assignments(assignments, "--set"), file)
    measured = [motion.read_record(path) for path in records or ()]
    write_live_page(target, file, joystick, start, records=measured, title=title)
