"""``pyjoystick report``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Final
from urllib.parse import quote

import typer

from pyjoystick import model, reports
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import progress_console, write
from pyjoystick.cli.fmus import found_or_built, opened
from pyjoystick.cli.live_page import write_live_page
from pyjoystick.support import check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick report --output joystick.html
    pyjoystick report --damping power-law --set damping.alpha=0.8 -o joystick.html
    pyjoystick report --output joystick.html --live live.html
    pyjoystick report --parameters joystick.toml --release-angle -15 -o joystick.html
    pyjoystick report -p joystick.toml --fit fit/fit.json --curve forward=forward.csv \\
        --curve backward=backward.csv --swing swing.csv --budget budget.json -o joystick.html
"""


def run(
    target: options.HtmlFile,
    parameters_file: options.Parameters = None,
    damping: options.Law = None,
    assignments: options.Set = None,
    release_angle: options.ReleaseAngle = options.DEFAULT_RELEASE_ANGLE,
    fit: Annotated[
        Path | None,
        typer.Option("--fit", metavar="fit.json", help="The fit, with its records."),
    ] = None,
    curves: Annotated[
        list[str] | None,
        typer.Option("--curve", metavar="SIDE=FILE.csv", help="Load-deflection curve; repeatable."),
    ] = None,
    swing: Annotated[
        Path | None, typer.Option("--swing", metavar="FILE.csv", help="Recorded swing test.")
    ] = None,
    parts: Annotated[Path | None, typer.Option("--parts", metavar="FILE.csv", help="Table of parts.")] = None,
    budget: Annotated[
        Path | None,
        typer.Option("--budget", metavar="FILE.json", help="Error budget: `pyjoystick budget --json`."),
    ] = None,
    live: Annotated[
        Path | None,
        options.file(
            "--live",
            text="Also write a live page of the joystick, and link to it.",
            suffixes=(".html", ".htm"),
        ),
    ] = None,
    title: options.Title = "",
) -> None:
    """Write a report on a joystick: a self-contained HTML file with figures, tables, parameters and versions.

    The report on the paper's joystick also compares the statements of the paper with the results.
    """
    start = parsing.parse_angle(release_angle)
    check_outputs(target, live)
    file = joystick_choice.parameter_file(parameters_file)
    measurements = _measurements(file, parameters_file, fit, curves, swing, parts, budget)
    found_or_built("Joystick")  # needed for the table of the paper's statements
    with (
        opened(damping, None, assignments, parameters_file) as (fmu, joystick),
        progress_console().status("report") as status,
    ):
        study = reports.Study(joystick, fmu, start, file.pivot_to_top)
        text = reports.joystick_report(
            study,
            measurements=measurements,
            title=title or file.title,
            live=_address(live, target),
            on_section=lambda name: status.update(f"report: {name}"),
        )
    if live is not None:
        write_live_page(live, file, joystick, start, title=title)
    write(target, lambda path: write_text(path, text), f", {len(text.encode()) / 1e6:.1f} MB")


def _address(live: Path | None, target: Path) -> str:
    """Link from the report to the live page; empty without one."""
    if live is None:
        return ""
    try:
        return quote(Path(os.path.relpath(live, target.parent)).as_posix())
    except ValueError:  # on another drive
        return live.resolve().as_uri()


def _measurements(
    file: model.ParameterFile,
    parameters_file: Path | None,
    fit: Path | None,
    curves: list[str] | None,
    swing: Path | None,
    parts: Path | None,
    budget: Path | None,
) -> reports.Measurements | None:
    """Measurements from which the parameter file was made."""
    if parameters_file is None:
        given = {"--fit": fit, "--curve": curves, "--swing": swing, "--parts": parts, "--budget": budget}
        parsing.refuse_given("needs --parameters, the file that was measured", given)
        return None
    return reports.read_measurements(
        file, fit=fit, curves=parsing.parse_curves(curves), swing=swing, parts=parts, budget=budget
    )
