"""Start values that modelDescription.xml declares, against those of the binary."""

from __future__ import annotations

import math
from typing import Final

from fmpy.fmi1 import FMICallException

from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.values import NUMBERS

#: The digits of a Float32.
_ROUNDING: Final = 1e-6


def contradiction(instance: Instance) -> str:
    """Name a parameter whose declared start value is not the one that the binary has; empty if none.

    Such a file was edited: a run would have one of the two values, depending on who asks.

    Args:
        instance: a new instance, with which nothing else can be done after this
    """
    declared = [
        one
        for one in instance.description.variables.values()
        if one.causality == "parameter" and one.type in NUMBERS and one.start and not one.is_array
    ]
    try:
        instance.begin_initialization(0.0, 1e-6, {})
        values = instance.get(declared)
    except FMICallException:
        return ""  # a run will say why
    for one, value in zip(declared, values, strict=True):
        if not math.isclose(float(one.start or 0.0), value, rel_tol=_ROUNDING):
            return f"{one.name} is {one.start} in its modelDescription.xml, but {value:g} in its binary"
    return ""
