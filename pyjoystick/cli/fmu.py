"""``pyjoystick fmu``."""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import fmu, support
from pyjoystick.cli.console import write
from pyjoystick.cli.fmus import found_or_built

EXAMPLES: Final = """
Examples:

    pyjoystick fmu Joystick -o fmus
    pyjoystick fmu Joystick Operator -o fmus
"""


def run(
    names: Annotated[
        list[str],
        typer.Argument(metavar="NAME...", help=f"{', '.join(fmu.MODELS)}.", show_default=False),
    ],
    folder: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="FOLDER", help="Folder for the files.", show_default=False),
    ],
) -> None:
    """Copy FMUs of this package to a folder, for other tools.

    The FMUs of an installed package contain binaries for Linux, Windows and macOS. Use `pyjoystick export`
    for FMUs with other start values.
    """
    for name in names:
        if name not in fmu.MODELS:
            raise typer.BadParameter(f"no FMU {name!r}; there are {', '.join(fmu.MODELS)}", param_hint="NAME")
    for source in map(found_or_built, names):
        write(folder / source.name, partial(_copy, source))


def _copy(source: Path, target: Path) -> None:
    with support.replacing(target) as temporary:
        shutil.copyfile(source, temporary)
