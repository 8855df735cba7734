"""Numbers with no more digits than are known."""

from __future__ import annotations

import math

from pyjoystick.support import FloatArray

#: Digits of a standard uncertainty.
_DIGITS = 2
#: Digits of a number whose uncertainty nobody has stated.
_UNSTATED = 4


def with_uncertainty(value: float, uncertainty: float | None, factor: float = 1.0) -> tuple[str, str]:
    """A value to the last digit of its standard uncertainty, and that to two digits.

    Args:
        value: in SI units
        uncertainty: standard uncertainty; None or 0 where none is stated, infinite where nothing is known
        factor: from SI units to those that are shown
    """
    value = factor * value
    if uncertainty is None or uncertainty == 0.0:
        return _plain(value), "not stated"
    if not math.isfinite(uncertainty):
        return "not determined", ""
    error = abs(factor) * uncertainty
    # The digits are those of the rounded uncertainty: 0.0996 is 0.10.
    last = _DIGITS - 1 - math.floor(math.log10(float(f"{error:.{_DIGITS - 1}e}")))
    decimals = max(last, 0)
    return f"{round(value, last):.{decimals}f}", f"{round(error, last):.{decimals}f}"


def _plain(value: float) -> str:
    """As stated: short numbers whole, computed ones to four digits."""
    text = f"{value:.9g}"
    digits = len(text.lstrip("-").replace(".", "").lstrip("0").split("e")[0])
    return text if digits <= _UNSTATED + 2 else f"{value:.{_UNSTATED}g}"


def row_cells(table: FloatArray, known: FloatArray | None, row: int, *shown: tuple[str, float]) -> list[str]:
    """The cells of a row: to the digits that are known, or in the format given; empty for NaN.

    Args:
        table: numbers in SI units
        known: their standard uncertainties, the same rows
        row: which
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
