"""Formatting of numbers to their significant digits."""

from __future__ import annotations

import math

from pyjoystick.support import FloatArray

#: Digits of a standard uncertainty.
_DIGITS = 2
#: Digits of a number without a stated uncertainty.
_UNSTATED = 4


def with_uncertainty(value: float, uncertainty: float | None, factor: float = 1.0) -> tuple[str, str]:
    """Format a value to the last digit of its standard uncertainty, which has two digits.

    Args:
        value: in SI units
        uncertainty: standard uncertainty; None or 0 if not stated, infinite if nothing is known
        factor: from SI units to those displayed
    """
    value = factor * value
    if uncertainty is None or uncertainty == 0.0:
        return _plain(value), "not stated"
    if not math.isfinite(uncertainty):
        return "not determined", ""
    error = abs(factor) * uncertainty
    # Use the digits of the rounded uncertainty: 0.0996 is 0.10.
    last = _DIGITS - 1 - math.floor(math.log10(float(f"{error:.{_DIGITS - 1}e}")))
    decimals = max(last, 0)
    return f"{round(value, last):.{decimals}f}", f"{round(error, last):.{decimals}f}"


def _plain(value: float) -> str:
    """Short numbers as stated, computed ones to four digits."""
    text = f"{value:.9g}"
    digits = len(text.lstrip("-").replace(".", "").lstrip("0").split("e")[0])
    return text if digits <= _UNSTATED + 2 else f"{value:.{_UNSTATED}g}"


def row_cells(table: FloatArray, known: FloatArray | None, row: int, *shown: tuple[str, float]) -> list[str]:
    """Cells of a row, to the significant digits or in the given format; empty for NaN.

    Args:
        table: numbers in SI units
        known: their standard uncertainties, with the same rows
        row: index of the row
        shown: format and factor of each column
    """
    cells = []
    for column, (form, factor) in enumerate(shown):
        value = float(table[row, column])
        if math.isnan(value):
            cells.append("")
        elif known is None or not known[row, column] > 0.0:
            cells.append(f"{factor * value:{form}}")
        else:
            text = with_uncertainty(value, float(known[row, column]), factor)[0]
            cells.append(f"+{text}" if "+" in form and value > 0.0 else text)
    return cells
