"""Values of an FMU's parameters from the parameter file of a joystick that settings name."""

from __future__ import annotations

from pyjoystick.fmu import FmuDescription, Value
from pyjoystick.model import LawName, read_parameter_file
from pyjoystick.support import Table


def values_from_joystick_file(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    """The values of the file that the key ``parameters`` of [fmu] names, relative to the settings' folder.

    Args:
        table: the table [fmu]
        fmu: a joystick; its damping law is the one that is taken from the file

    Returns:
        values by name of the FMU's parameters; nothing where the key is absent

    Raises:
        InputFileError, SettingsError: the file cannot be used, or the FMU is no joystick
    """
    if table.optional("parameters") is None:
        return {}
    file = read_parameter_file(table.path.parent / table.text("parameters"))
    law: LawName = "power-law" if "damping.alpha" in fmu.variables else "constant"
    values: dict[str, Value] = dict(file.with_law(law).to_names())
    for name in values:
        if name not in fmu.variables:
            raise table.error("parameters", f"is for joysticks, and {fmu.model_name} has no {name}")
    return values
