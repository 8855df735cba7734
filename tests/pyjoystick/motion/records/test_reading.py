from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.motion import RecordError, read_record, read_repeats
from tests.pyjoystick.motion.records.made import motion, rows, write


def _refusal(path: Path, **options: object) -> RecordError:
    with pytest.raises(RecordError) as caught:
        read_record(path, **options)  # type: ignore[arg-type]
    assert caught.value.source == str(path)
    assert str(path) in str(caught.value)
    assert caught.value.advice
    return caught.value


def test_degrees_and_radians_give_the_same_record(tmp_path: Path) -> None:
    time, theta, omega = motion()
    degrees = read_record(
        write(tmp_path / "a.csv", rows(time, theta, np.degrees(omega)), "time (s),theta (deg),omega (deg/s)")
    )
    radians = read_record(
        write(tmp_path / "b.csv", rows(time, np.radians(theta), omega), "time (s),theta (rad),omega (rad/s)")
    )
    assert degrees.name == "a"
    assert degrees.source == str(tmp_path / "a.csv")
    assert degrees.theta == pytest.approx(radians.theta, abs=1e-15)
    assert degrees.theta[0] == pytest.approx(math.radians(-20.0))
    assert degrees.omega is not None
    assert degrees.omega == pytest.approx(radians.omega, abs=1e-13)
    assert degrees.notes == radians.notes == ()
    assert degrees.interval == pytest.approx(1.0 / 60.0)


def test_comments_other_columns_and_other_separators(tmp_path: Path) -> None:
    time, theta, _ = motion()
    lines = ["# made for a test", "", "frame;time (ms);theta [deg];marker"]
    lines += [f"{i};{1e3 * t};{a};x" for i, (t, a) in enumerate(zip(time, theta, strict=True))]
    lines.insert(10, "# a remark between rows")
    path = tmp_path / "semicolons.csv"
    path.write_text("\r\n".join(lines), encoding="utf-8-sig")
    record = read_record(path)
    assert record.time == pytest.approx(time)
    assert record.rows[:2].tolist() == [4, 5]
    assert record.rows[7] == 12


def test_plain_names_with_units_given(tmp_path: Path) -> None:
    time, theta, _ = motion()
    path = write(tmp_path / "plain.csv", rows(time, theta), "clock,Angle X")
    columns, units = {"time": "clock", "theta": "angle x"}, {"time": "s", "theta": "deg"}
    assert read_record(path, columns=columns, units=units).theta == pytest.approx(np.radians(theta))
    assert "row 1: has no column 'time'; which column holds time? There are 'clock'" in str(_refusal(path))
    assert _refusal(path, columns=columns).column == "clock"
    assert "known are s, ms" in _refusal(path, columns=columns, units={"time": "a"}).advice
    with pytest.raises(RecordError, match="'angle' is not a known quantity; known are time, theta, omega"):
        read_record(path, columns={"angle": "Angle X"})


def test_a_unit_that_contradicts_the_heading_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.csv", rows(*motion()[:2]))
    assert "has the unit deg in its heading, but rad is given" in str(_refusal(path, units={"theta": "rad"}))


def test_two_columns_of_one_name_are_told_apart_by_their_units(tmp_path: Path) -> None:
    time, theta, _ = motion()
    table = rows(time, theta, np.radians(theta))
    path = write(tmp_path / "both.csv", table, "time (s),theta (deg),theta (rad)")
    assert "has 2 columns 'theta'" in str(_refusal(path))
    assert read_record(path, columns={"theta": "theta (rad)"}).theta[0] == np.radians(-20.0)


def test_files_that_are_no_table_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "file.csv"
    assert "cannot be read" in str(_refusal(path))
    for content, reason in (
        (b"", "has no headings"),
        (b"time (s),theta (deg)\n", "has no rows"),
        (b"\xff\xfe\x00binary", "not UTF-8 text"),
        (b"0.0,1.0\n0.1,2.0\n", "a number where a heading is expected"),
        (b"time (s),time (s)\n0,1\n", "two columns have one heading"),
        (b"time (s),theta (deg)\n0,1\n1,2\n", "has 2 samples"),
    ):
        path.write_bytes(content)
        assert reason in _refusal(path).reason


def test_a_line_that_was_cut_off_is_named(tmp_path: Path) -> None:
    path = write(tmp_path / "cut.csv", [[0.0, 1.0], [0.1], [0.2, 1.0]])
    error = _refusal(path)
    assert error.rows == (3,)
    assert "has 1 cell under 2 headings" in str(error)


