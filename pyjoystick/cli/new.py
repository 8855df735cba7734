"""``pyjoystick new``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import reports
from pyjoystick.cli.console import print_progress

EXAMPLES: Final = """
Examples:

    pyjoystick new left_stick
    pyjoystick new laboratory --example
"""


def run(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of the project.")],
    example: Annotated[
        bool, typer.Option("--example", help="Include the files of a synthetic laboratory, to try it out.")
    ] = False,
) -> None:
    """Start a project: a folder with a commented laboratory.toml, a README and a place for data.

    Put the files into `data`, describe them in laboratory.toml, and type `pyjoystick run`. Existing files are
    not replaced.
    """
    reports.new_project(folder, example=example)
    print_progress(f"wrote {folder / reports.LABORATORY_FILE}")
    ready = (
        "cd into the folder"
        if example
        else f"put files into {folder / 'data'}, edit {reports.LABORATORY_FILE}"
    )
    print_progress(f"next: {ready}, and pyjoystick run")
