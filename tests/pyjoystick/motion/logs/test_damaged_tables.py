"""Tables in which cells or numbers are not what they seem: refused, or left out with a note."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.motion import Layout, RecordError, read_log, read_record, read_table_file
from tests.pyjoystick.motion.logs.made import ANGLE, COUNT, TIME, TORQUE, text, written

DEG = np.radians(1.0)
HEADINGS = ("time (s)", "angle (deg)", "torque (N.m)", "note")


def _lines(form: str) -> str:
    rows = zip(TIME.tolist(), ANGLE.tolist(), TORQUE.tolist(), strict=True)
    return "".join(form.format(*row) for row in rows)


@pytest.mark.parametrize(
    "content",
    [
        # A separator of thousands beside decimal commas: in all numbers of a column, in the larger ones.
        "Zeit (s);Winkel (deg);Drehmoment (mN.m)\n"
        + "0,00;-17,9;1.500\n0,01;-17,5;1.527\n0,02;-17,1;1.553\n",
        "Zeit (s);Winkel (deg);Drehmoment (N.mm)\n" + "0,00;-17,9;998\n0,01;-17,5;999\n0,02;-17,1;1.001\n",
        "Zeit (s);Winkel (mdeg);U (V)\n" + "0,00;-17.910;0,2\n0,01;-17.500;0,2\n0,02;-17.100;0,2\n",
        "Zeit (ms);Winkel (deg);U (V)\n" + "1.000;15,0;5,0\n1.020;14,9;5,0\n1.040;14,8;5,0\n",
    ],
)
@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_points_beside_decimal_commas_are_refused(content: str, delimiter: str, tmp_path: Path) -> None:
    file = written(tmp_path / "log.txt", content.replace(";", delimiter))
    with pytest.raises(
        RecordError, match=r"row [24]: has a point, but the decimal mark of the table is the co"
    ):
        read_log(file)


def test_a_point_in_a_column_that_is_not_read_does_no_harm(tmp_path: Path) -> None:
    rows = _lines("{:.3f};{:.4f};{:.4f};V").replace(".", ",").replace("V", "2.1\n")
    log = read_log(written(tmp_path / "log.csv", f"Zeit (s);Winkel (deg);Drehmoment (N.m);Version\n{rows}"))
    np.testing.assert_allclose(log.series["T"], np.round(TORQUE, 4), atol=1e-9)


@pytest.mark.parametrize("digits", [3, 4, 6, 8])
def test_a_file_that_ends_within_a_number(digits: int, tmp_path: Path) -> None:
    whole = "time (s),angle (deg)\n" + "".join(f"{t:.4f},{a:.4f}\n" for t, a in zip(TIME, ANGLE, strict=True))
    number = f"{ANGLE[-1]:.4f}"
    content = whole.removesuffix(f"{number}\n") + number[:digits]
    is_cut = digits < len(number)
    log = read_log(written(tmp_path / "log.csv", content))
    assert log.left_out.tolist() == [121] * is_cut
    assert len(read_log(written(tmp_path / "ended.csv", content + "\n")).series["time"]) == COUNT
    if is_cut:
        with pytest.raises(
            RecordError, match=r"'angle \(deg\)': the file seems to end within its last number"
        ):
            read_table_file(tmp_path / "log.csv")


def test_a_file_that_ends_within_an_exponent(tmp_path: Path) -> None:
    content = "time (s),angle (deg)\n" + "".join(
        f"{t:.4e},{a:.4e}\n" for t, a in zip(TIME, ANGLE, strict=True)
    )
    assert read_log(written(tmp_path / "log.csv", content[:-2])).left_out.tolist() == [121]


def test_numbers_of_any_length_in_the_last_row_are_kept(tmp_path: Path) -> None:
    content = "time (s),angle (deg)\n" + "\n".join(
        f"{t!r},{a!r}" for t, a in zip(TIME.tolist(), np.round(ANGLE, 1).tolist(), strict=True)
    )
    assert len(read_log(written(tmp_path / "log.csv", content)).series["time"]) == COUNT


@pytest.mark.parametrize("date", ["2026-13-01", "2026-02-30", "2026-00-10", "2026-31-01"])
def test_a_date_that_does_not_exist(date: str, tmp_path: Path) -> None:
    rows = [f"2026-01-10 10:00:{t:06.3f},{a:.4f}" for t, a in zip(TIME, ANGLE, strict=True)]
    damaged = [*rows[:50], rows[50].replace("2026-01-10", date), *rows[51:]]
    for some in (damaged, [row.replace("2026-01-10", date) for row in rows]):
        file = written(tmp_path / "log.csv", "\n".join(("time,angle (deg)", *some, "")))
        with pytest.raises(RecordError, match=r"column 'time', row (2: is not a number|52: has other cells)"):
            read_log(file)


@pytest.mark.parametrize("mark", ["#", "//", "% "])
def test_samples_that_are_commented_out_take_their_time(mark: str, tmp_path: Path) -> None:
    lines = ["angle (deg),torque (N.m)", *_lines("{1:.4f},{2:.4f}\n").splitlines()]
    for row in (42, 43, 44):
        lines[row - 1] = mark + lines[row - 1]
    lines[60] = mark + " the hand slipped"
    log = read_log(written(tmp_path / "log.csv", "\n".join([*lines, ""])), rate=250.0)
    assert log.left_out.tolist() == [42, 43, 44]
    kept = np.delete(np.arange(COUNT), [40, 41, 42, 59])
    np.testing.assert_allclose(log.series["theta"], DEG * np.round(ANGLE, 4)[kept], atol=1e-9)
    expected = TIME[kept] - np.where(kept > 59, 1 / 250.0, 0.0)
    np.testing.assert_allclose(log.series["time"], expected, atol=1e-9)


@pytest.mark.parametrize("last", ["OK", ""])
def test_decimal_commas_between_commas_shift_the_cells(last: str, tmp_path: Path) -> None:
    """Every row has cells beyond the headings; the last one is empty or a word."""
    rows = zip((1e3 * TIME).tolist(), ANGLE.tolist(), TORQUE.tolist(), strict=True)
    lines = (f"{t:.0f},{a:.4f},{m:.0f},{last}".replace(".", ",") for t, a, m in rows)
    content = "\n".join(("time (ms),angle (deg),U,note", *lines, ""))
    with pytest.raises(RecordError, match=r"row 2: has 5 cells under 4 headings"):
        read_log(written(tmp_path / "log.csv", content))


def test_a_torque_with_decimal_commas_beside_points(tmp_path: Path) -> None:
    rows = zip(TIME.tolist(), ANGLE.tolist(), TORQUE.tolist(), strict=True)
    lines = (f"{t:.3f},{a:.4f},{m:.4f},".rsplit(".", 1) for t, a, m in rows)
    content = ",".join(HEADINGS) + "\n" + "".join(f"{one},{other}\n" for one, other in lines)
    log = read_log(written(tmp_path / "log.csv", content))
    assert any("every row ends with an empty cell beyond the headings" in note for note in log.notes)


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_an_inserted_cell_shifts_a_row(delimiter: str, tmp_path: Path) -> None:
    lines = [",".join(HEADINGS), *_lines("{:.3f},{:.4f},{:.4f},\n").splitlines()]
    lines[39] = lines[39].replace(",", ",0,", 1)
    content = "\n".join([*lines, ""]).replace(",", delimiter)
    with pytest.raises(RecordError, match="row 40: has 5 cells under 4 headings"):
        read_log(written(tmp_path / "log.csv", content))


def test_numbers_of_rows_before_a_column_of_words(tmp_path: Path) -> None:
    """As R writes them: the headings are a cell to the left of their columns."""
    rows = zip(range(1, COUNT + 1), TIME.tolist(), ANGLE.tolist(), strict=True)
    content = '"time (s)","angle (deg)","state"\n' + "".join(f'"{i}",{t},{a},"free"\n' for i, t, a in rows)
    with pytest.raises(RecordError, match="row 2: has 4 cells under 3 headings"):
        read_log(written(tmp_path / "log.csv", content))


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_an_empty_cell_at_the_end_of_every_row(delimiter: str, tmp_path: Path) -> None:
    content = text(HEADINGS[:3], TIME, ANGLE, TORQUE, delimiter=delimiter, digits=12)
    first, _, rest = content.partition("\n")
    log = read_log(written(tmp_path / "log.csv", first + "\n" + rest.replace("\n", delimiter + "\n")))
    np.testing.assert_allclose(log.series["T"], TORQUE, atol=1e-9)


@pytest.mark.parametrize("headings", ["Sample,time (ms),angle (deg)", "time (ms),trigger,angle (deg)"])
def test_whole_numbers_before_a_comma_at_the_end_of_every_row(headings: str, tmp_path: Path) -> None:
    """As microcontrollers print them: these are no decimal commas."""
    rows = zip(range(COUNT), (1e3 * TIME).tolist(), ANGLE.tolist(), strict=True)
    lines = (
        f"{i},{t:.0f},{a:.4f}," if headings[0] == "S" else f"{t:.0f},{i % 2},{a:.4f}," for i, t, a in rows
    )
    log = read_log(written(tmp_path / "log.csv", "\n".join((headings, *lines, ""))))
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, atol=1e-6)
    assert any("every row ends with an empty cell beyond the headings" in note for note in log.notes)


@pytest.mark.parametrize(
    "rows",
    [
        ["0,-17,0101,", "10,-17,4203,", "20,-16,9,"],
        ["0,-1,79101e+01,", "10,-1,74203e+01,", "20,-1,69e+01,"],
    ],
)
def test_decimal_commas_may_be_what_they_are(rows: list[str], tmp_path: Path) -> None:
    """Where a point is given as the decimal mark, whole numbers are believed."""
    file = written(tmp_path / "log.csv", "\n".join(("time (ms),angle (deg),note", *rows, "")))
    with pytest.raises(RecordError, match="row 2: has 4 cells under 3 headings"):
        read_log(file)
    assert len(read_log(file, layout=Layout(decimal=".")).series["theta"]) == 3


@pytest.mark.parametrize("word", ["26.11.2026", "run1.csv", "1.0.2"])
def test_points_in_words_are_no_decimal_marks(word: str, tmp_path: Path) -> None:
    rows = [f"{word},{10 * i},-17,{9101 - i}," for i in range(20)]
    file = written(tmp_path / "log.csv", "\n".join(("Datum,Zeit (ms),Winkel (deg),Bemerkung", *rows, "")))
    with pytest.raises(RecordError, match="row 2: has 5 cells under 4 headings"):
        read_log(file)


@pytest.mark.parametrize(
    "comment", ["# -2.34,-0.37,outlier", "# outlier: -2.34,-0.37", "#NaN,-0.37", "#,-0.37", "# pause"]
)
def test_other_comments_between_samples_take_no_time(comment: str, tmp_path: Path) -> None:
    lines = ["angle (deg),torque (N.m)", *_lines("{1:.4f},{2:.4f}\n").splitlines()]
    file = written(tmp_path / "log.csv", "\n".join(("# bench 3", *lines[:40], comment, *lines[40:], "# end")))
    log = read_log(file, rate=250.0)
    assert len(log.series["time"]) == COUNT
    assert "comment lines between samples take no time: row 42" in log.notes


def test_a_whole_number_among_others_does_not_hide_a_stump(tmp_path: Path) -> None:
    rows = [f"{t:.3f},{a:.8g}" for t, a in zip(TIME, ANGLE, strict=True)]
    rows[0] = "0.000,2"
    log = read_log(written(tmp_path / "log.csv", "\n".join(("time (s),angle (deg)", *rows))[:-5]))
    assert log.left_out.tolist() == [121]


def test_a_file_that_ends_within_a_whole_number(tmp_path: Path) -> None:
    rows = [f"{t:.3f},{a:.3f},{1400 + i}" for i, (t, a) in enumerate(zip(TIME, ANGLE, strict=True))]
    content = "\n".join(("time (s),angle (deg),torque (mN.m)", *rows))
    assert not read_log(written(tmp_path / "whole.csv", content)).left_out.size
    log = read_log(written(tmp_path / "log.csv", content[:-2]))
    assert log.left_out.tolist() == [121]
    assert "the file seems to end within the number 15, which is left out" in log.notes


@pytest.mark.parametrize("row", [5, 60, 118])
def test_a_sample_that_is_far_off_is_refused(row: int, tmp_path: Path) -> None:
    angle = ANGLE.copy()
    angle[row - 2] += 38.0
    file = written(tmp_path / "log.csv", text(HEADINGS[:2], TIME, angle))
    with pytest.raises(
        RecordError, match=rf"rows {row - 1}-{row}: the angle jumps by .* is a sample wrong there"
    ):
        read_log(file)


@pytest.mark.parametrize(
    ("rate", "held", "digit", "noise"),
    [
        *((1000.0, held, 0.0, 0.0) for held in (1, 5, 10, 20)),
        *((2000.0, 1, digit, 0.1 * digit) for digit in (0.088, 0.352, 1.0)),
        (20_000.0, 1, 0.088, 0.05),
        (5000.0, 1, 0.0, 0.1),
    ],
)
def test_slow_and_coarse_sensors_at_high_rates_are_not_wrong(
    rate: float, held: int, digit: float, noise: float, tmp_path: Path
) -> None:
    """Held between their samples, in whole digits, or with noise."""
    time = np.arange(round(1.2 * rate)) / rate
    since = np.maximum(0.0, np.floor(np.arange(len(time)) / held) * held / rate - 0.2)
    angle = 20.0 * np.exp(-3.0 * since) * np.cos(25.0 * since)
    angle += noise * np.random.default_rng(3).standard_normal(len(time))
    angle = np.round(angle / digit) * digit if digit else angle
    log = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle, digits=12)))
    assert held > 5 or not [note for note in log.notes if "leaves the motion" in note]


@pytest.mark.parametrize("other", [np.zeros(COUNT), ANGLE + 2.0, ANGLE / 2.0], ids=["0", "+ 2", "half"])
def test_two_angles_that_alternate_are_noted(other: np.ndarray, tmp_path: Path) -> None:
    angle = np.where(np.arange(COUNT) % 2, ANGLE, other)
    log = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], 4.0 * TIME, angle)))
    assert any("do two angles alternate in one column" in note for note in log.notes)
    record = read_record(tmp_path / "log.csv", free_oscillation=False)
    assert any("do two angles alternate in one column" in note for note in record.notes)


@pytest.mark.parametrize("count", range(1, 13))
def test_samples_that_are_off_at_rest_are_noted(count: int, tmp_path: Path) -> None:
    angle = np.where(np.arange(COUNT) < 30, ANGLE, ANGLE[30]) + 0.01 * np.sin(np.arange(COUNT) ** 2)
    angle[70 : 70 + count] += 4.0
    log = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], TIME, angle)))
    assert any("the angle leaves the motion by up to" in note for note in log.notes)


@pytest.mark.parametrize("row", [5, 60, 118])
def test_a_sample_that_is_a_little_off_is_noted(row: int, tmp_path: Path) -> None:
    angle = ANGLE.copy()
    angle[row - 2] += 4.0
    log = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], TIME, angle)))
    assert any(f"leaves the motion by up to 4 degrees (row {row})" in note for note in log.notes)


@pytest.mark.filterwarnings("error")
def test_equal_times_are_refused_for_what_they_are(tmp_path: Path) -> None:
    time = TIME.copy()
    time[50:53] = time[50]
    with pytest.raises(RecordError, match="time"):
        read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, ANGLE)))


def test_a_file_with_the_end_mark_of_dos(tmp_path: Path) -> None:
    content = text(HEADINGS[:2], TIME, ANGLE)
    assert len(read_log(written(tmp_path / "log.csv", content + "\x1a")).series["time"]) == COUNT


def test_bytes_of_zero_in_a_column_that_is_not_read(tmp_path: Path) -> None:
    content = "time (s),theta (deg),U (V)\n" + _lines("{:.3f},{:.4f},5.0\n")
    file = written(tmp_path / "log.csv", content.replace("5.0\n0.04", "\0\0\0\0\0\0\0\0", 1), "utf-8-sig")
    for read in (read_log, read_record, read_table_file):
        with pytest.raises(RecordError, match=r"row 11: holds bytes of zero"):
            read(file)


@pytest.mark.parametrize(
    "before",
    [
        "time (s),angle (deg)\n-0.2,1.0\n-0.1,1.1\n",
        "Run 1\ntime (s),angle (deg)\n-0.2,1.0\n-0.1,1.1\n\nRun 2\n",
        "time (s),angle (deg),U (V)\n-0.1,1.1,2.5\n",
    ],
)
def test_samples_above_the_headings_are_not_lost(before: str, tmp_path: Path) -> None:
    """They have other columns, or are few."""
    samples = "time (s),angle (deg),temp (degC)\n" + _lines("{:.3f},{:.4f},21.0\n")
    row = before.count("\n") + 1
    with pytest.raises(RecordError, match=f"row {row}: headings are repeated here, below samples"):
        read_log(written(tmp_path / "log.csv", before + samples))


def test_settings_above_the_headings_may_have_their_names(tmp_path: Path) -> None:
    before = "Channel,time (s),angle (deg)\nGain,1.0,2.5\nOffset,0.0,0.5\n\n"
    samples = "time (s),angle (deg),temp (degC)\n" + _lines("{:.3f},{:.4f},21.0\n")
    assert len(read_log(written(tmp_path / "log.csv", before + samples)).rows) == COUNT


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16"])
def test_a_last_row_with_another_delimiter(encoding: str, tmp_path: Path) -> None:
    rows = _lines("{:.3f};{:.4f}\n").replace(".", ",")
    head, _, last = rows.rstrip("\n").rpartition("\n")
    content = f"Prüfer;Müller;Raum 3\n\nZeit (s);Winkel (°)\n{head}\n{last.replace(';', '|')}\n"
    with pytest.raises(RecordError, match=rf"row {COUNT + 3}: has 1 cell under 2 headings"):
        read_log(written(tmp_path / "log.csv", content, encoding))


@pytest.mark.parametrize("value", [91.0, -40.0])
def test_a_velocity_far_outside_is_noted(value: float, tmp_path: Path) -> None:
    omega = np.gradient(np.radians(ANGLE), TIME)
    omega[60] = value
    file = written(
        tmp_path / "record.csv", text(("time (s)", "theta (deg)", "omega (rad/s)"), TIME, ANGLE, omega)
    )
    notes = read_record(file, free_oscillation=False).notes
    assert notes == (f"omega is {value:g}, far outside all other samples (row 62): is it wrong?",)
    assert read_log(file).notes == (notes[0].replace("omega", "'omega (rad/s)'"),)


def test_taps_of_a_torque_are_not_wrong(tmp_path: Path) -> None:
    taps = np.where(np.arange(COUNT) == 60, 3.0, 0.0) + 0.01 * np.sin(np.arange(COUNT))
    assert read_log(written(tmp_path / "log.csv", text(HEADINGS[:3], TIME, ANGLE, taps))).notes == ()


def test_an_angle_that_jumps_is_refused_in_any_record(tmp_path: Path) -> None:
    angle = ANGLE.copy()
    angle[60] += 30.0
    file = written(tmp_path / "record.csv", text(("time (s)", "theta (deg)"), TIME, angle))
    with pytest.raises(RecordError, match=r"rows 61-62: the angle jumps by 29"):
        read_record(file, free_oscillation=False)


def test_rounded_times_are_noted(tmp_path: Path) -> None:
    times = np.round(TIME * 250.0 / 60.0, 2)
    (note,) = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], times, ANGLE))).notes
    assert note.startswith("uneven times: steps from 0.01 to 0.02 s; if the times are rounded, export them")


def test_an_angle_that_freezes_is_noted_at_import(tmp_path: Path) -> None:
    angle = ANGLE + 3.0 * np.sin(60.0 * TIME)
    angle[60:75] = angle[60]
    notes = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], TIME, angle))).notes
    told = "the angle stays exactly the same for up to 15 samples while the joystick moves (rows 62-76)"
    assert any(note.startswith(told) for note in notes)


@pytest.mark.parametrize(("factor", "offset", "size"), [(np.pi / 180.0, 0.0, "2.8"), (1.0, 6.0, "5.6")])
def test_a_unit_or_a_zero_that_changes_is_noted(
    factor: float, offset: float, size: str, tmp_path: Path
) -> None:
    """At -2.9 degrees, at which the angle moves by 0.4 degrees from sample to sample."""
    time = np.arange(1000) / 500.0
    angle = 20.0 * np.exp(-1.5 * time) * np.cos(12.0 * time)
    angle[74:] = factor * angle[74:] + offset
    notes = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    told = (
        f"the angle moves by {size} degrees between two samples (rows 75-76), much faster than anywhere else"
    )
    assert [note.partition(":")[0] for note in notes] == [told]


@pytest.mark.parametrize("rate", [240.0, 1000.0])
def test_a_zero_that_changes_at_rest_is_noted(rate: float, tmp_path: Path) -> None:
    time = np.arange(int(2.0 * rate)) / rate
    angle = 20.0 * np.exp(-6.0 * time) * np.cos(25.0 * time)
    angle += 0.03 * np.random.default_rng(2).standard_normal(len(time))
    angle[int(1.5 * rate) :] += 2.0
    notes = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    place = int(1.5 * rate) + 1
    assert any(f"between two samples (rows {place}-{place + 1}), much faster" in note for note in notes)


def test_rows_that_are_lost_in_a_fast_motion_are_a_gap_alone(tmp_path: Path) -> None:
    """In 11 ms the angle moves by 4 degrees, as fast as around the gap."""
    time = np.delete(np.arange(1200), slice(74, 84)) / 1000.0
    angle = 20.0 * np.exp(-1.5 * time) * np.cos(20.0 * time)
    (note,) = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    assert note.startswith("a gap of 0.011 s between rows 75 and 76")


@pytest.mark.parametrize("rate", [60.0, 100.0])
def test_the_release_of_a_light_joystick_is_no_change_of_its_zero(rate: float, tmp_path: Path) -> None:
    time = np.arange(int(2.0 * rate)) / rate
    moved = np.maximum(time - 0.5, 0.0)
    angle = 18.0 * np.exp(-2.0 * rate * moved) + 0.01 * np.sin(40.0 * time)
    notes = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    assert not any("much faster" in note for note in notes)


def test_a_slow_record_may_miss_a_whole_motion(tmp_path: Path) -> None:
    """Moved to the other side and held there, between two samples."""
    time = np.arange(40) / 10.0
    angle = np.where(time < 2.0, -3.0, 6.0) + 0.01 * np.sin(40.0 * time)
    notes = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    assert not any("much faster" in note for note in notes)


def test_an_angle_that_freezes_until_the_end_is_noted(tmp_path: Path) -> None:
    time = np.arange(480) / 240.0
    angle = 20.0 * np.exp(-1.5 * time) * np.cos(12.0 * time)
    assert read_log(written(tmp_path / "whole.csv", text(HEADINGS[:2], time, angle))).notes == ()
    angle[200:] = angle[200]
    (note,) = read_log(written(tmp_path / "log.csv", text(HEADINGS[:2], time, angle))).notes
    assert note.startswith("the angle stays exactly the same for up to 280 samples")
    assert "(rows 202-481)" in note


def test_a_joystick_that_sticks_does_not_freeze(tmp_path: Path) -> None:
    """Coulomb friction ends its last swing; a coarse encoder and an exact simulation."""
    time = np.arange(480) / 240.0
    swing = np.where(time < 0.75, 20.0 - 12.0 * time, 11.0) * np.cos(4.0 * np.pi * time)
    angle = np.where(time < 1.0, swing, 11.0)
    for decimals in (1, 6):
        rows = text(HEADINGS[:2], time, np.round(angle, decimals))
        assert read_log(written(tmp_path / f"{decimals}.csv", rows)).notes == ()
