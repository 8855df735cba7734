"""Times and durations in workbooks, which store them exactly and show them rounded."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.motion import RecordError, read_log
from pyjoystick.motion.logs.workbooks import duration_in_seconds
from tests.pyjoystick.motion.logs.made import ANGLE, COUNT

#: 240 Hz, no period of which is a whole number of ms.
EXACT = np.arange(COUNT) / 240.0
DAY = 86_400.0


def _xlsx(path: Path, days: Sequence[float], number_format: str, *, mac: bool = False) -> Path:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    if mac:
        book.epoch = openpyxl.utils.datetime.MAC_EPOCH
    sheet = book.active
    sheet.append(["Time", "theta (deg)"])
    for row in zip(days, ANGLE.tolist(), strict=False):
        sheet.append(row)
        sheet.cell(sheet.max_row, 1).number_format = number_format
    book.save(path)
    return path


def _ods(path: Path, values: Sequence[str], shown: Sequence[str]) -> Path:
    pytest.importorskip("odf")
    from odf.opendocument import OpenDocumentSpreadsheet
    from odf.table import Table, TableCell, TableRow
    from odf.text import P

    def row(*cells: tuple[str, dict[str, Any]]) -> TableRow:
        made = TableRow()
        for text, attributes in cells:
            cell = TableCell(**attributes)
            cell.addElement(P(text=text))
            made.addElement(cell)
        return made

    table = Table(name="Log")
    table.addElement(row(*((text, {"valuetype": "string"}) for text in ("Time", "theta (deg)"))))
    for value, text, angle in zip(values, shown, ANGLE.tolist(), strict=False):
        time = (text, {"valuetype": "time", "timevalue": value})
        table.addElement(row(time, (f"{angle:.2f}", {"valuetype": "float", "value": repr(angle)})))
    document = OpenDocumentSpreadsheet()
    document.spreadsheet.addElement(table)
    document.save(path)
    return path


def _iso(seconds: float) -> str:
    """A duration as LibreOffice writes it."""
    hours, rest = divmod(seconds, 3600.0)
    minutes, rest = divmod(rest, 60.0)
    return f"PT{hours:02.0f}H{minutes:02.0f}M{rest:012.9f}S"


@pytest.mark.parametrize("number_format", ["[h]:mm:ss", "[ss].000", "mm:ss.0", "h:mm:ss AM/PM"])
@pytest.mark.parametrize("start", [100.0, DAY - 0.2], ids=["100 s", "midnight"])
def test_durations_in_xlsx_are_those_stored(number_format: str, start: float, tmp_path: Path) -> None:
    path = _xlsx(tmp_path / "log.xlsx", ((start + EXACT) / DAY).tolist(), number_format)
    np.testing.assert_allclose(read_log(path).series["time"], start + EXACT, rtol=0.0, atol=2e-9)


@pytest.mark.parametrize("mac", [False, True])
def test_dates_in_xlsx_have_the_digits_of_their_number(mac: bool, tmp_path: Path) -> None:
    days = 46_348.0 + (DAY - 0.2 + EXACT) / DAY
    path = _xlsx(tmp_path / "log.xlsx", days.tolist(), "yyyy-mm-dd hh:mm:ss", mac=mac)
    # A number of 46,348 days has a last digit of 0.6 us, and openpyxl writes 16 digits.
    np.testing.assert_allclose(read_log(path).series["time"], DAY - 0.2 + EXACT, rtol=0.0, atol=1e-6)


def test_negative_durations_in_xlsx(tmp_path: Path) -> None:
    path = _xlsx(tmp_path / "log.xlsx", ((EXACT - 0.2) / DAY).tolist(), "[h]:mm:ss.000")
    np.testing.assert_allclose(read_log(path).series["time"], EXACT - 0.2, rtol=0.0, atol=2e-9)


def test_a_date_beyond_the_calendar_is_no_number(tmp_path: Path) -> None:
    days = (46_348.0 + EXACT / DAY).tolist()
    days[7] = 1e9
    assert read_log(_xlsx(tmp_path / "log.xlsx", days, "yyyy-mm-dd hh:mm:ss")).left_out.tolist() == [9]


@pytest.mark.parametrize("start", [0.0, 3599.9, 30.0 * 3600.0], ids=["0", "1 h", "30 h"])
@pytest.mark.parametrize("shown", ["00:00:01.02", "00:01.0", "SS.000"])
def test_durations_in_ods_are_those_stored(start: float, shown: str, tmp_path: Path) -> None:
    path = _ods(tmp_path / "log.ods", [_iso(one) for one in start + EXACT], [shown] * COUNT)
    np.testing.assert_allclose(read_log(path).series["time"], start + EXACT, rtol=0.0, atol=2e-9)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("PT00H00M01.016666667S", "1.016666667"),
        ("-PT0H0M1.5S", "-1.500000000"),
        ("P1DT2H", "93600.000000000"),
        ("PT100H00M00,25S", "360000.250000000"),
        ("PT1.01666666666667S", "1.016666666"),
    ],
)
def test_forms_of_durations_in_ods(text: str, seconds: str) -> None:
    assert duration_in_seconds(text) == f"PT{seconds}S"


@pytest.mark.parametrize("value", ["", "P", "PT", "P1M", "00:00:01"])
def test_a_duration_in_ods_that_is_none(value: str, tmp_path: Path) -> None:
    path = _ods(tmp_path / "log.ods", [value] * COUNT, ["00:00:01"] * COUNT)
    with pytest.raises(RecordError, match=f"the duration of a cell, '{value}', is not in ISO 8601"):
        read_log(path)


@pytest.mark.parametrize(
    ("formats", "rows"),
    [
        (["General", *["[h]:mm:ss.000"] * (COUNT - 1)], "row 2"),
        ([*["h:mm:ss.000"] * (COUNT - 2), *["[h]:mm:ss.000"] * 2], f"rows {COUNT}-{COUNT + 1}"),
        ([*["General"] * 3, *["yyyy-mm-dd hh:mm:ss.000"] * (COUNT - 3)], "rows 2-4"),
    ],
)
def test_times_of_different_kinds(formats: list[str], rows: str, tmp_path: Path) -> None:
    """A number of days among times would count as seconds."""
    openpyxl = pytest.importorskip("openpyxl")
    path = _xlsx(tmp_path / "log.xlsx", list(1.2 + EXACT / DAY), "General")
    book = openpyxl.load_workbook(path)
    for number, one in enumerate(formats, start=2):
        book.active.cell(number, 1).number_format = one
    book.save(path)
    with pytest.raises(RecordError, match="times of day, dates, durations and numbers do not mix") as caught:
        read_log(path)
    assert rows in str(caught.value)
