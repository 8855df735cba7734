"""``pyjoystick parameters``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyjoystick.cli import options
from pyjoystick.cli.console import output, print_note
from pyjoystick.model import updated_text
from pyjoystick.support import OutputFileError, write_text

EXAMPLES = """
Examples:

    pyjoystick parameters -o joystick.toml
    pyjoystick parameters -p joystick.toml --set m=0.91 -o heavier.toml
    pyjoystick parameters -p joystick.toml --damping power-law

docs/parameters.md describes the file.
"""


def run(
    parameters: options.Parameters = None,
    damping: Annotated[
        options.DampingLaw | None,
        typer.Option("--damping", help="Choose this damping law.", show_default=False),
    ] = None,
    assignments: options.Set = None,
    target: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Write the file there.", show_default=False),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace FILE if it exists.")] = False,
) -> None:
    """Check a parameter file and print it, the paper's joystick if none is given, perhaps with changes."""
    file = options.parameter_file(parameters)
    changes = options.parse_assignments(assignments or [], "--set")
    # A changed joystick is no longer the one that the title names.
    title = target.stem if target is not None and changes else None
    text = updated_text(file, options.joystick_of(damping, changes, file), title=title)
    if target is None:
        output().print(text, end="", markup=False)
        return
    if target.exists() and not overwrite:
        raise OutputFileError(target, "it exists; --overwrite replaces it")
    write_text(target, text)
    print_note(f"wrote {target}")
