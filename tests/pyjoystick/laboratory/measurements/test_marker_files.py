from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import read_markers
from pyjoystick.motion import RecordError
from tests.pyjoystick.laboratory.measurements.c3d_writer import write_c3d
from tests.pyjoystick.laboratory.measurements.made import NAMES, nexus_text, plain_text, scattered, write

POINTS = scattered()
TIME = np.arange(40) / 60.0


def test_all_kinds_of_files_hold_the_same(tmp_path: Path) -> None:
    write_c3d(tmp_path / "a.c3d", NAMES, POINTS, rate=60.0)
    files = [
        tmp_path / "a.c3d",
        write(tmp_path / "nexus.csv", nexus_text(POINTS)),
        write(tmp_path / "mm.csv", plain_text(TIME, POINTS)),
        write(tmp_path / "m.csv", plain_text(TIME, POINTS / 1e3, unit="m")),
    ]
    for file in files:
        markers = read_markers(file)
        np.testing.assert_allclose(markers.positions, POINTS * 1e-3, rtol=1e-11)
        np.testing.assert_allclose(markers.time, TIME, atol=1e-9)
        assert [markers.index(name) for name in NAMES] == [0, 1, 2]
        assert np.flatnonzero(markers.missing("BASE1")).tolist() == [10, 11, 12, 13]


def test_nexus_rows_are_line_numbers_and_the_subject_may_be_left_out(tmp_path: Path) -> None:
    markers = read_markers(write(tmp_path / "a.csv", nexus_text(POINTS)))
    assert markers.rows[:2].tolist() == [11, 12]
    assert markers.names == ("Joystick:TOP", "Joystick:BASE1", "Joystick:BASE2")
    np.testing.assert_array_equal(markers.of("top"), markers.of("Joystick:TOP"))


def test_nexus_with_semicolons_and_with_a_section_after_it(tmp_path: Path) -> None:
    text = nexus_text(POINTS).replace(",", ";") + "\nModel Outputs\n60\n"
    markers = read_markers(write(tmp_path / "a.csv", text))
    np.testing.assert_allclose(markers.positions, POINTS * 1e-3, rtol=1e-11)


def test_nexus_frames_that_are_left_out_are_gaps(tmp_path: Path) -> None:
    lines = nexus_text(POINTS).splitlines()
    markers = read_markers(write(tmp_path / "a.csv", "\n".join(lines[:20] + lines[25:])))
    np.testing.assert_allclose(np.diff(markers.time).max(), 6.0 / 60.0)


@pytest.mark.parametrize("line", ["", "," * 10, " , , "])
def test_nexus_frames_after_rows_of_empty_cells_are_read(line: str, tmp_path: Path) -> None:
    lines = nexus_text(POINTS).splitlines()
    text = "\n".join([*lines[:20], *[line] * 5, *lines[25:], "", "Model Outputs", "60", "1,0,5"])
    markers = read_markers(write(tmp_path / "a.csv", text))
    np.testing.assert_allclose(markers.time, np.delete(TIME, np.arange(10, 15)), atol=1e-9)
    assert markers.rows.tolist() == [*range(11, 21), *range(26, 51)]
    np.testing.assert_allclose(markers.positions, np.delete(POINTS, np.arange(10, 15), axis=0) * 1e-3)


def _changed(text: str, line: int, old: str, new: str) -> str:
    lines = text.splitlines()
    assert old in lines[line - 1]
    lines[line - 1] = lines[line - 1].replace(old, new, 1)
    return "\n".join(lines)


