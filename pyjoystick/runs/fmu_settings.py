"""Entries about FMUs in settings files: the FMU, and values of its variables with or without a unit."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from decimal import Decimal
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
from pyjoystick.model import FRICTION_NAMES, STOP_NAMES, read_parameter_file, units_of, values_for
from pyjoystick.motion import UNITS, amount_of, plain_unit
from pyjoystick.runs.joystick_fmus import NO_UNIT, law_of_fmu
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


def amount_for(name: str, text: str, fmus: Sequence[FmuDescription]) -> float:
    """A number in the unit that FMUs declare for a variable, from text such as ``24.1mm``.

    The text may have the declared unit, the display unit, or another unit of the same kind. Without a
    declared unit, nothing tells what the unit of a text means.

    Raises:
        ValueError: the text does not start with a number
        ParameterError: another unit, or the FMUs declare different ones
    """
    variables = [fmu.variables[name] for fmu in fmus if name in fmu.variables]
    declared = {plain_unit(variable.unit) for variable in variables}
    if len(declared) > 1:
        names = " and ".join(variable.unit or "none" for variable in variables)
        raise ParameterError(
            name, text, "a number without a unit", f"the FMUs declare different ones: {names}"
        )
    return amount_of(name, text, _units(variables[0]) if variables else {})


def _units(variable: Variable) -> dict[str, float]:
    """Units in which values of a variable may be given, with factors to the declared unit."""
    declared = plain_unit(variable.unit)
    if declared in NO_UNIT:
        return {}
    kinds = [units for units in UNITS.values() if declared in units]
    own = units_of(variable.name) or {}
    # What g declares is not certain: it is a mass or an acceleration.
    known = own if declared in own else kinds[0] if len(kinds) == 1 else {declared: 1.0}
    base = Decimal(repr(known[declared]))
    units = {unit: float(Decimal(repr(factor)) / base) for unit, factor in known.items()}
    display = variable.display_unit
    if display and not display.offset:
        units.setdefault(plain_unit(display.unit), 1.0 / display.factor)
    return units


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
