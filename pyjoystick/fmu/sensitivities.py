"""Derivatives of whole runs by parameters: what an FMU that is built for them has as outputs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Final

from pyjoystick.fmu.description import FmuDescription, Variable, read_description
from pyjoystick.fmu.errors import UnsupportedFmuError

#: The folder beside an FMU in which one of the same name and model has sensitivities.
FOLDER: Final = "sensitivities"
_PREFIX: Final = "sensitivity."


def sensitivity_name(variable: str, parameter: str) -> str:
    """The output of an FMU that is the derivative of a variable by a parameter."""
    return f"{_PREFIX}{variable}.{parameter}"


def has_sensitivities(description: FmuDescription) -> bool:
    """Whether the FMU was built for any."""
    return any(name.startswith(_PREFIX) for name in description.variables)


def counterpart(description: FmuDescription) -> Path | None:
    """The FMU of the same model beside this one that has sensitivities.

    Raises:
        UnsupportedFmuError: there is one of that name, but of another model, or with other start values
    """
    path = description.path.parent / FOLDER / description.path.name
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
    """The outputs of an FMU for each pair, those of one variable together.

    Raises:
        UnsupportedFmuError: the FMU was not built for one of them
    """
    parameters = list(by)
    names = [sensitivity_name(output, parameter) for output in outputs for parameter in parameters]
    missing = [name for name in names if name not in description.variables]
    if missing:
        raise UnsupportedFmuError(description.path, f"has no {missing[0]}: {advice(description)}")
    return names


def advice(description: FmuDescription) -> str:
    """How to get an FMU with sensitivities."""
    return (
        f"build it with `python -m fmu_build {description.model_name} --output "
        f"{description.path.parent / FOLDER} --sensitivity VARIABLES:PARAMETERS`"
    )
