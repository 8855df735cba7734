"""``pyjoystick explore``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import motion, reports
from pyjoystick.cli import options
from pyjoystick.cli.console import messages, write
from pyjoystick.cli.fmus import FmuBuildError, found_or_built
from pyjoystick.support import check_outputs, write_text

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
    """Write a page in which the joystick runs live: sliders, plots, the mechanism in motion, records.

    The page is one HTML file that needs no network. Its values can be saved as a parameter file.
    """
    start = options.parse_angle(release_angle)
    check_outputs(target)
    file = options.parameter_file(parameters_file)
    joystick = options.joystick_of(damping, options.parse_assignments(assignments, "--set"), file)
    measured = [motion.read_record(path) for path in records or ()]
    fmu = found_or_built(reports.held_fmu(joystick))
    from fmu_build import BuildError  # takes long to load

    with messages().status("page"):
        try:
            text = reports.joystick_page(fmu, file, joystick, start, records=measured, title=title)
        except BuildError as error:
            raise FmuBuildError(f"the page could not be made: {error}") from error
    write(target, lambda path: write_text(path, text), f", {len(text.encode()) / 1e3:.0f} kB")
