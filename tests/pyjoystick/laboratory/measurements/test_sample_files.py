"""Long series of samples read in pieces: times, units, rows and the borders between pieces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory.measurements.sample_files import Piece, open_samples
from pyjoystick.motion import UNITS, Column, RecordError
from tests.pyjoystick.laboratory.measurements.made import write

VOLTS = Column("signal", UNITS["voltage"])
ROWS = [f"{10 * i},{i % 4}.5" for i in range(10)]


def _text(rows: list[str], heading: str = "time (ms),signal (mV)") -> str:
    return "\n".join(["# made", heading, *rows, ""])


def _pieces(path: Path, size: int = 4, rate: float | None = None) -> list[Piece]:
    return list(open_samples(path, VOLTS, rate=rate).pieces(size))


def test_pieces_follow_each_other(tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text(ROWS))
    opened = open_samples(path, VOLTS)
    assert (opened.column, opened.unit, opened.rate) == ("signal (mV)", "mV", None)
    pieces = _pieces(path)
    assert [(piece.first, len(piece.time), len(piece.values)) for piece in pieces] == [
        (3, 4, 4),
        (7, 4, 4),
        (11, 2, 2),
    ]
    np.testing.assert_allclose(np.concatenate([piece.time for piece in pieces]), np.arange(10) / 100.0)
    np.testing.assert_array_equal(
        np.concatenate([piece.values for piece in pieces]), [i % 4 + 0.5 for i in range(10)]
    )


@pytest.mark.parametrize("count", range(1, 10))
def test_empty_lines_after_the_last_sample_are_no_samples(tmp_path: Path, count: int) -> None:
    path = write(tmp_path / "a.csv", _text(ROWS) + "\n" + count * "\n")
    assert sum(len(piece.values) for piece in _pieces(path)) == len(ROWS)
    within = ROWS[:3] + count * [","] + ROWS[3:]
    with pytest.raises(RecordError, match=r"rows? 6.*samples without a finite number"):
        _pieces(write(tmp_path / "b.csv", _text(within)))


@pytest.mark.parametrize("heading", ["Sample", "Nr.", "Sequence", "timestamp", "i"])
@pytest.mark.parametrize("size", [20, 100])
def test_numbers_of_samples_that_skip_some_are_refused(heading: str, size: int, tmp_path: Path) -> None:
    """As a time that skips would be: an accelerometer's series has no gaps."""

    def rows(numbers: list[int]) -> str:
        return _text([f"{n},{i % 4}.5" for i, n in enumerate(numbers)], f"{heading},signal (V)")

    for even in (
        list(range(12)),
        list(range(5, 29, 2)),
        [3] * 12,
        [*range(244, 256), *range(6)],
        [*range(65530, 65536), *range(1, 20)],
        [*range(960, 1000), *range(30)],
        [*range(65000, 65536, 8), *range(0, 400, 8)],
        [3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8],
    ):
        path = write(tmp_path / "even.csv", rows(even))
        assert sum(len(piece.time) for piece in _pieces(path, size, rate=50.0)) == len(even)
    for number in (50, 39, 0):
        text = rows([*range(40), *range(number, number + 30)])
        path = write(tmp_path / "skips.csv", text.replace("\n7,", "\n,"))
        what = rf"row 43: the samples do not go on in even steps .*found {number}"
        with pytest.raises(RecordError, match=what):
            _pieces(path, size, rate=50.0)


@pytest.mark.parametrize(
    ("heading", "form"),
    [
        ("Sample,signal (V)", "{0},5,{1}000"),
        ("Sample,signal (V),note", "{0},5,{1}000,"),
        ("signal (V)", "5,{1}000"),
    ],
)
def test_decimal_commas_between_commas_are_refused(heading: str, form: str, tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text([form.format(i, i % 7) for i in range(20)], heading))
    with pytest.raises(RecordError, match=r"row 3: has \d cells under \d headings?; was the file"):
        open_samples(path, VOLTS, rate=50.0)


@pytest.mark.parametrize("rate", [1000.0, 1200.0, 1600.0, 970.0, 800.0, 300.0, 44100.0])
@pytest.mark.parametrize("heading", ["Sample time (ms)", "t_sample [ms]", "Elapsed (ms)", "Point (ms)"])
def test_rounded_times_beside_a_rate(heading: str, rate: float, tmp_path: Path) -> None:
    """Only a gap of more than what rounding makes is one."""
    times = np.round(np.arange(300) / rate * 1e3)

    def text(times: np.ndarray) -> str:
        return _text([f"{t:.0f},{i % 4}.5" for i, t in enumerate(times)], f"{heading},signal (V)")

    path = write(tmp_path / "a.csv", text(times))
    assert sum(len(piece.time) for piece in _pieces(path, 100, rate=rate)) == 300
    if rate < 10_000.0:
        path = write(tmp_path / "b.csv", text(times + np.where(np.arange(300) >= 200, round(5e3 / rate), 0)))
        with pytest.raises(RecordError, match="row 203: the samples do not go on in even steps"):
            _pieces(path, 150, rate=rate)