def test_a_decimal_comma_is_read(tmp_path: Path) -> None:
    time, theta, _ = motion()
    lines = [f"{t:.9f};{a:.9f}".replace(".", ",") for t, a in zip(time, theta, strict=True)]
    path = tmp_path / "comma.csv"
    path.write_text("\n".join(["time (s);theta (deg)", *lines, ""]), encoding="utf-8")
    assert read_record(path).theta == pytest.approx(np.radians(theta), abs=1e-9)


@pytest.mark.parametrize("cell", ["", "nan", "N/A", "inf"])
def test_missing_numbers_are_refused_with_their_rows(tmp_path: Path, cell: str) -> None:
    table = rows(*motion()[:2])
    for k in (10, 11, 12, 40):
        table[k][1] = cell
    error = _refusal(write(tmp_path / "nan.csv", table))
    assert error.rows == (12, 13, 14, 42)
    assert error.column == "theta (deg)"
    assert f"rows 12-14, 42: samples without a finite number (found {cell or 'nothing'})" in str(error)


def test_empty_cells_below_the_table_are_no_samples(tmp_path: Path) -> None:
    table = rows(*motion()[:2])
    plain = read_record(write(tmp_path / "plain.csv", table))
    padded = read_record(write(tmp_path / "padded.csv", [*table, ["", ""], ["", ""]]))
    assert padded.theta.tolist() == plain.theta.tolist()
    table[40] = ["", ""]
    assert _refusal(write(tmp_path / "inside.csv", table)).rows == (42,)


def test_repeated_times_are_refused(tmp_path: Path) -> None:
    table = rows(*motion()[:2])
    table[20][0] = table[19][0]
    error = _refusal(write(tmp_path / "repeated.csv", table))
    assert (error.rows, error.value) == ((22,), table[19][0])
    assert "repeated" in error.reason


def test_unsorted_times_are_refused(tmp_path: Path) -> None:
    table = rows(*motion()[:2])
    table[30], table[31] = table[31], table[30]
    error = _refusal(write(tmp_path / "unsorted.csv", table))
    assert error.rows == (33,)
    assert "runs backward" in error.reason


def test_degrees_under_the_name_of_radians_are_refused(tmp_path: Path) -> None:
    error = _refusal(write(tmp_path / "degrees.csv", rows(*motion()[:2]), "time (s),theta (rad)"))
    assert error.rows[0] == 2
    assert error.value == "-20 rad"
    assert "Name the column theta (deg)" in error.advice


def test_radians_under_the_name_of_degrees_are_flagged(tmp_path: Path) -> None:
    time, theta, _ = motion()
    record = read_record(write(tmp_path / "radians.csv", rows(time, np.radians(theta))))
    assert record.notes == ("the largest angle is 0.349 degrees: are these radians labeled as degrees?",)


def test_a_motion_of_another_kind_is_read_without_the_check(tmp_path: Path) -> None:
    path = write(tmp_path / "ramp.csv", [[0.1 * k, k] for k in range(20)])
    assert "no free oscillation" in str(_refusal(path))
    assert len(read_record(path, free_oscillation=False)) == 20


def test_repeats_are_read_together(tmp_path: Path) -> None:
    time, theta, _ = motion()
    paths = [write(tmp_path / f"r{k}.csv", rows(time, theta * (1.0 + 0.01 * k))) for k in range(4)]
    assert [record.name for record in read_repeats(paths)] == ["r0", "r1", "r2", "r3"]
    with pytest.raises(RecordError, match="no file is given"):
        read_repeats([])


def test_one_path_is_no_list_of_paths() -> None:
    with pytest.raises(RecordError, match=r"run.csv: is a single path; give a list of files"):
        read_repeats("run.csv")


def test_a_repeat_given_twice_is_refused(tmp_path: Path) -> None:
    paths = [write(tmp_path / name, rows(*motion()[:2])) for name in ("a.csv", "b.csv")]
    with pytest.raises(RecordError, match=r"b\.csv.*holds the same angles as .*a\.csv"):
        read_repeats(paths)


def test_the_side_is_that_of_the_release_where_zero_is_off(tmp_path: Path) -> None:
    """Half the motion, with zero off by 2 degrees: from -8 degrees, then farther to the other side."""
    time, theta, _ = motion()
    first = write(tmp_path / "a.csv", rows(time, theta))
    second = write(tmp_path / "b.csv", rows(time, 0.5 * theta + 2.0))
    record = read_repeats([first, second])[1]
    assert record.theta[np.argmax(np.abs(record.theta))] > 0.0


def test_a_repeat_with_the_other_sign_is_refused(tmp_path: Path) -> None:
    time, theta, _ = motion()
    paths = [write(tmp_path / f"{sign}.csv", rows(time, sign * theta)) for sign in (1, -1)]
    with pytest.raises(RecordError, match="wrong sign") as caught:
        read_repeats(paths)
    assert caught.value.source == str(paths[1])
    assert caught.value.value == "+20.00 degrees"
