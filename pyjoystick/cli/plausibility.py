"""Plausibility checks, which ``pyjoystick --implausible`` disables."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final

from pyjoystick import model, support
from pyjoystick.cli.console import print_note
from pyjoystick.cli.invocation import invocation

_INSIST: Final = "pyjoystick --implausible COMMAND accepts it."


def require_plausible(values: Mapping[str, float], *, options: Mapping[str, str] | None = None) -> None:
    """Reject values that were most likely meant in another unit.

    Args:
        values: in SI units, by name, see `model.require_plausible`
        options: options that gave the values, by name, for the message

    Raises:
        ImplausibleError: a value is far outside the range of joysticks, and --implausible was not given
    """
    for name, value in values.items() if not invocation.implausible else ():
        model.require_plausible(name, value, field=(options or {}).get(name, ""), insist=_INSIST)


def require_length(option: str, length: float | None) -> None:
    """Call `require_plausible` for a distance (m) from the pivot to a point on the handle, if given."""
    if length is not None:
        require_plausible({"pivot_to_top": length}, options={"pivot_to_top": option})


def require_uncertainties(
    errors: Mapping[str, float], values: Mapping[str, float], *, option: str = "--uncertainty"
) -> None:
    """Reject negative standard uncertainties, and those above a third of the value.

    Args:
        errors: by name
        values: by name, all in SI units
        option: the option that gave them, for the message

    Raises:
        ParameterError: one is negative, or no finite number
        ImplausibleError: one is larger, and --implausible was not given
    """
    for name, error in errors.items():
        support.not_negative(f"{option} {name}", error)
    for name, error in errors.items() if not invocation.implausible else ():
        most = abs(values.get(name, 0.0)) / 3.0
        if error > most > 0.0:
            allowed = f"below a third of {name} = {values[name]:g}, in the same unit"
            raise model.ImplausibleError(f"{option} {name}", error, allowed, _INSIST)


def note_small_angle(option: str, text: str, degrees: float) -> None:
    """Note that a bare number is in degrees if it could be meant in radians, as small angles are allowed."""
    if 0.0 < abs(degrees) < math.pi / 2.0:
        print_note(
            f"note: {option} {text} is in degrees; in radians it is written {text}rad, "
            f"{math.degrees(degrees):.4g} degrees"
        )
