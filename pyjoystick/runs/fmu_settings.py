"""Entries about FMUs in settings files: the FMU, and values of its variables with or without a unit."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from pyjoystick.fmu import (
    MODELS,
    REALS,
    FmuDescription,
    Value,
    Variable,
    checked_value,
    find_fmu,
    read_description,
)
from pyjoystick.model import FRICTION_NAMES, STOP_NAMES, read_parameter_file, values_for
from pyjoystick.runs.joystick_fmus import law_of_fmu
from pyjoystick.support import ParameterError, Table

_HINTS: Final = {
    **dict.fromkeys(FRICTION_NAMES, "JoystickFriction and JoystickFrictionPowerLaw have friction"),
    **dict.fromkeys(STOP_NAMES, "MountedJoystick and MountedJoystickPowerLaw have stops"),
}
_AMOUNT: Final = re.compile(r"\s*(?P<number>[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)\s*(?P<unit>\S+)\s*")


def fmu_of(table: Table, find: Callable[[str], Path] = find_fmu) -> FmuDescription:
    """The FMU of the key ``path`` of [fmu]: a name, or a path relative to the settings' folder.

    Raises:
        SettingsError: the key is missing
        FmuNotFoundError, FmuFileError: there is no such FMU, or it is broken
    """
    name = table.text("path")
    return read_description(find(name if name in MODELS else str(table.path.parent / name)))


def joystick_values(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    """Values from the parameter file named by the key ``parameters`` of [fmu], if there is one.

    Args:
        table: the table [fmu]; the path in it is relative to the settings' folder
        fmu: a joystick, whose damping law is taken from the file

    Returns:
        values by name of the FMU's parameters; empty if the key is absent

    Raises:
        InputFileError, SettingsError: the file cannot be used, or the FMU is not a joystick
    """
    if "parameters" not in table:
        return {}
    file = read_parameter_file(table.path.parent / table.text("parameters"))
    values: dict[str, Value] = dict(values_for(file.with_law(law_of_fmu(fmu)), fmu.variables))
    for name in values:
        if name not in fmu.variables:
            reason = f"is for joysticks, and {fmu.model_name} has no {name}"
            raise table.error("parameters", reason, _HINTS.get(name, ""))
    return values


def value_of(variable: Variable, given: Any) -> Value:
    """Value of a variable: a plain value, or text such as ``-20deg`` converted to the variable's unit.

    The unit must be the FMU's own or its display unit.

    Raises:
        ParameterError: another type or unit, or outside the range that the FMU allows
    """
    if isinstance(given, str) and variable.type in REALS:
        return checked_value(variable, _converted(variable, given, is_difference=False))
    return checked_value(variable, given)


def number_of(variable: Variable, given: Any) -> float:
    """As `value_of`, for a real variable."""
    return float(value_of(variable, given))


def difference_of(variable: Variable, given: Any) -> float:
    """A difference of two values of a real variable, such as a standard deviation, above zero.

    Raises:
        ParameterError: another type or unit, or not above zero
    """
    number = _converted(variable, given, is_difference=True) if isinstance(given, str) else given
    if isinstance(number, bool) or not isinstance(number, int | float) or not 0.0 < number < float("inf"):
        raise ParameterError(variable.name, given, f"a finite number above 0 {variable.unit}".rstrip())
    return float(number)


def _converted(variable: Variable, text: str, *, is_difference: bool) -> float:
    match = _AMOUNT.fullmatch(text)
    display = variable.display_unit
    if match and match["unit"] == variable.unit:
        return float(match["number"])
    if match and display and match["unit"] == display.unit:
        offset = 0.0 if is_difference else display.offset
        return (float(match["number"]) - offset) / display.factor
    units = [unit for unit in (variable.unit, display.unit if display else "") if unit]
    if not units:
        raise ParameterError(variable.name, f'"{text}"', "a number: the FMU gives no unit")
    allowed = f"a number in {variable.unit}" if variable.unit else "a number"
    raise ParameterError(variable.name, f'"{text}"', f"{allowed}, or text with the unit {' or '.join(units)}")
