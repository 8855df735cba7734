"""A joystick's FMU as a system for SSP tools, with values and their uncertainties in a file of their own."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from pyjoystick.model import LawName, ParameterFile, fmu_values
from pyjoystick.runs import Component, CoupledSystem, ParameterNote, write_ssp

#: End of the experiment that it proposes (s).
_STOP = 1.5


def export_ssp(
    file: ParameterFile, fmu: str | PathLike[str], path: str | PathLike[str], *, law: LawName | None = None
) -> None:
    """Write an SSP archive of one component, the joystick.

    Its values are in ``resources/<name>.ssv``, each with its unit, and with its standard uncertainty and its
    source as description and as annotation.

    Args:
        file: the joystick
        fmu: its FMU, which the component is called after
        path: the .ssp file
        law: damping law of the FMU; that which the file chooses by default

    Raises:
        SettingsError: the file has no numbers of that law
        FmuNotFoundError, FmuFileError, UnknownParameterError: the FMU is none of this joystick
        OutputFileError: the file cannot be written
    """
    name, values = Path(fmu).stem, fmu_values(file, law)
    joystick = Component(name, Path(fmu), {one.name: one.value for one in values})
    notes = {one.name: ParameterNote(one.uncertainty, one.source) for one in values}
    system = CoupledSystem(name, (joystick,), (), _STOP, file.title)
    write_ssp(system, path, notes={name: notes})
