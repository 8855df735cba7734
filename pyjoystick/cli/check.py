"""``pyjoystick check``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from pyjoystick import identification, model, runs, support
from pyjoystick.cli.console import output, print_error
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.support import InputFileError, PyJoystickError, Table

EXAMPLES: Final = """
Examples:

    pyjoystick check joystick.toml fit.toml
    pyjoystick check scenarios/sweeps/*.toml
"""
#: Tables by which a file is known.
_TABLES: Final[Mapping[str, tuple[str, ...]]] = {
    "parameter file": ("body", "gravity", "geometry", "forward", "backward"),
    "settings of a sweep": ("vary", "sampling", "results", "experiment"),
    "settings of a fit": ("free", "ties", "noise", "compare", "search", "uncertainty"),
}
#: What is put in the place of mistakes, so that the rest can be read.
_SWEEP: Final = {
    "vary": {"J": {"values": [0.01135]}},
    "sampling": {"method": "latin-hypercube", "count": 1},
    "results": [{"kind": "final", "variable": "theta"}],
}
_FIT: Final[Mapping[str, Any]] = {"free": {"J": {}}}


def run(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE", help="Parameter file, or settings of a sweep or a fit.")
    ],
) -> None:
    """List everything that is wrong in parameter files and in settings of sweeps and fits.

    The exit code is 1 if anything is wrong.
    """
    wrong = False
    for file in files:
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
    """What a file is, and its mistakes."""
    content = support.read_toml(file).content
    shares = {kind: len(content.keys() & set(tables)) for kind, tables in _TABLES.items()}
    kind = max(shares, key=shares.__getitem__)
    if not shares[kind]:
        names = "; ".join(f"{kind}: {', '.join(tables)}" for kind, tables in _TABLES.items())
        raise InputFileError(file, f"has no table of a file that is known ({names})")
    example: Mapping[str, Any] = _FIT
    if kind == "parameter file":
        example = support.read_toml(model.PAPER.path).content
    elif kind == "settings of a sweep":
        example = _SWEEP

    def read(root: Table) -> None:
        if kind == "parameter file":
            model.read_parameter_file(root)
        elif kind == "settings of a sweep":
            runs.Sweep(runs.read_settings(root, found_or_built))
        else:
            identification.read_fit_settings(root, found_or_built)

    return kind, support.mistakes(file, read, example)
