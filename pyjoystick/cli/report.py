"""``pyjoystick report``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import reports
from pyjoystick.cli import options
from pyjoystick.cli.console import messages, write
from pyjoystick.cli.fmus import found_or_built, opened
from pyjoystick.support import check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick report --output joystick.html
    pyjoystick report --damping power-law --set damping.alpha=0.8 -o joystick.html
    pyjoystick report --parameters joystick.toml --release-angle -15 -o joystick.html
"""


def run(
    target: Annotated[
        Path, options.file("--output", "-o", text="HTML file to write.", suffixes=(".html", ".htm"))
    ],
    parameters_file: options.Parameters = None,
    damping: options.Law = None,
    assignments: options.Set = None,
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    title: Annotated[
        str, typer.Option("--title", help="Heading. Default: the title of --parameters.", show_default=False)
    ] = "",
) -> None:
    """Write a report on a joystick: a self-contained HTML file with figures, tables, parameters and versions.

    The report on the paper's joystick also compares the statements of the paper with the results.
    """
    start = options.parse_angle(release_angle)
    check_outputs(target)
    file = options.parameter_file(parameters_file)
    found_or_built("Joystick")  # for the table of the paper's statements
    with (
        opened(damping, None, assignments, parameters_file) as (fmu, joystick),
        messages().status("report") as status,
    ):
        study = reports.Study(joystick, fmu, start, file.pivot_to_top)
        text = reports.joystick_report(
            study, title=title or file.title, on_section=lambda name: status.update(f"report: {name}")
        )
    write(target, lambda path: write_text(path, text), f", {len(text.encode()) / 1e6:.1f} MB")