@pytest.mark.parametrize(
    ("heading", "step"), [("Elapsed (ms)", 2), ("timestamp (s)", 0.002), ("t_x [ms]", 0.5)]
)
def test_times_of_another_rate_are_refused(heading: str, step: float, tmp_path: Path) -> None:
    rows = [f"{step * i:.6g},{i % 4}.5" for i in range(100)]
    path = write(tmp_path / "a.csv", _text(rows, f"{heading},signal (V)"))
    with pytest.raises(RecordError, match=r"its times are those of (500|2000) Hz, the given rate is 1000 Hz"):
        _pieces(path, 50, rate=1000.0)


def test_a_column_without_a_heading_is_ignored(tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text([f"{i}.5,{i % 7}," for i in range(20)], "time (s),signal (V),"))
    assert sum(len(piece.time) for piece in _pieces(path)) == 20


def test_words_in_a_column_of_samples_are_no_numbers(tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text([f"a{i},{i % 4}.5" for i in range(9)], "Sample,signal (V)"))
    assert sum(len(piece.time) for piece in _pieces(path, rate=50.0)) == 9


@pytest.mark.parametrize(("end", "is_cut"), [("90,3", True), ("90,3.5", False), ("90,3\n", False)])
def test_a_file_that_ends_within_a_number(end: str, is_cut: bool, tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text(ROWS[:9]) + end)
    if not is_cut:
        assert sum(len(piece.time) for piece in _pieces(path)) == 10
        return
    with pytest.raises(
        RecordError, match=r"column 'signal .mV.': the file seems to end within its last number"
    ):
        open_samples(path, VOLTS)


def test_a_file_without_times_begins_at_zero(tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", _text([row.split(",")[1] for row in ROWS], "signal (V)"))
    pieces = _pieces(path, rate=50.0)
    np.testing.assert_allclose(np.concatenate([piece.time for piece in pieces]), np.arange(10) / 50.0)
    assert pieces[1].first == 7
    for rate in (0.0, -1.0, np.inf, np.nan):
        with pytest.raises(RecordError, match="the rate must be above 0 Hz"):
            open_samples(path, VOLTS, rate=rate)


@pytest.mark.parametrize("version", [(1, 0), (2, 0)])
@pytest.mark.parametrize("kind", ["<i2", ">f4", "<f8"])
def test_arrays_of_any_numbers(tmp_path: Path, version: tuple[int, int], kind: str) -> None:
    path = tmp_path / "a.npy"
    with path.open("wb") as file:
        np.lib.format.write_array(file, np.arange(10).astype(kind), version=version)
    opened = open_samples(path, VOLTS, unit="V", rate=100.0)
    assert (opened.column, opened.unit) == ("a.npy", "V")
    pieces = list(opened.pieces(4))
    assert [piece.first for piece in pieces] == [0, 4, 8]
    np.testing.assert_array_equal(np.concatenate([piece.values for piece in pieces]), np.arange(10))
    np.testing.assert_allclose(np.concatenate([piece.time for piece in pieces]), np.arange(10) / 100.0)


@pytest.mark.parametrize("place", range(10))
@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("{time},x", "column 'signal (mV)', row {row}: is not a number (found 'x')"),
        (f"{{time}},{'9' * 400}", "column 'signal (mV)', row {row}: samples without a finite number"),
        ("{time},", "column 'signal (mV)', row {row}: samples without a finite number"),
        (",1.5", "column 'signal (mV)', row {row}: samples without a finite number"),
        ("x,1.5", "column 'time (ms)', row {row}: is not a number (found 'x')"),
    ],
)
def test_bad_cells_are_named_in_whichever_piece(tmp_path: Path, place: int, row: str, message: str) -> None:
    rows = ROWS.copy()
    rows[place] = row.format(time=10 * place)
    with pytest.raises(RecordError) as refused:
        _pieces(write(tmp_path / "a.csv", _text(rows)))
    assert message.format(row=place + 3) in str(refused.value)


@pytest.mark.parametrize("place", range(1, 10))
@pytest.mark.parametrize("step", [0, -5])
def test_times_that_do_not_increase_are_named_across_pieces(tmp_path: Path, place: int, step: int) -> None:
    rows = ROWS.copy()
    rows[place] = f"{10 * (place - 1) + step},1.5"
    with pytest.raises(RecordError, match=f"row {place + 3}: the time does not increase"):
        _pieces(write(tmp_path / "a.csv", _text(rows)))


def test_a_quotation_mark_does_not_swallow_samples(tmp_path: Path) -> None:
    rows = [f"{i % 7}.5,{note}" for i, note in enumerate(["", '"start', "", "", 'stop"', '"whole"', ""])]
    path = write(tmp_path / "a.csv", _text(rows, "signal (V),note"))
    with pytest.raises(RecordError, match=r"row 4: has a quotation mark that is not closed"):
        open_samples(path, VOLTS, rate=50.0)
    path = write(
        tmp_path / "a.csv", _text([row.replace('"start', "start") for row in rows[:4]], "signal (V),note")
    )
    assert sum(len(piece.values) for piece in open_samples(path, VOLTS, rate=50.0).pieces()) == 4


def test_marks_that_open_and_close_in_one_row_may_swallow_others(tmp_path: Path) -> None:
    rows = ["0.5,", '1.5,"start" of "it', "2.5,", '3.5,""', '4.5,"a" and "b']
    path = write(tmp_path / "a.csv", _text(rows, "signal (V),note"))
    with pytest.raises(RecordError, match=r"row 4: has a quotation mark that is not closed"):
        open_samples(path, VOLTS, rate=50.0)
