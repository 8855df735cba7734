"""Layout of a file and calibrations of its readings, as given by the user."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Final

from pyjoystick.motion.logs.headings import reading_unit, scale_factor
from pyjoystick.support import ParameterError

#: Calibrations as people write them: ``0.0879deg/count``.
_SCALE: Final = re.compile(r"(?P<number>[-+0-9.eE]+?)\s*(?P<unit>[a-zA-Z°].*)/(?P<reading>[^/]+)")


@dataclass(frozen=True, slots=True)
class Layout:
    """Layout of a file; empty values are detected, or rejected if ambiguous.

    Attributes:
        delimiter: separator of columns in text: comma, semicolon, tab, bar, space or the character itself
        decimal: the decimal mark, ``.`` or ``,``
        encoding: encoding of a text file, as in Python
        sheet: name of the sheet of a workbook, or of the structure in a MATLAB file
    """

    delimiter: str = ""
    decimal: str = ""
    encoding: str = ""
    sheet: str = ""


@dataclass(frozen=True, slots=True)
class Scale:
    """A linear calibration: value = factor (reading - zero).

    Attributes:
        factor: SI units per unit of `reading`
        reading: unit of the readings: V, mV or count
        zero: reading at the value zero
    """

    factor: float
    reading: str
    zero: float = 0.0


def scale_of(name: str, text: str, zero: float = 0.0) -> Scale:
    """Parse the calibration of a quantity.

    Args:
        name: theta, omega, T or F
        text: such as ``0.0879deg/count`` or ``2.5N.m/V``
        zero: reading at the value zero

    Raises:
        ParameterError: the text is not a calibration of this quantity
    """
    match = _SCALE.fullmatch(text)
    factor = scale_factor(name, match["unit"]) if match else None
    reading = reading_unit(match["reading"]) if match else ""
    try:
        number = float(match["number"]) if match else math.nan
    except ValueError:
        number = math.nan
    if factor is None or not reading or not math.isfinite(number) or number == 0.0:
        example = "such as theta=0.0879deg/count or T=2.5N.m/V; readings are in V, mV or count"
        raise ParameterError(name, text, example)
    return Scale(number * factor, reading, zero)
