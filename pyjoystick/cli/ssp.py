"""``pyjoystick ssp``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from pyjoystick import runs
from pyjoystick.cli import options
from pyjoystick.cli.console import write

EXAMPLES = """
Examples:

    pyjoystick ssp joystick.ssp
    pyjoystick ssp joystick.ssp --ssp-version 2.0
"""


def run(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="The .ssp file to write.",
            show_default=False,
            callback=options.ending_in(".ssp"),
        ),
    ],
    version: Annotated[
        Literal["1.0", "2.0"], typer.Option("--ssp-version", help="Version of the SSP standard.")
    ] = "1.0",
) -> None:
    """Write operator and joystick, coupled FMU to FMU, as an SSP archive that other tools can run."""
    write(file, lambda path: runs.write_ssp(runs.operator_and_joystick(), path, version=version))
