"""Reading XLSX and ODS workbooks as tables of cells, with times as they are stored.

A workbook stores times and durations exactly and shows them rounded. openpyxl rounds them to milliseconds,
and pandas reads those of ODS from the text that is shown.
"""

from __future__ import annotations

import datetime
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import pandas as pd

from pyjoystick.support import is_number_text, number_of_text

if TYPE_CHECKING:
    from odf.element import Element

_DAY: Final = 86_400
_NANO: Final = 1_000_000_000
_DURATION: Final = re.compile(
    r"(?P<sign>-?)P((?P<days>\d+)D)?"
    r"(T((?P<hours>\d+)H)?((?P<minutes>\d+)M)?((?P<seconds>\d+)([.,](?P<fraction>\d+))?S)?)?"
)
#: Types of cells with numbers, and errors that they show: ``#DIV/0!``, ``#WERT!``, ``Err:502``.
_NUMBERS: Final = ("float", "percentage", "currency")
_ERROR: Final = re.compile(r"#[^\s\d].*|[^\W\d]+ ?:\d{3}")
_UNITS: Final = {"days": _DAY, "hours": 3600, "minutes": 60, "seconds": 1}


def read_xlsx(path: Path) -> dict[str, pd.DataFrame]:
    """Cells of each sheet; those with a date, time or duration as texts in ISO 8601, to the nanosecond."""
    from openpyxl import load_workbook

    book = load_workbook(path, read_only=True, data_only=True, keep_links=False)
    try:
        # Without these sets, openpyxl leaves the numbers of such cells as they are stored.
        book._date_formats.clear()
        tables = {}
        for sheet in book.worksheets:
            sheet.reset_dimensions()  # those that the file states may be wrong
            rows = [[_cell(cell, book.epoch.date()) for cell in row] for row in sheet.rows]
            tables[sheet.title] = _table(rows)
        return tables
    finally:
        book.close()


def _cell(cell: Any, epoch: datetime.date) -> object:
    from openpyxl.styles.numbers import is_timedelta_format

    if cell.data_type == "e":
        return float("nan")
    if cell.is_date and isinstance(cell.value, int | float):
        return _time(cell.value, None if is_timedelta_format(cell.number_format) else epoch)
    return "" if cell.value is None else cell.value


def _time(days: float, epoch: datetime.date | None) -> object:
    """A number of days as a date with a time of day after `epoch`, or as a duration without one."""
    whole, part = divmod(days, 1)
    ticks = int(whole) * _DAY * _NANO + round(part * _DAY * _NANO)
    if epoch is None:
        return _seconds(ticks)
    day, rest = divmod(ticks, _DAY * _NANO)
    second, fraction = divmod(rest, _NANO)
    try:
        date = epoch + datetime.timedelta(days=day)
    except OverflowError:  # Excel shows no date, either
        return float("nan")
    clock = f"{second // 3600:02d}:{second // 60 % 60:02d}:{second % 60:02d}"
    return f"{date.isoformat()}T{clock}.{fraction:09d}"


def _seconds(ticks: int) -> str:
    """A duration in nanoseconds as a text in seconds."""
    whole, fraction = divmod(abs(ticks), _NANO)
    return f"PT{'-' if ticks < 0 else ''}{whole}.{fraction:09d}S"


def _table(rows: Sequence[Sequence[object]]) -> pd.DataFrame:
    """Rows of one length without the empty ones at the end, which a sheet may have by the thousand."""
    filled = [i for i, row in enumerate(rows) if any(cell != "" for cell in row)]
    kept = rows[: filled[-1] + 1] if filled else []
    width = max(map(len, kept), default=0)
    return pd.DataFrame([[*row, *[None] * (width - len(row))] for row in kept], dtype=object)


def read_ods(path: Path) -> dict[str, pd.DataFrame]:
    """Cells of each sheet; durations and times of day as texts in seconds, to the nanosecond.

    A formula's error is an empty cell, also where it is stored as a number with the text ``#DIV/0!``.

    Raises:
        ValueError: a stored duration is not in ISO 8601
    """
    from odf.table import TableCell

    with pd.ExcelFile(path, engine="odf") as file:
        for cell in file.book.getElementsByType(TableCell):
            kind = cell.getAttribute("valuetype")
            if kind == "time":
                _show(cell, duration_in_seconds(cell.getAttribute("timevalue") or ""))
            elif kind in _NUMBERS and _is_error(cell):
                _show(cell, "")
        return pd.read_excel(file, sheet_name=None, header=None, dtype=object, na_filter=False)


def _is_error(cell: Element) -> bool:
    """Whether a cell of a number shows an error, or has none that is finite."""
    from odf.teletype import extractText

    stored = cell.getAttribute("value") or ""
    is_finite = is_number_text(stored) and math.isfinite(number_of_text(stored))
    return not is_finite or _ERROR.fullmatch(extractText(cell).strip()) is not None


def _show(cell: Element, text: str) -> None:
    """Replace a cell by a text."""
    from odf.text import P

    for child in list(cell.childNodes):
        cell.removeChild(child)
    cell.setAttribute("valuetype", "string")
    cell.addElement(P(text=text))


def duration_in_seconds(text: str) -> str:
    """A duration in ISO 8601, as ``PT01H00M01.5S``, as ``PT3601.500000000S``; digits beyond 1 ns are cut.

    Raises:
        ValueError: the text is not such a duration, or has years or months, whose lengths differ
    """
    match = _DURATION.fullmatch(text)
    if match is None or not any(match[unit] for unit in _UNITS):
        raise ValueError(f"the duration of a cell, {text!r}, is not in ISO 8601")
    whole = sum(length * int(match[unit] or 0) for unit, length in _UNITS.items())
    ticks = whole * _NANO + int((match["fraction"] or "").ljust(9, "0")[:9])
    return _seconds(-ticks if match["sign"] else ticks)
