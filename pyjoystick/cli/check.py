"""``pyjoystick check``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from pyjoystick import identification, model, reports, runs, support
from pyjoystick.cli.console import output, print_error, print_progress
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.support import InputFileError, PyJoystickError, Table

EXAMPLES: Final = """
Examples:

    pyjoystick check laboratory.toml
    pyjoystick check joystick.toml fit.toml
    pyjoystick check --schemas schemas
    pyjoystick check scenarios/sweeps/*.toml
"""


@dataclass(frozen=True)
class _Kind:
    """A kind of file.

    Attributes:
        name: name of the kind
        tables: tables that identify it
        example: replacement for mistakes, so that reading can continue
        read: its reader
    """

    name: str
    tables: tuple[str, ...]
    example: Mapping[str, Any]
    read: Callable[[Table], object]


def _kinds() -> tuple[_Kind, ...]:
    paper = support.read_toml(model.PAPER.path).content
    sweep = {
        "vary": {"J": {"values": [0.01135]}},
        "sampling": {"method": "latin-hypercube", "count": 1},
        "results": [{"kind": "final", "variable": "theta"}],
    }
    return (
        _Kind(
            "parameter file",
            ("body", "gravity", "geometry", "forward", "backward"),
            paper,
            model.read_parameter_file,
        ),
        _Kind(
            "project",
            ("body", "gravity", "geometry", *reports.LABORATORY_TABLES),
            support.read_toml(reports.EXAMPLE_LABORATORY).content,
            reports.read_laboratory,
        ),
        _Kind(
            "settings of a sweep",
            ("vary", "sampling", "results", "experiment"),
            sweep,
            lambda root: runs.Sweep(runs.read_settings(root, found_or_built)),
        ),
        _Kind(
            "settings of a fit",
            ("free", "ties", "noise", "compare", "search", "uncertainty"),
            {"free": {"J": {}}},
            lambda root: identification.read_fit_settings(root, found_or_built),
        ),
    )


def run(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="FILE", help="Project, parameter file, or settings of a sweep or a fit."),
    ] = None,
    schemas: Annotated[
        Path | None,
        typer.Option(
            "--schemas",
            metavar="FOLDER",
            help="Write JSON schemas of these files, for editors, and of what --json writes.",
        ),
    ] = None,
) -> None:
    """List all mistakes in projects, parameter files and settings of sweeps and fits.

    The exit code is 1 if there are any. Editors that support JSON schemas show them while you type, if the
    first line is, for example, `#:schema schemas/joystick.schema.json`.
    """
    if not files and schemas is None:
        raise typer.BadParameter("give a FILE, or --schemas")
    for path in [] if schemas is None else reports.write_schemas(schemas):
        print_progress(f"wrote {path}")
    wrong = False
    for file in files or []:
        try:
            kind, found = _checked(file)
        except PyJoystickError as error:
            kind, found = "", [error]
        for one in found:
            print_error(str(one))
        wrong = wrong or bool(found)
        if not found:
            output().print(f"{file}: {kind}, nothing wrong", markup=False)
    if wrong:
        raise typer.Exit(1)


def _checked(file: Path) -> tuple[str, list[PyJoystickError]]:
    """Kind of a file, and its mistakes."""
    keys, kinds = support.read_toml(file).content.keys(), _kinds()
    kind = max(kinds, key=lambda one: len(keys & set(one.tables)))
    if not keys & set(kind.tables):
        names = "; ".join(f"{one.name}: {', '.join(one.tables)}" for one in kinds)
        raise InputFileError(file, f"contains no table that shows what kind of file it is ({names})")
    return kind.name, support.mistakes(file, kind.read, kind.example)
