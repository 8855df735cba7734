"""Parsing of option values: angles, assignments and names."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Final, TypeAlias

import typer

from pyjoystick import model, motion
from pyjoystick.cli.plausibility import note_small_angle
from pyjoystick.support import number_of_text

#: Converts a text with a unit for the variable of a name.
Convert: TypeAlias = Callable[[str, str], float]

_ANGLE: Final = re.compile(r"(?P<number>[-+0-9.eE]+)\s*(?P<unit>\D*)")


def parse_angle(text: str, option: str = "--release-angle") -> float:
    """Parse an angle in rad: ``-20``, ``-20deg`` or ``-0.35rad``; a bare number is in degrees.

    Raises:
        BadParameter: the text is not an angle, or 90 degrees or more
    """
    match = _ANGLE.fullmatch(text.strip())
    try:
        number = float(match["number"]) if match else math.nan
    except ValueError:
        number = math.nan
    unit = motion.plain_unit(match["unit"]) if match else ""
    if unit not in ("", *motion.UNITS["angle"]) or not math.isfinite(number):
        raise typer.BadParameter(f"{text!r} is not an angle; write -20deg or -0.35rad", param_hint=option)
    if not unit:
        note_small_angle(option, text.strip(), number)
    angle = math.radians(number) if unit in ("", "deg") else number * motion.UNITS["angle"][unit]
    if abs(angle) >= math.pi / 2.0:
        hint = f"; did you mean {number:g}deg?" if unit == "rad" and abs(number) < 90.0 else ""
        raise typer.BadParameter(f"{text!r} must lie between -90deg and 90deg{hint}", param_hint=option)
    return angle


def _of_joystick(name: str, text: str) -> float:
    return motion.amount_of(name, text, model.units_of(name) or {})


def parse_assignments(texts: Sequence[str] | None, option: str) -> dict[str, float]:
    """Parse numbers in SI units by name, such as ``damping.C=0.05`` or ``a=24.1mm``; names must be unique.

    Raises:
        BadParameter: a text does not have this form, or a name is given twice
        ParameterError: a unit does not fit the parameter
    """
    return numbers_of(parse_amounts(texts, option))


def parse_amounts(texts: Sequence[str] | None, option: str) -> dict[str, str]:
    """Numbers by name as they are written, with their units.

    Raises:
        BadParameter: a text does not have the form ``NAME=NUMBER``, or a name is given twice
    """
    amounts: dict[str, str] = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and _has_number(value)):
            raise typer.BadParameter(
                f"{text!r} must be NAME=NUMBER, such as damping.C=0.05", param_hint=option
            )
        if name in amounts:
            raise typer.BadParameter(f"{name} is given twice", param_hint=option)
        amounts[name] = value
    return amounts


def _has_number(text: str) -> bool:
    with suppress(ValueError):
        number_of_text(text)
        return True
    try:
        motion.amount(text, {})
    except KeyError:  # of a unit, which is looked up where the variable is known
        return True
    except ValueError:
        return False
    return True


def numbers_of(amounts: Mapping[str, str], convert: Convert = _of_joystick) -> dict[str, float]:
    """Numbers of `parse_amounts`; those with a unit are converted, by default to the joystick's SI units.

    Raises:
        ParameterError: a unit does not fit the parameter
    """
    return {name: _number(name, text, convert) for name, text in amounts.items()}


def _number(name: str, text: str, convert: Convert) -> float:
    try:
        number = number_of_text(text)
    except ValueError:
        return convert(name, text)
    return _exact(number, text) if 2.0**53 <= abs(number) <= 2.0**64 else number


def _exact(number: float, text: str) -> float:
    """A whole number with every digit of its text, which a float has not beyond 2^53; else `number`."""
    with suppress(InvalidOperation):  # a text with a unit
        exact = Decimal(text)
        if exact == exact.to_integral_value():
            return int(exact)
    return number


def parse_names(texts: Sequence[str] | None, option: str) -> dict[str, str]:
    """Parse texts by name, such as ``theta=Angle``.

    Raises:
        BadParameter: a text does not have this form
    """
    found = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and value):
            raise typer.BadParameter(f"{text!r} must be NAME=TEXT", param_hint=option)
        found[name] = value
    return found


def parse_headings(columns: Sequence[str] | None, units: Sequence[str] | None) -> dict[str, dict[str, str]]:
    """Arguments ``columns`` and ``units`` of a reader, from --column and --unit."""
    return {"columns": parse_names(columns, "--column"), "units": parse_names(units, "--unit")}


def parse_curves(texts: Sequence[str] | None) -> dict[model.Side, Path]:
    """Files of --curve by side; raises BadParameter as `parse_names` does, or for another side."""
    found: dict[model.Side, Path] = {}
    for name, file in parse_names(texts, "--curve").items():
        side = next((one for one in model.SIDES if one == name), None)
        if side is None:
            raise typer.BadParameter(f"{name!r} must be forward or backward", param_hint="--curve")
        found[side] = Path(file)
    return found


def refuse_given(reason: str, values: Mapping[str, object]) -> None:
    """Raise BadParameter for the first option that was given.

    Args:
        reason: why it is not allowed
        values: by option; None for an option that was not given
    """
    for option, value in values.items():
        if value is not None:
            raise typer.BadParameter(reason, param_hint=option)
