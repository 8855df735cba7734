"""The joystick that the options of a command describe."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pyjoystick import model
from pyjoystick.cli.plausibility import require_plausible
from pyjoystick.support import ParameterError


def parameter_file(path: Path | None) -> model.ParameterFile:
    """The file of --parameters; the paper's by default.

    Raises:
        InputFileError, SettingsError: the file cannot be used
    """
    return model.PAPER if path is None else model.read_parameter_file(path)


def joystick_of(
    law: model.LawName | None,
    changes: Mapping[str, float],
    file: model.ParameterFile | None = None,
    own: model.JoystickParameters | None = None,
) -> model.JoystickParameters:
    """Joystick of a parameter file, by default the paper's, with changes.

    Args:
        law: damping law; by default that of the file
        changes: values by name (SI units)
        file: the parameter file
        own: joystick to change instead of that of the file

    Raises:
        UnknownParameterError, ParameterError: a name or value is not allowed
        ImplausibleError: a value is implausible
        SettingsError: the file has no parameters for the damping law
    """
    for name in ("theta_start", "omega_start"):
        if name in changes:
            raise ParameterError(name, changes[name], "left out", "set the release with --release-angle")
    require_plausible(changes)
    if own is not None:
        return own.replace(changes)
    file = file or model.PAPER
    return (file.joystick if law is None else file.with_law(law)).replace(changes)
