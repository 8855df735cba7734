"""Calibrations as people write them: ``0.0879deg/count``."""

from __future__ import annotations

import math
import re
from typing import Final

from pyjoystick.motion.logs.headings import reading_unit, scale_factor
from pyjoystick.motion.logs.layout import Scale
from pyjoystick.support import ParameterError

_SCALE: Final = re.compile(r"(?P<number>[-+0-9.eE]+?)\s*(?P<unit>[a-zA-Z°].*)/(?P<reading>[^/]+)")


def scale_of(name: str, text: str, zero: float = 0.0) -> Scale:
    """The calibration of a quantity.

    Args:
        name: theta, omega, T or F
        text: such as ``0.0879deg/count`` or ``2.5N.m/V``
        zero: reading at the value zero

    Raises:
        ParameterError: the text is no calibration of this quantity
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
