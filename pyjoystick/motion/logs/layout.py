"""What a user says about the form of a file and the readings in it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Layout:
    """The form of a file; what is empty is found out, or refused where more than one thing is possible.

    Attributes:
        delimiter: what separates columns of text: comma, semicolon, tab, bar, space or the character itself
        decimal: the decimal mark, ``.`` or ``,``
        encoding: of a text file, as Python names it
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
        factor: SI units for one of `reading`
        reading: unit of the readings: V, mV or count
        zero: reading at the value zero
    """

    factor: float
    reading: str
    zero: float = 0.0
