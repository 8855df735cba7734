"""Logs in workbooks, MATLAB and Parquet files, written by the standard packages for these formats."""

from __future__ import annotations

import datetime
import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pandas as pd
import pytest
from scipy.io import savemat

from pyjoystick.motion import Layout, RecordError, read_log, read_record
from tests.pyjoystick.motion.logs.made import ANGLE, COUNT, TIME, TORQUE

DEG = np.radians(1.0)
GERMAN = pd.DataFrame({"Zeit [s]": TIME, "Winkel [Grad]": ANGLE, "Drehmoment [Nm]": TORQUE})
#: The end of an archive whose one entry needs a later program.
LATER = (
    b"PK\3\4"
    + bytes(26)
    + b"PK\1\2"
    + struct.pack("<HH", 20, 95)
    + bytes(38)
    + b"PK\5\6"
    + struct.pack("<HHHHLLH", 0, 0, 1, 1, 46, 30, 0)
)
ENGINES = {"xlsx": "openpyxl", "ods": "odf"}


def _check(path: Path, *, torque: bool = False, **options: Any) -> None:
    log = read_log(path, **options)
    start = log.series["time"][0]
    np.testing.assert_allclose(log.series["time"] - start, TIME, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, rtol=0.0, atol=1e-12)
    assert ("T" in log.series) == torque
    if torque:
        np.testing.assert_allclose(log.series["T"], TORQUE, rtol=0.0, atol=1e-12)


def _workbook(path: Path, *sheets: tuple[str, pd.DataFrame], **options: Any) -> Path:
    engine = ENGINES[path.suffix[1:]]
    pytest.importorskip(engine)
    with pd.ExcelWriter(path, engine=engine) as writer:  # type: ignore[call-overload]
        for name, table in sheets:
            table.to_excel(writer, sheet_name=name, index=False, **options)
    return path


@pytest.mark.parametrize("suffix", ENGINES)
def test_a_workbook_is_read(suffix: str, tmp_path: Path) -> None:
    path = _workbook(tmp_path / f"log.{suffix}", ("Messung", GERMAN))
    _check(path, torque=True)
    record = read_record(path, free_oscillation=False)
    assert record.theta == pytest.approx(DEG * ANGLE)
    assert record.rows[0] == 2


@pytest.mark.parametrize("suffix", ENGINES)
def test_one_of_two_sheets_must_be_chosen(suffix: str, tmp_path: Path) -> None:
    path = _workbook(tmp_path / f"log.{suffix}", ("Run 1", 2.0 * GERMAN), ("Run 2", GERMAN))
    with pytest.raises(RecordError, match="2 sheets with content; say which: --sheet 'Run 1' or --sheet"):
        read_log(path)
    _check(path, torque=True, layout=Layout(sheet="Run 2"))
    with pytest.raises(RecordError, match="has no sheet 'Run 3'; there are 'Run 1', 'Run 2'"):
        read_log(path, layout=Layout(sheet="Run 3"))


def test_a_preamble_and_a_row_of_units_in_a_workbook(tmp_path: Path) -> None:
    units = pd.DataFrame([["Time", "Angle", "Torque"], ["s", "deg", "Nm"]])
    body = pd.DataFrame(np.column_stack([TIME, ANGLE, TORQUE]).astype(object))
    head = pd.DataFrame([["Bench 3", "", ""], ["Rate", 250, ""]])
    table = pd.concat([head, units, body])
    _check(_workbook(tmp_path / "log.xlsx", ("a", table), header=False), torque=True)


