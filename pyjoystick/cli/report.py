"""``pyjoystick report``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import options
from pyjoystick.cli.console import messages, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.setup import opened
from pyjoystick.support import check_outputs, write_text

EXAMPLES = """
Examples:

    pyjoystick report --output joystick.html
    pyjoystick report --damping power-law --set damping.alpha=0.8 -o joystick.html
    pyjoystick report --parameters joystick.toml --release-angle -15 -o joystick.html
"""


def run(
    target: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="Write the page there, .html.")
    ],
    parameters_file: options.Parameters = None,
    damping: options.Law = None,
    assignments: options.Set = None,
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    title: Annotated[
        str, typer.Option("--title", help="Heading; that of --parameters if not given.", show_default=False)
    ] = "",
) -> None:
    """Write a report on a joystick: one HTML file with figures, tables, parameters and versions inside.

    About the paper's own joystick it also has a table of the paper's statements and of what comes out.
    """
    if target.suffix.lower() not in (".html", ".htm"):
        raise typer.BadParameter(f"{target} must end in .html", param_hint="--output")
    start = options.parse_angle(release_angle)
    check_outputs(target)
    # Matplotlib and SciPy take a while to load, which the other commands need not wait for.
    from pyjoystick.reports import Study, joystick_report

    file = options.parameter_file(parameters_file)
    found_or_built("Joystick")  # which the table of the paper's statements runs
    with (
        opened(damping, None, assignments, parameters_file) as (fmu, joystick),
        messages().status("report") as status,
    ):
        study = Study(joystick, fmu, start, file.pivot_to_top)
        text = joystick_report(
            study, title=title or file.title, on_section=lambda name: status.update(f"report: {name}")
        )
    write_text(target, text)
    print_note(f"wrote {target}, {len(text.encode()) / 1e6:.1f} MB")
