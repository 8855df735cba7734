"""Derivatives of whole runs with respect to parameters, for FMUs with such outputs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Final

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.description_file import read_description
from pyjoystick.fmu.errors import UnsupportedFmuError
from pyjoystick.support import UnknownParameterError, UnknownVariableError

#: Folder next to an FMU that contains one of the same name and model with sensitivities.
FOLDER: Final = "sensitivities"
_PREFIX: Final = "sensitivity."


def sensitivity_name(variable: str, parameter: str) -> str:
    """Name of the output that is the derivative of a variable with respect to a parameter."""
    return f"{_PREFIX}{variable}.{parameter}"


def has_sensitivities(description: FmuDescription) -> bool:
    """Whether the FMU was built with sensitivities."""
    return any(name.startswith(_PREFIX) for name in description.variables)


def counterpart(description: FmuDescription, place: Path) -> Path | None:
    """Find the FMU of the same model with sensitivities, next to this one at `place`.

    Raises:
        UnsupportedFmuError: there is one of that name, but of another model or with other start values
    """
    path = place.parent / FOLDER / place.name
    if not path.is_file():
        return None
    other = read_description(path)
    own = description.variables
    if (
        other.model_name != description.model_name
        or not own.keys() <= other.variables.keys()
        or any(_start(other.variables[name]) != _start(one) for name, one in own.items())
    ):
        reason = f"is not the model of {description.path} with sensitivities: build it anew, or remove it"
        raise UnsupportedFmuError(path, reason)
    return path


def _start(variable: Variable) -> object:
    return variable.start if variable.settable_at_start else None


def wanted_names(description: FmuDescription, outputs: Iterable[str], by: Iterable[str]) -> list[str]:
    """Names of the sensitivity output for each pair, grouped by variable.

    Raises:
        UnknownParameterError, UnknownVariableError: the FMU has none of that name
        UnsupportedFmuError: the FMU was not built with one of them
    """
    variables, parameters = _names(outputs), _names(by)
    for parameter in parameters:
        if parameter not in description.variables:
            raise UnknownParameterError(parameter, description.settable_names())
    names = []
    for variable in variables:
        if variable not in description.variables:
            raise UnknownVariableError(variable, description.variables)
        for parameter in parameters:
            name = sensitivity_name(variable, parameter)
            if name not in description.variables:
                built = ", ".join(one for one in description.variables if one.startswith(_PREFIX))
                how = _command(description, "FOLDER", f"{','.join(variables)}:{','.join(parameters)}")
                raise UnsupportedFmuError(
                    description.path, f"has no {name}, only {built}: build an FMU of your own with {how}"
                )
            names.append(name)
    return names


def _names(given: Iterable[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def advice(description: FmuDescription) -> str:
    """How to obtain an FMU with sensitivities."""
    folder = description.path.parent / FOLDER
    return f"build it with {_command(description, str(folder), 'VARIABLES:PARAMETERS')}"


def _command(description: FmuDescription, folder: str, sensitivity: str) -> str:
    return f"`python -m fmu_build {description.model_name} --output {folder} --sensitivity {sensitivity}`"
