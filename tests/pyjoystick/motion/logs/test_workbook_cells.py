"""Cells of workbooks that are no numbers, though they look like one or are stored as one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.motion import RecordError, read_log
from tests.pyjoystick.motion.logs.made import ANGLE, COUNT, TIME, TORQUE

DEG = np.radians(1.0)


def _written(path: Path, **columns: object) -> Path:
    names = {"time": "time (s)", "angle": "angle (deg)", "torque": "torque (mN.m)"}
    table = pd.DataFrame({names[name]: cells for name, cells in columns.items()}, dtype=object)
    with pd.ExcelWriter(path, engine={".xlsx": "openpyxl", ".ods": "odf"}[path.suffix]) as writer:  # type: ignore[call-overload]
        table.to_excel(writer, index=False)
    return path


@pytest.mark.parametrize("suffix", ["xlsx", "ods"])
def test_texts_that_may_separate_thousands_among_numbers_are_refused(suffix: str, tmp_path: Path) -> None:
    torque = [f"{x / 1000:.3f}" if x > 999 else x for x in np.linspace(900.0, 1500.0, COUNT).round().tolist()]
    path = _written(tmp_path / f"log.{suffix}", time=TIME, angle=ANGLE, torque=torque)
    with pytest.raises(
        RecordError, match=r"row 22: is not a number \(found ..1\.0\d\d.*\); it is stored as text"
    ):
        read_log(path)


def test_texts_with_other_decimals_are_numbers(tmp_path: Path) -> None:
    torque = [f"{1000.0 * x:.3f}" for x in TORQUE]
    log = read_log(_written(tmp_path / "log.xlsx", time=TIME, angle=ANGLE, torque=torque))
    np.testing.assert_allclose(log.series["T"], TORQUE, rtol=0.0, atol=1e-6)


@pytest.mark.parametrize("shown", ["#DIV/0!", "#WERT!", "Err:502", "Fehler:502", "#N/A", "#\u00a1VALOR!"])
def test_errors_stored_as_zero_in_ods_are_left_out(shown: str, tmp_path: Path) -> None:
    """As OpenOffice writes a formula without a result."""
    _spoil(tmp_path / "log.ods", "0", shown)
    log = read_log(tmp_path / "log.ods")
    assert log.left_out.tolist() == [51]
    assert any("row 51" in note or "rows 51" in note for note in log.notes)
    np.testing.assert_allclose(log.series["theta"], DEG * np.delete(ANGLE, 49), atol=1e-9)


@pytest.mark.parametrize("value", ["NaN", "inf", ""])
def test_cells_of_ods_without_a_finite_number_are_left_out(value: str, tmp_path: Path) -> None:
    _spoil(tmp_path / "log.ods", value, "1.5")
    assert read_log(tmp_path / "log.ods").left_out.tolist() == [51]


def _spoil(path: Path, value: str, shown: str) -> None:
    """Write a log in which the number of one cell is another than its text."""
    pytest.importorskip("odf")
    from odf.opendocument import load
    from odf.table import TableCell, TableRow
    from odf.text import P

    _written(path, time=TIME, angle=ANGLE)
    document = load(path)
    row = document.getElementsByType(TableRow)[50]
    row.removeChild(row.lastChild)
    cell = TableCell(valuetype="float", value=value)
    cell.addElement(P(text=shown))
    row.addElement(cell)
    document.save(path)
