"""Results that are NaN or infinite.

They are told, not refused: an FMU of another tool may say by NaN that an output has no value, and its other
outputs are right.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import NotFiniteWarning
from pyjoystick.support import FloatArray

#: Variables that a message names.
_NAMED: Final = 5


def first_not_finite(instants: FloatArray, columns: Mapping[str, NDArray[Any]]) -> str:
    """Say which variables are NaN or infinite and when first, as in ``x is nan at t = 0.5 s``; else empty.

    Args:
        instants: sample times (s), shape (samples,)
        columns: samples by variable, of any type
    """
    found = [
        f"{name} is {column[i]} at t = {instants[i]:.9g} s"
        for name, column in columns.items()
        if column.dtype.kind == "f"
        for i in np.flatnonzero(~np.isfinite(column))[:1]
    ]
    if len(found) > _NAMED:
        found[_NAMED:] = [f"{len(found) - _NAMED} other variables"]
    return ", ".join(found)


def warn_not_finite(path: Path, instants: FloatArray, columns: Mapping[str, NDArray[Any]]) -> None:
    """Issue a NotFiniteWarning if there is something to say, for the caller of a function of the package."""
    said = first_not_finite(instants, columns)
    if said:
        warnings.warn(f"{path.name}: results are not finite: {said}", NotFiniteWarning, stacklevel=3)
