"""Writing what was measured into a parameter file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pyjoystick.cli.console import print_note
from pyjoystick.model import (
    PAPER,
    JoystickParameters,
    ParameterFile,
    read_parameter_file,
    rounded_error,
    write_parameters,
)


def file_to_update(path: Path) -> ParameterFile:
    """The file as it is; the paper's where there is none yet.

    Raises:
        InputFileError, SettingsError: the file cannot be used
    """
    return read_parameter_file(path) if path.exists() else PAPER


def write_update(
    path: Path, joystick: JoystickParameters, uncertainties: Mapping[str, float], sources: Mapping[str, str]
) -> None:
    """Update the file, or begin one, and say what is in it.

    Raises:
        SettingsError, OutputFileError: it cannot be written; what was there before is still there
    """
    new = not path.exists()
    shown = {place: rounded_error(value) for place, value in uncertainties.items()}
    write_parameters(path, joystick, uncertainties=shown, sources=sources)
    tables = ", ".join(f"[{table}]" for table in sources)
    print_note(f"wrote {tables} of {path}")
    if new:
        print_note(f"{path} is new: everything but {tables} is the paper's")
