"""How many digits of a measured number are worth writing."""

from __future__ import annotations

import math

#: Digits of a standard error, and digits of a value beyond the first one of its standard error.
_DIGITS = 2


def rounded(value: float, error: float) -> float:
    """A value to a hundredth of its standard error or better; as it is where there is no error."""
    if not 0.0 < error < math.inf:
        return value
    return round(value, _DIGITS - math.floor(math.log10(error)))


def rounded_error(error: float) -> float:
    """A standard error to two digits."""
    return float(f"{error:.{_DIGITS}g}")