def test_rows_of_unequal_length_in_a_workbook(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    book.active.append(["Bench 3"])
    book.active.append(list(GERMAN))
    for row in GERMAN.to_numpy().tolist():
        book.active.append(row)
    book.save(tmp_path / "log.xlsx")
    _check(tmp_path / "log.xlsx", torque=True)


def test_numbers_as_text_with_commas_in_a_workbook(tmp_path: Path) -> None:
    table = pd.DataFrame({name: [f"{x:.12g}".replace(".", ",") for x in GERMAN[name]] for name in GERMAN})
    _check(_workbook(tmp_path / "log.xlsx", ("a", table)), torque=True)


def test_times_of_day_in_a_workbook(tmp_path: Path) -> None:
    start = datetime.datetime(2026, 11, 22, 10, 59, 59, 800_000)
    clock = [start + datetime.timedelta(milliseconds=4 * i) for i in range(COUNT)]
    table = pd.DataFrame({"Time": [one.time() for one in clock], "angle (deg)": ANGLE})
    _check(_workbook(tmp_path / "log.xlsx", ("a", table)))


#: Headings over cells that have a unit of their own.
OVER_DURATIONS = ["Time", "time (s)", "time (ms)", "time_ms", "time (min)"]


@pytest.mark.parametrize("heading", OVER_DURATIONS)
@pytest.mark.parametrize("suffix", ["xlsx", "parquet"])
def test_durations_are_in_seconds_whatever_the_heading_says(
    suffix: str, heading: str, tmp_path: Path
) -> None:
    path = tmp_path / f"log.{suffix}"
    durations = pd.to_timedelta(3599.9 + TIME, unit="s").round("us")
    table = pd.DataFrame({heading: durations, "angle (deg)": ANGLE})
    if suffix == "xlsx":
        _workbook(path, ("a", table.astype({heading: object})))
        _format_as_durations(path)
    else:
        pytest.importorskip("pyarrow")
        table.to_parquet(path)
    _check(path)
    assert read_log(path).series["time"][0] == pytest.approx(3599.9, abs=1e-9)


def _format_as_durations(path: Path) -> None:
    book = pytest.importorskip("openpyxl").load_workbook(path)
    for (cell,) in book.active.iter_rows(min_row=2, max_col=1):
        cell.number_format = "[h]:mm:ss.000"
    book.save(path)


def test_empty_cells_of_a_workbook_are_left_out(tmp_path: Path) -> None:
    table = GERMAN.copy()
    table.loc[5:7, "Winkel [Grad]"] = np.nan
    log = read_log(_workbook(tmp_path / "log.xlsx", ("a", table)))
    assert log.left_out.tolist() == [7, 8, 9]
    np.testing.assert_allclose(log.series["theta"], DEG * np.delete(ANGLE, [5, 6, 7]), atol=1e-12)


@pytest.mark.parametrize("suffix", ENGINES)
def test_empty_rows_of_a_workbook_take_the_time_of_a_sample(suffix: str, tmp_path: Path) -> None:
    table = pd.DataFrame({"n": np.arange(COUNT, dtype=float), "theta (deg)": ANGLE})
    table.loc[60:69] = np.nan
    log = read_log(_workbook(tmp_path / f"log.{suffix}", ("a", table)), rate=250.0)
    assert log.left_out.tolist() == list(range(62, 72))
    np.testing.assert_allclose(log.series["time"], np.delete(TIME, np.arange(60, 70)), atol=1e-12)


def test_an_empty_row_below_the_headings_of_a_workbook(tmp_path: Path) -> None:
    table = pd.concat([pd.DataFrame({name: [None] for name in GERMAN}, dtype=object), GERMAN])
    _check(_workbook(tmp_path / "log.xlsx", ("a", table)), torque=True)


def test_an_empty_row_between_samples_that_are_missing_at_first(tmp_path: Path) -> None:
    missing = pd.DataFrame({name: ["NaN", None] for name in GERMAN}, dtype=object)
    path = _workbook(tmp_path / "log.xlsx", ("a", pd.concat([missing, GERMAN])))
    _check(path, torque=True)
    assert read_log(path).left_out.tolist() == [2, 3]


UNITS = {"time": "s", "theta": "deg"}


def _matlab(path: Path, form: str, variables: dict[str, Any]) -> Path:
    if form == "7.3":
        h5py = pytest.importorskip("h5py")

        def fill(group: Any, values: dict[str, Any]) -> None:
            for name, value in values.items():
                if isinstance(value, dict):
                    fill(group.create_group(name), value)
                else:
                    group.create_dataset(name, data=np.atleast_2d(value).T)

        # MATLAB writes a text of 512 bytes before HDF5.
        with h5py.File(path, "w", userblock_size=512) as file:
            fill(file, variables)
        with path.open("r+b") as file:
            file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")
    else:
        savemat(path, variables, format=form)
    return path


@pytest.mark.parametrize("form", ["4", "5", "7.3"])
def test_vectors_in_a_matlab_file(form: str, tmp_path: Path) -> None:
    vectors = {"time_ms": 1e3 * TIME, "theta_deg": ANGLE, "torque_Nm": TORQUE}
    variables = {name: one[:, np.newaxis] for name, one in vectors.items()} | {"fs": np.array(250.0)}
    _check(_matlab(tmp_path / "log.mat", form, variables), torque=True)


@pytest.mark.parametrize("form", ["5", "7.3"])
def test_a_structure_in_a_matlab_file(form: str, tmp_path: Path) -> None:
    run = {"t": TIME, "angle": ANGLE, "other": {"force": TORQUE}}
    path = _matlab(tmp_path / "log.mat", form, {"run": run})
    with pytest.raises(
        RecordError, match=r"'run\.t': has no unit; its steps of 0.004 can be s or ms; say which"
    ):
        read_log(path)
    _check(path, units=UNITS)
    two = _matlab(tmp_path / "two.mat", form, {"a": run, "b": {"t": TIME[:-1], "angle": ANGLE[:-1]}})
    with pytest.raises(RecordError, match="2 sheets with content; say which: --sheet 'a' or --sheet 'b'"):
        read_log(two)
    _check(two, units=UNITS, layout=Layout(sheet="a"))


def test_a_matrix_in_a_matlab_file(tmp_path: Path) -> None:
    path = _matlab(tmp_path / "log.mat", "5", {"data": np.column_stack([TIME, ANGLE])})
    with pytest.raises(RecordError, match="There are 'data #1', 'data #2': --column "):
        read_log(path)
    _check(path, columns={"time": "data #1", "theta": "data #2"}, units=UNITS)


@pytest.mark.parametrize("missing", [slice(0, 3), slice(50, 53)], ids=["first", "inside"])
def test_samples_without_a_number_in_a_matlab_file(missing: slice, tmp_path: Path) -> None:
    time, theta = TIME.copy(), ANGLE.copy()
    time[missing] = theta[missing] = np.nan
    path = _matlab(tmp_path / "log.mat", "5", {"time_s": time, "theta_deg": theta})
    for options in ({}, {"rate": 250.0}):
        log = read_log(path, **options)
        assert log.left_out.tolist() == [2 + i for i in range(COUNT)[missing]]
        np.testing.assert_allclose(log.series["time"], TIME[~np.isnan(time)], atol=1e-12)


def test_vectors_of_different_lengths(tmp_path: Path) -> None:
    path = _matlab(tmp_path / "log.mat", "5", {"time_s": TIME, "theta_deg": ANGLE[:-1]})
    with pytest.raises(RecordError, match=r"different lengths \(time_s 120, theta_deg 119\)"):
        read_log(path)


def test_a_vector_that_is_too_long_is_not_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.motion.logs.sheets._LONGEST", 119)
    path = _matlab(tmp_path / "log.mat", "5", {"time_s": TIME, "theta_deg": ANGLE})
    with pytest.raises(RecordError, match="its variable time_s has 120 values; at most 119 are read"):
        read_log(path)


@pytest.mark.parametrize("index", [False, True])
def test_a_parquet_file(index: bool, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    table = GERMAN.set_index("Zeit [s]") if index else GERMAN
    table.to_parquet(tmp_path / "log.parquet")
    _check(tmp_path / "log.parquet", torque=True)


def test_times_in_a_parquet_file(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    stamps = pd.Timestamp("2026-11-22 23:59:59.9") + pd.to_timedelta(TIME, unit="s")
    pd.DataFrame({"timestamp": stamps, "theta_deg": ANGLE}).to_parquet(tmp_path / "log.parquet")
    _check(tmp_path / "log.parquet")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        (
            "a.c3d",
            b"\x02\x50" + bytes(600),
            "not an angle; .*: pyjoystick import markers .*a.c3d",
        ),
        ("a.xls", b"\xd0\xcf\x11\xe0" + bytes(600), "Excel 97 to 2003; save it as .xlsx"),
        ("a.xlsx", b"PK\3\4" + bytes(600), "is a damaged archive"),
        ("a.ods", LATER, "is a damaged archive: zip file version 9.5"),
        ("a.mat", b"MATLAB 5.0 MAT-file" + bytes(600), "cannot be read as matlab"),
        ("a.mat", b"\x89HDF\r\n" + bytes(600), "cannot be read as matlab 7.3"),
        ("a.parquet", b"PAR1" + bytes(600), "cannot be read as parquet"),
        ("a.bin", bytes(range(256)) * 4, "is not UTF-8 text"),
    ],
)
def test_other_and_damaged_files(name: str, content: bytes, message: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    for read in (read_log, read_record):
        with pytest.raises(RecordError, match=message):
            read(tmp_path / name)


@pytest.mark.parametrize(
    ("suffix", "module", "extra"), [("xlsx", "openpyxl", "excel"), ("ods", "odf", "ods")]
)
def test_a_missing_package_is_named(
    suffix: str, module: str, extra: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = _workbook(tmp_path / f"log.{suffix}", ("a", GERMAN))
    monkeypatch.setitem(sys.modules, module, None)
    package = {"odf": "odfpy"}.get(module, module)
    with pytest.raises(RecordError, match=rf"pip install {package}, or pip install 'pyjoystick\[{extra}\]'"):
        read_log(path)


def test_a_damaged_matlab_file_that_crashes_its_reader_is_refused(tmp_path: Path) -> None:
    """One bit says that the numbers are complex: scipy reads beyond them."""
    path = _matlab(tmp_path / "log.mat", "5", {"time_s": TIME, "theta_deg": ANGLE})
    data = bytearray(path.read_bytes())
    data[145] ^= 0x08
    path.write_bytes(data)
    with pytest.raises(RecordError, match=r"log\.mat: cannot be read as matlab: it is damaged"):
        read_log(path)
