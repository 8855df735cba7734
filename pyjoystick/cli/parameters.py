"""``pyjoystick parameters``."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated

import typer

from pyjoystick import model
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import output, write, write_json
from pyjoystick.support import OutputFileError, Table, check_outputs, write_text

EXAMPLES = """
Examples:

    pyjoystick parameters -o joystick.toml
    pyjoystick parameters -p joystick.toml --set m=0.91 -o heavier.toml
    pyjoystick parameters -p joystick.toml --damping power-law
    pyjoystick parameters -p joystick.toml --fmu-names
    pyjoystick parameters -p joystick.toml --json joystick.json

The file that `-o` writes explains each of its values in a comment.
"""


def run(
    parameters: options.Parameters = None,
    damping: Annotated[
        model.LawName | None, typer.Option("--damping", help="Choose this damping law.")
    ] = None,
    assignments: options.Set = None,
    target: Annotated[
        Path | None,
        options.file("--output", "-o", text="Write to this file instead of printing.", suffixes=(".toml",)),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace FILE if it exists.")] = False,
    json: Annotated[
        Path | None, options.json("the parameters by their names in the FMU, with units and sources,")
    ] = None,
    fmu_names: Annotated[
        bool, typer.Option("--fmu-names", help="Print the parameters by their names in the FMU instead.")
    ] = False,
) -> None:
    """Check a parameter file, change values in it if requested, and print it or write it to another file."""
    check_outputs(target, json)
    file = joystick_choice.parameter_file(parameters)
    if fmu_names:
        reason = "--fmu-names prints what is in the parameter file"
        parsing.refuse_given(reason, {"--set": assignments, "--output": target})
        output().print(model.fmu_value_table(model.fmu_values(file, damping)).markdown(), markup=False)
        write_json(json, lambda notes: model.values_json(file, damping, notes))
        return
    changes = parsing.parse_assignments(assignments, "--set")
    # The title does not describe a changed joystick.
    title = target.stem if target is not None and changes else None
    text = model.updated_text(file, joystick_choice.joystick_of(damping, changes, file), title=title)
    if target is None:
        output().print(text, end="", markup=False, soft_wrap=True)
    elif target.exists() and not overwrite:
        raise OutputFileError(target, "it exists; --overwrite replaces it")
    write(target, lambda path: write_text(path, text))
    changed = Table(target or file.path, "", tomllib.loads(text))
    write_json(json, lambda notes: model.values_json(model.read_parameter_file(changed), notes=notes))