NEXUS = nexus_text(np.full((20, 3, 3), 1.5))
PLAIN = plain_text(np.arange(20) / 60.0, np.full((20, 3, 3), 1.5))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            _changed(NEXUS, 15, "1.5", "1.5x"),
            r"a\.csv, column 'Joystick:TOP X', row 15: is not a number .*'1.5x'",
        ),
        (NEXUS.replace("\n13,", "\n\n13,") + "22", "row 32: has 1 cells"),
        (NEXUS.replace(",", ";").replace(".", ","), r"'Joystick:TOP X', row 11: is not a number.*not commas"),
        (NEXUS.replace("1.5", "1,5"), r"row 11: has 20 cells, its head has 11.*decimal marks commas"),
        (_changed(NEXUS, 15, "1.5,1.5,1.5,1.5,1.5", "1.5"), r"row 15: has 7 cells, its head has 11"),
        (
            _changed(NEXUS, 14, "4,0", "9,0"),
            r"column 'Frame', row 15: the frame does not come after.*found 5",
        ),
        (
            _changed(NEXUS, 10, ",mm,mm", ",mm,inch"),
            r"'Joystick:TOP Y': has an unknown unit \(found 'inch'\)",
        ),
        (_changed(NEXUS, 15, "5,0", "inf,0"), r"column 'Frame', row 15: the frame does not .*found inf"),
        (_changed(NEXUS, 11, "1,0", "-inf,0"), r"column 'Frame', row 11: the frame does not .*found -inf"),
        (_changed(NEXUS, 7, "60", "fast"), r"row 7: has no rate \(found 'fast'\)"),
        (NEXUS[:-3], "the file seems to end within its last number"),
        (_changed(NEXUS, 7, "60", "119,88"), r"row 7: has no rate \(found '119,88'\)"),
        (_changed(NEXUS, 7, "60", "1e-320"), r"row 7: has no rate \(found '1e-320'\).* from 1 to 1e\+07"),
        (_changed(NEXUS, 9, "Frame,Sub Frame,X", "Frame,Sub Frame,A"), "has no marker 'TOP'"),
        (_changed(NEXUS, 9, "Frame", "Bild"), r"row 9: has no columns Frame and X, Y, Z"),
        ("\n".join(NEXUS.splitlines()[:9]), r"row 6: has no frames"),
        (_changed(PLAIN, 7, "1.5", "x"), r"column 'TOP x \(mm\)', row 7: is not a number .found 'x'"),
        (PLAIN.replace(",", ";").replace(".", ","), r"'time \(s\)', row 3.*decimal point"),
        (PLAIN.replace(",", " "), r"row 1: has no column 'time'; separate the columns by commas"),
        (PLAIN.replace("(mm)", "(ft)"), r"'TOP x \(ft\)': has an unknown unit .*known are m, cm, mm"),
        (PLAIN.replace(" (mm)", ""), r"'TOP x': has no unit.*as an option"),
        (
            PLAIN.replace("time (s)", "time"),
            r"'time', row 1: has no unit; write .* as in 'time \(s\)'",
        ),
        (PLAIN.replace("time (s)", "clock (s)"), r"has no column 'time'"),
        (PLAIN.replace("TOP z (mm)", "TOP w (mm)"), r"lacks z of marker 'TOP'"),
        (PLAIN.replace("TOP z (mm)", "TOP X (m)"), r"has x of marker 'TOP' twice, in 'TOP x \(mm\)' and in"),
        (_changed(PLAIN, 6, "0.0666666667", "0.01"), r"column 'time', row 6: the time does not increase"),
        (
            _changed(PLAIN, 6, "0.0666666667", ""),
            r"'time \(s\)', row 6: samples without .* the time of every frame",
        ),
    ],
)
def test_bad_text_files_say_where_and_what_to_do(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(RecordError, match=words) as caught:
        read_markers(write(tmp_path / "a.csv", text)).index("TOP")
    assert "a.csv" in str(caught.value)
    assert caught.value.advice


def test_a_missing_marker_names_the_near_ones_or_all(tmp_path: Path) -> None:
    markers = read_markers(write(tmp_path / "a.csv", PLAIN))
    with pytest.raises(RecordError, match=r"has no marker 'BASE3'; did you mean BASE\d or BASE\d"):
        markers.index("BASE3")
    with pytest.raises(RecordError, match="has no marker 'elbow'; there are TOP, BASE1, BASE2"):
        markers.index("elbow")


def test_a_marker_of_two_subjects_must_be_named_with_one(tmp_path: Path) -> None:
    text = NEXUS.replace("Joystick:BASE1", "Cab:TOP")
    markers = read_markers(write(tmp_path / "a.csv", text))
    with pytest.raises(RecordError, match="has 2 markers 'TOP'; write one with its subject"):
        markers.index("TOP")
    assert markers.index("Cab:TOP") == 1


def test_a_binary_file_without_its_suffix_is_refused(tmp_path: Path) -> None:
    write_c3d(tmp_path / "a.dat", NAMES, POINTS, rate=60.0)
    with pytest.raises(RecordError, match=r"is not UTF-8 text; name a C3D file \.c3d"):
        read_markers(tmp_path / "a.dat")


def test_an_export_of_motive_is_named_with_the_way_out(tmp_path: Path) -> None:
    """Its first line would pass for a table that lacks headings."""
    path = tmp_path / "take.csv"
    path.write_text("Format Version,1.23,Take Name,Take 1\n\n,Type,Marker\n", encoding="utf-8")
    with pytest.raises(RecordError, match=r"OptiTrack Motive, which is not read; export the take as C3D"):
        read_markers(path)
