"""A joystick's FMU as a system for SSP tools, with values and uncertainties in a separate file."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from pyjoystick.model import LawName, ParameterFile, fmu_values
from pyjoystick.runs import Component, CoupledSystem, ParameterNote, write_ssp

#: End of the proposed experiment (s).
_STOP = 1.5


def export_ssp(
    file: ParameterFile, fmu: str | PathLike[str], path: str | PathLike[str], *, law: LawName | None = None
) -> None:
    """Write an SSP archive with the joystick as its only component.

    The values are in ``resources/<name>.ssv``, each with its unit, and with its standard uncertainty and its
    source as description and as annotation.

    Args:
        file: the joystick
        fmu: its FMU, which gives the component its name
        path: the .ssp file
        law: damping law of the FMU; by default that of the file

    Raises:
        SettingsError: the file has no parameters of that law
        FmuNotFoundError, FmuFileError, UnknownParameterError: the FMU is not one of this joystick
        OutputFileError: the file cannot be written
    """
    name, values = Path(fmu).stem, fmu_values(file, law)
    joystick = Component(name, Path(fmu), {one.name: one.value for one in values})
    notes = {one.name: ParameterNote(one.uncertainty, one.source) for one in values}
    system = CoupledSystem(name, (joystick,), (), _STOP, file.title)
    write_ssp(system, path, notes={name: notes})
