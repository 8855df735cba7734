"""Saving of measured values in a parameter file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pyjoystick import laboratory, model
from pyjoystick.cli.console import print_progress, print_warning
from pyjoystick.cli.plausibility import require_plausible


def file_to_update(path: Path | None) -> model.ParameterFile:
    """The parameter file; the paper's if none is given or it does not exist yet.

    Raises:
        InputFileError, SettingsError: the file cannot be used
    """
    return model.PAPER if path is None or not path.exists() else model.read_parameter_file(path)


def write_update(
    path: Path,
    joystick: model.JoystickParameters,
    uncertainties: Mapping[str, float],
    sources: Mapping[str, str],
) -> None:
    """Update or create the file, and report what was written.

    Raises:
        ImplausibleError: a changed number is implausible
        SettingsError, OutputFileError: it cannot be written; an existing file is left unchanged
    """
    before = file_to_update(path).joystick.to_names()
    require_plausible({name: one for name, one in joystick.to_names().items() if one != before.get(name)})
    new = not path.exists()
    shown = {place: model.rounded_error(value) for place, value in uncertainties.items()}
    model.write_parameters(path, joystick, uncertainties=shown, sources=sources)
    tables = ", ".join(f"[{table}]" for table in sources)
    print_progress(f"wrote {tables} of {path}")
    if new:
        print_warning(f"{path} is new: all other values are the paper's")


def write_measured(path: Path, before: model.ParameterFile, found: laboratory.MeasuredValues) -> None:
    """Call `write_update` for a measurement; `before` is the result of `file_to_update`."""
    write_update(path, before.joystick.replace(found.values), found.uncertainties, found.sources)
