"""Units of measured quantities and their factors to SI units, for everything that is read."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from typing import Final

from pyjoystick.support import ParameterError

#: Standard gravity (m/s2), also the unit g of accelerations.
GRAVITY: Final = 9.80665

#: Inch (m), pound-force and kilogram-force (N), exactly.
_INCH: Final = 0.0254
_POUND_FORCE: Final = 4.4482216152605
_KILOGRAM_FORCE: Final = GRAVITY

_DEGREE: Final = math.radians(1.0)

#: Factors to SI units by kind of quantity and unit, in the spelling of `plain_unit`.
UNITS: Final[Mapping[str, Mapping[str, float]]] = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0},
    "angle": {"rad": 1.0, "deg": _DEGREE, "mrad": 1e-3, "mdeg": 1e-3 * _DEGREE, "gon": math.pi / 200.0},
    "angular velocity": {"rad/s": 1.0, "deg/s": _DEGREE, "mrad/s": 1e-3, "rpm": math.pi / 30.0},
    "angular acceleration": {"rad/s2": 1.0, "deg/s2": _DEGREE},
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": _INCH},
    "force": {
        "N": 1.0,
        "kN": 1e3,
        "mN": 1e-3,
        "kgf": _KILOGRAM_FORCE,
        "lbf": _POUND_FORCE,
        "lb": _POUND_FORCE,  # as testing machines write it
    },
    "torque": {
        "N.m": 1.0,
        "N.mm": 1e-3,
        "N.cm": 1e-2,
        "mN.m": 1e-3,
        "kN.m": 1e3,
        "lbf.in": _POUND_FORCE * _INCH,
        "lbf.ft": _POUND_FORCE * 12.0 * _INCH,
    },
    "mass": {"kg": 1.0, "g": 1e-3},
    "moment of inertia": {"kg.m2": 1.0, "g.m2": 1e-3, "kg.mm2": 1e-6, "g.cm2": 1e-7, "g.mm2": 1e-9},
    "acceleration": {"m/s2": 1.0, "mm/s2": 1e-3, "g": GRAVITY},
    "voltage": {"V": 1.0, "mV": 1e-3},
    "stiffness": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3, "kN/mm": 1e6},
    "damping": {"N.m.s/rad": 1.0, "N.m.s": 1.0, "mN.m.s/rad": 1e-3, "N.m.s/deg": 1.0 / _DEGREE},
}

_SPELLINGS: Final = str.maketrans(
    {
        "²": "2",
        "^": None,
        "°": "deg",
        "\N{MICRO SIGN}": "u",
        "\N{GREEK SMALL LETTER MU}": "u",
        "·": ".",
        "*": ".",
    }
)

_AMOUNT: Final = re.compile(
    r"\s*(?P<number>[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)(?P<unit>\s*([^\W\d_][^=]*|°[^=]*)?)"
)


def amount(text: str, units: Mapping[str, float]) -> float:
    """Parse a number in SI units from text such as ``24.1mm``; a number without a unit is in SI units.

    Decimal fractions stay exact: ``24.1mm`` is exactly the float 0.0241.

    Args:
        text: number and unit
        units: allowed units with their factors to the SI unit, as in `UNITS`

    Raises:
        ValueError: the text does not start with a number
        KeyError: the text after the number is not one of the units
    """
    match = _AMOUNT.fullmatch(text)
    if match is None:
        raise ValueError(text)
    unit = plain_unit(match["unit"])
    return float(Decimal(match["number"]) * Decimal(repr(units[unit]))) if unit else float(match["number"])


def amount_of(name: str, text: str, units: Mapping[str, float]) -> float:
    """As `amount`, for the quantity of this name.

    Raises:
        ValueError: the text does not start with a number
        ParameterError: the text after the number is not one of the units
    """
    try:
        return amount(text, units)
    except KeyError:
        named = ", ".join(filter(None, units))
        allowed = f"a number, or one with a unit: {named}" if named else "a number without a unit"
        raise ParameterError(name, text, allowed) from None


def plain_unit(text: str) -> str:
    """Normalize a unit to the spelling of `UNITS` and FMUs: ``°/s²`` to ``deg/s2``, ``N m`` to ``N.m``."""
    return ".".join(text.translate(_SPELLINGS).split())
