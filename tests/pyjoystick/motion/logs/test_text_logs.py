"""Text logs: each is read correctly, or refused with the option to add."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.motion import Layout, RecordError, Scale, read_log
from tests.pyjoystick.motion.logs.made import ANGLE, COUNT, TIME, TORQUE, text, written

DEG = np.radians(1.0)
GERMAN = ("Zeit [s]", "Winkel [Grad]", "Drehmoment [Nm]")


def _german(**form: Any) -> str:
    return text(GERMAN, TIME, ANGLE, TORQUE, **({"delimiter": ";", "decimal": ","} | form))


def _lines(form: str) -> str:
    return "".join(form.format(t, a) for t, a in zip(TIME.tolist(), ANGLE.tolist(), strict=True))


def _with_clock(form: Callable[[float], str], **more: Any) -> str:
    return text(("Uhrzeit", "Winkel (Grad)"), [form(float(t)) for t in TIME], ANGLE, delimiter=";", **more)


def _clock(time: float) -> str:
    return f"10:59:{59.8 + time:06.3f}" if time < 0.2 else f"11:00:{time - 0.2:06.3f}"


def _with_inserted(content: str, at: int, line: str) -> str:
    lines = content.split("\n")
    return "\n".join([*lines[:at], line, *lines[at:]])


@pytest.mark.parametrize("headings", ["Time(s) Angle(°) Adc", "t/s phi/° Adc", "No(#) Angle(°) Adc"])
@pytest.mark.parametrize("preamble", ["Operator: A. Author\n\n", "Operator: A. Author\n", ""])
def test_headings_below_a_line_of_as_many_words(headings: str, preamble: str, tmp_path: Path) -> None:
    """Adc is also a unit, but a heading with a unit of its own is none."""
    rows = _lines("{0:.3f} {1:.3f} 1200\n")
    file = written(tmp_path / "log.txt", f"{preamble}{headings}\n{rows}")
    log = read_log(file, rate=250.0 if "#" in headings else None)
    assert log.found["theta"].heading.text == headings.split()[1]
    assert log.series["theta"] == pytest.approx(DEG * ANGLE, abs=1e-5)


#: Name -> content, encoding, whether the torque is in it.
READ: dict[str, tuple[str, str, bool]] = {
    "plain": (text(("time (s)", "theta (deg)"), TIME, ANGLE), "utf-8", False),
    "german": (_german(), "utf-8", True),
    "german windows": (_german(newline="\r\n"), "cp1252", True),
    "old mac lines": (_german(newline="\r"), "utf-8", True),
    "bom": (_german(), "utf-8-sig", True),
    "utf-16": (_german(), "utf-16", True),
    "utf-16 without a mark": (_german(), "utf-16-le", True),
    "latin-1 degree": (
        text(("t/s", "Winkel/°"), TIME, ANGLE, delimiter=";", decimal=","),
        "latin-1",
        False,
    ),
    "cp1252 umlauts": (
        text(
            ("Prüfzeit", "Zeit [s]", "Winkel [°]"),
            ["früh"] * COUNT,
            TIME,
            ANGLE,
            delimiter=";",
            decimal=",",
            before="Prüfer: Müller\nGerät: Öl\n",
        ),
        "cp1252",
        False,
    ),
    "iso symbols": (text(("t/s", "phi/deg", "M/Nm"), TIME, ANGLE, TORQUE, delimiter="\t"), "utf-8", True),
    "ms and mrad": (
        text(("Time in ms", "Angle, mrad"), 1e3 * TIME, 1e3 * DEG * ANGLE, delimiter=";", digits=15),
        "utf-8",
        False,
    ),
    "minutes and gon": (
        text(("time (min)", "angle (gon)"), TIME / 60.0, ANGLE / 0.9, digits=15),
        "utf-8",
        False,
    ),
    "hours and millidegrees": (
        text(("Zeit/h", "Winkel/mdeg"), TIME / 3600.0, 1e3 * ANGLE, delimiter=";", digits=15),
        "utf-8",
        False,
    ),
    "the least and the greatest angle": (
        text(("time (s)", "angle (deg)", "angle min", "angle max"), TIME, ANGLE, ANGLE - 1.0, ANGLE + 1.0),
        "utf-8",
        False,
    ),
    "czech windows": (
        text(("Čas [s]", "Úhel [°]"), TIME, ANGLE, delimiter=";", decimal=","),
        "cp1250",
        False,
    ),
    "us": (text(("time_us", "angle_deg"), 1e6 * TIME, ANGLE), "utf-8", False),
    "french": (text(("Temps (s)", "Angle (degrés)", "Couple (N·m)"), TIME, ANGLE, TORQUE), "utf-8", True),
    "spanish": (text(("tiempo [ms]", "ángulo [grados]"), 1e3 * TIME, ANGLE, delimiter="|"), "utf-8", False),
    "italian": (
        text(("Tempo (s)", "Angolo (gradi)"), TIME, ANGLE, delimiter=";", decimal=","),
        "utf-8",
        False,
    ),
    "capitals": (text(("TIME [S]", "ANGLE [DEG]"), TIME, ANGLE), "utf-8", False),
    "trailing tab": (
        "time [s]\tangle [deg]\t\n"
        + "".join(f"{t:.9g}\t{a:.9g}\t\n" for t, a in zip(TIME, ANGLE, strict=True)),
        "utf-8",
        False,
    ),
    "trailing tab below the headings only": (
        "time [s]\tangle [deg]\n"
        + "".join(f"{t:.9g}\t{a:.9g}\t\n" for t, a in zip(TIME, ANGLE, strict=True)),
        "utf-8",
        False,
    ),
    "blanks": (
        "  time (s)    angle (deg)\n" + _lines("  {:10.6f}  {:12.6f}\n"),
        "utf-8",
        False,
    ),
    "preamble": (
        _german(before="Prüfstand 3\nDatum;22.11.2026\nAbtastrate;250\n\nKanäle;3;x\n"),
        "utf-8",
        True,
    ),
    "padded preamble": (_german(before="Bench;;\nRate;250;\nDate;2026;\n"), "utf-8", True),
    "empty cells below": (_german() + ";;\n;;\n# exported\n;;\n", "utf-8", True),
    "empty cells with other delimiters below": (_german() + ",,,\n", "utf-8", True),
    "sep line": (_german(before="sep=;\n"), "utf-8", True),
    "units below": (
        text(("Time", "Angle", "Torque"), ["s", *TIME], ["deg", *ANGLE], ["N.m", *TORQUE]),
        "utf-8",
        True,
    ),
    "units below in brackets": (
        text(
            ("Time", "Angle", "Pressure"),
            ["[s]", *TIME],
            ["[deg]", *ANGLE],
            ["[mbar]", *TORQUE],
            before="Bench\n",
        ),
        "utf-8",
        False,
    ),
    "comments inside": (_with_inserted(_german(), 40, "# Operator: pause"), "utf-8", True),
    "headings in a comment": (
        "# made by numpy\n# time (s) angle (deg)\n" + _lines("{:.9e} {:.9e}\n"),
        "utf-8",
        False,
    ),
    "percent comments": (
        text(("t (s)", "theta (rad)"), TIME, DEG * ANGLE, before="% Octave\n", digits=15),
        "utf-8",
        False,
    ),
    "quoted decimals": (text(("time [s]", "angle [deg]"), TIME, ANGLE, decimal=","), "utf-8", False),
    "commas in headings": (
        text(("time, s", "angle, deg"), TIME, ANGLE, delimiter=";", decimal=",").replace('"', ""),
        "utf-8",
        False,
    ),
    "russian": (
        text(("Время [s]", "Угол [deg]"), TIME, ANGLE, delimiter=";", decimal=",", before="Стенд три\n"),
        "cp1251",
        False,
    ),
    "japanese": (
        text(("時間 [s]", "角度 [deg]"), TIME, ANGLE, before="試験装置\n"),
        "shift_jis",
        False,
    ),
    "quoted headings": (
        text(("time, of the bench [s]", "x"), TIME, ANGLE)
        .replace("time, of the bench", "time")
        .replace("x\n", '"angle [deg]"\n'),
        "utf-8",
        False,
    ),
    "minus signs": (_german().replace("-", "\N{MINUS SIGN}"), "utf-8", True),
    "exponents": (
        "time (s);angle (deg)\n" + _lines("{:.9e};{:.9E}\n"),
        "utf-8",
        False,
    ),
    "other columns": (
        text(
            ("No.", "Time [s]", "Temperature T [°C]", "T [°C]", "Angle [deg]", "Remark"),
            [*range(COUNT)],
            TIME,
            20.0 + TIME,
            21.0 + TIME,
            ANGLE,
            ["a;b"] * COUNT,
        ),
        "utf-8",
        False,
    ),
    "a clock": (_with_clock(_clock), "utf-8", False),
    "a clock with commas": (_with_clock(lambda t: _clock(t).replace(".", ","), decimal=","), "utf-8", False),
    "date and clock": (
        text(
            ("timestamp", "angle (deg)"),
            [
                f"2026-11-22 23:59:{59.8 + t:06.3f}" if t < 0.2 else f"2026-11-23T00:00:{t - 0.2:06.3f}"
                for t in TIME
            ],
            ANGLE,
        ),
        "utf-8",
        False,
    ),
    "a clock under the plain name": (
        text(("time", "angle (deg)"), [*map(_clock, TIME)], ANGLE),
        "utf-8",
        False,
    ),
    "date, clock and zone": (
        text(
            ("time", "angle (deg)"),
            [
                f"2026-03-29T01:59:{59.8 + t:06.3f}+01:00"
                if t < 0.2
                else f"2026-03-29T03:00:{t - 0.2:06.3f}+0200"
                for t in TIME
            ],
            ANGLE,
        ),
        "utf-8",
        False,
    ),
    "date, clock and Z": (
        text(("time", "angle (deg)"), [f"2026-11-22T10:00:{t:06.3f}Z" for t in TIME], ANGLE),
        "utf-8",
        False,
    ),
    "two headings without a name": (
        text(("Zeit [s]", "", "Winkel [Grad]", ""), TIME, ["x"] * COUNT, ANGLE, ["y"] * COUNT, delimiter=";"),
        "utf-8",
        False,
    ),
}


@pytest.mark.parametrize("name", READ)
def test_a_log_is_read_as_it_was_written(name: str, tmp_path: Path) -> None:
    content, encoding, has_torque = READ[name]
    log = read_log(written(tmp_path / "log.txt", content, encoding))
    start = log.series["time"][0]
    np.testing.assert_allclose(log.series["time"] - start, TIME, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, rtol=0.0, atol=1e-9)
    assert ("T" in log.series) == has_torque
    if has_torque:
        np.testing.assert_allclose(log.series["T"], TORQUE, rtol=0.0, atol=1e-9)
    assert not log.left_out.size


THOUSANDS = "".join(f"{1000 + i:,};{1 + abs(i % 12 - 6)},{500 + i}\n" for i in range(COUNT))
#: Name -> content, what the message says, the options that it asks for.
REFUSED: dict[str, tuple[str, str, dict[str, Any]]] = {
    "an angle without a unit": (
        text(("time (s)", "angle"), TIME, ANGLE),
        r"column 'angle', row 1: has no unit; .*--unit theta=",
        {"units": {"theta": "deg"}},
    ),
    "a time without a unit": (
        text(("time", "angle (deg)"), 1e3 * TIME, ANGLE),
        "column 'time': has no unit; its steps of 4 can be ms or us; say which: --unit time=ms or --unit ",
        {"units": {"time": "ms"}},
    ),
    "ms labeled as s": (
        text(("time (s)", "angle (deg)"), 1e3 * TIME, ANGLE),
        "ms or us labeled as s.*--unit time=ms",
        {"units": {"time": "ms"}},
    ),
    "1 ms labeled as s": (
        text(("time (s)", "angle (deg)"), 250.0 * TIME, ANGLE),
        "ms or us labeled as s.*--unit time=ms",
        {"units": {"time": "ms"}, "stretched": 4.0},
    ),
    "s labeled as ms": (
        text(("time (ms)", "angle (deg)"), TIME, ANGLE),
        "a record of 0.000476 s is too short .*--unit time=s",
        {"units": {"time": "s"}},
    ),
    "an angle with and one without a unit": (
        text(("time (s)", "angle", "angle (deg)"), TIME, ANGLE, -ANGLE),
        "has 2 columns 'angle'; choose one: --column theta='angle' or",
        {"columns": {"theta": "angle"}, "units": {"theta": "deg"}},
    ),
    "dates of an unknown order": (
        text(("Zeit", "n", "Winkel [Grad]"), [f"11.12.2026 10:00:0{t:.3f}" for t in TIME], TIME, ANGLE),
        "column 'Zeit', row 2: is not a number",
        {"rate": 250.0},
    ),
    "two angles": (
        text(("time (s)", "angle (deg)", "winkel (deg)"), TIME, ANGLE, -ANGLE),
        r"2 columns that may be theta; choose one: --column theta='angle \(deg\)' or",
        {"columns": {"theta": "angle (deg)"}},
    ),
    "duplicate headings": (
        text(("time (s)", "angle (deg)", "angle (deg)"), TIME, ANGLE, -ANGLE),
        r"has 2 columns 'angle'; choose one: --column theta='angle \(deg\) #2' or",
        {"columns": {"theta": "angle (deg) #2"}},
    ),
    "an angle by another name": (
        text(("time (s)", "Stick (deg)"), TIME, ANGLE),
        r"which column holds theta\? There are .*'Stick \(deg\)'.*--column theta=",
        {"columns": {"theta": "Stick"}},
    ),
    "Grad that may be gon": (
        text(("time (s)", "angle (grad)"), TIME, ANGLE),
        "has an unknown unit .found grad.*--unit theta=UNIT",
        {"units": {"theta": "deg"}},
    ),
    "counts": (
        text(("time (s)", "angle (counts)"), TIME, np.round(ANGLE * 1e6) + 2048.0),
        "holds readings in count.*--scale theta=",
        {"scales": {"theta": Scale(1e-6 * DEG, "count", 2048.0)}},
    ),
    "volts": (
        text(("time (s)", "angle (mV)"), TIME, 100.0 * ANGLE + 2500.0, digits=12),
        "holds readings in mV.*--scale theta=",
        {"scales": {"theta": Scale(10.0 * DEG, "V", 2.5)}},
    ),
    "no headings": (
        text((), TIME, ANGLE),
        "a number where a heading is expected.*--column time=#1 --column theta=#2",
        {"columns": {"time": "#1", "theta": "#2"}, "units": {"time": "s", "theta": "deg"}},
    ),
    "no time": (
        text(("angle (deg)", "remark (V)"), ANGLE, TORQUE),
        "which column holds time",
        {"rate": 250.0},
    ),
    "two delimiters": (
        text(("time (s)", "angle (deg)", "note;a;b"), TIME, ANGLE, [f"x;{i};{i}" for i in range(COUNT)]),
        "may be separated by comma or semicolon; say which: --delimiter comma or --delimiter semicolon",
        {"layout": Layout(delimiter="comma")},
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_log_of_two_meanings_is_refused_and_read_with_the_option(name: str, tmp_path: Path) -> None:
    content, message, options = REFUSED[name]
    path = written(tmp_path / "log.csv", content)
    with pytest.raises(RecordError, match=message):
        read_log(path)
    stretched = options.get("stretched", 1.0)
    log = read_log(path, **{option: value for option, value in options.items() if option != "stretched"})
    np.testing.assert_allclose(log.series["time"] * stretched, TIME, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (f"time (ms);angle (deg)\n{THOUSANDS}", "decimal mark or separate thousands.*--decimal"),
        (
            "time [s];angle [deg]\n" + "".join(f"{t:.3f};1.234,5\n" for t in TIME),
            "'1.234,5'",
        ),
        (
            "time (s),angle (deg)\n" + "".join(f"0,{i:03d},1,{i}\n" for i in range(9)),
            "4 cells under 2 headings",
        ),
        ("time (s),angle (deg)\n" + "".join(f"0.5,{i}\n" for i in range(9)), "times are repeated"),
        ("time (s),angle (deg)\n" + "".join(f"{9 - i}.5,{i}\n" for i in range(9)), "time runs backward"),
        (
            _with_inserted(_german(), 40, "Zeit [s];Winkel [Grad];Drehmoment [Nm]"),
            "row 41: the headings are repeated here",
        ),
        (_with_inserted(_german(), 40, "0,158;7,5"), "row 41: has 2 cells under 3 headings"),
        (_with_inserted(_german(), 40, "0,158;7;5;1"), "row 41: has 4 cells under 3 headings"),
        (text(("time (s)", "angle (kg)"), TIME, ANGLE), "column 'angle .kg.', row 1: has an unknown unit"),
        (text(("time (s)", "angle (rad)"), TIME, ANGLE), "degrees labeled as radians"),
        (
            text(("time (s)", "angle (deg)"), TIME, np.where(np.arange(COUNT) % 40 == 9, -999.0, ANGLE)),
            "all are the same, -999 degrees: does the instrument write this where it has no angle",
        ),
        (_with_inserted(_german(), 40, 30 * "\0"), "row 41: holds bytes of zero"),
        ("PathFileType\t4\t(X/Y/Z)\ta.trc\n1\t2\n", "pyjoystick import markers"),
        ("", "has no headings"),
    ],
    ids=range(14),
)
def test_a_log_that_no_option_mends_is_refused_with_the_place(
    content: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(RecordError, match=message):
        read_log(written(tmp_path / "log.csv", content))


def test_rows_without_a_number_are_left_out_and_named(tmp_path: Path) -> None:
    lines = _german().split("\n")
    for i, cell in ((10, ""), (11, "NaN"), (12, "#NV"), (30, "-")):
        lines[i] = ";".join((lines[i].split(";")[0], cell, "1,5"))
    log = read_log(written(tmp_path / "log.csv", "\n".join(lines)))
    assert log.left_out.tolist() == [11, 12, 13, 31]
    kept = np.setdiff1d(np.arange(COUNT), [9, 10, 11, 29])
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE[kept], atol=1e-9)
    assert "4 rows without a number are left out: rows 11-13, 31" in log.notes


@pytest.mark.parametrize(
    ("delimiter", "line"), [(",", ","), (";", ";"), ("\t", "\t"), (",", ""), ("\t", ""), (";", " ")]
)
def test_rows_without_cells_take_the_time_of_a_sample(delimiter: str, line: str, tmp_path: Path) -> None:
    lines = text(("n", "theta (deg)"), range(COUNT), ANGLE, delimiter=delimiter).split("\n")
    lines[61:71] = [line] * 10
    log = read_log(written(tmp_path / "log.csv", "\n".join(lines)), rate=250.0)
    np.testing.assert_allclose(log.series["time"], np.delete(TIME, np.arange(60, 70)), atol=1e-12)
    assert log.left_out.tolist() == list(range(62, 72))
    assert "10 rows without a number are left out: rows 62-71" in log.notes


@pytest.mark.parametrize("newline", ["\n\n", "\r\r\n"])
def test_empty_lines_between_all_lines_are_no_samples(newline: str, tmp_path: Path) -> None:
    content = text(("n", "theta (deg)"), range(COUNT), ANGLE, newline=newline)
    log = read_log(written(tmp_path / "log.csv", content), rate=250.0)
    np.testing.assert_allclose(log.series["time"], TIME, atol=1e-12)
    assert not log.left_out.size


@pytest.mark.parametrize("line", [";", "", " ; "])
@pytest.mark.parametrize("after", [0, 1, 2])
def test_rows_without_cells_above_the_samples_are_skipped(line: str, after: int, tmp_path: Path) -> None:
    lines = text((), TIME, ANGLE, delimiter=";", before="Log of test 7;\ntime;theta\ns;deg\n").split("\n")
    lines[after + 1 : after + 1] = [line] * 3
    log = read_log(written(tmp_path / "log.csv", "\n".join(lines)))
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, atol=1e-9)
    np.testing.assert_allclose(log.series["time"], TIME, atol=1e-9)
    assert not log.left_out.size


def test_a_stretch_is_cut_out(tmp_path: Path) -> None:
    log = read_log(written(tmp_path / "log.csv", _german()), start=0.1, end=0.2)
    assert log.series["time"][[0, -1]] == pytest.approx([0.1, 0.2])
    with pytest.raises(RecordError, match=r"no samples from 5 to 6 s; check --from, --to"):
        read_log(written(tmp_path / "log.csv", _german()), start=5.0, end=6.0)


def test_both_decimal_marks_decide_what_was_doubtful(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", f"time (ms);angle (deg)\n{THOUSANDS}")
    log = read_log(path, layout=Layout(decimal=","), units={"time": "ms"})
    assert log.series["time"][1] == pytest.approx(1.001e-3)
    assert log.series["theta"][1] == pytest.approx(np.radians(6.501))


def test_an_encoding_that_is_given_is_taken(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", text(("t/s", "Winkel/°"), TIME, ANGLE, delimiter=";"), "cp437")
    assert read_log(path, layout=Layout(encoding="cp437")).found["theta"].unit == "deg"
    with pytest.raises(RecordError, match="is not text in utf-8"):
        read_log(path, layout=Layout(encoding="utf-8"))
    with pytest.raises(RecordError, match="is not text in latin-77"):
        read_log(path, layout=Layout(encoding="latin-77"))


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("lbf.in", 0.1129848290276167),
        ("in-lb", 0.1129848290276167),
        ("In-Lbs", None),
        ("in.lbf", 0.1129848290276167),
        ("lb-in", 0.1129848290276167),
        ("lbf ft", 1.3558179483314004),
        ("ft-lb", 1.3558179483314004),
    ],
)
def test_torques_in_pounds(unit: str, factor: float | None, tmp_path: Path) -> None:
    """Exact: 1 in = 0.0254 m, 1 lbf = 4.4482216152605 N."""
    path = written(
        tmp_path / "log.csv", text(("time (s)", "angle (deg)", f"Torque ({unit})"), TIME, ANGLE, TORQUE)
    )
    if factor is None:
        with pytest.raises(RecordError, match="has an unknown unit"):
            read_log(path, columns={"T": f"Torque ({unit})"})
    else:
        expected = pytest.approx(factor * np.asarray(TORQUE), rel=1e-8)
        assert read_log(path).series["T"] == expected
        assert read_log(path, units={"T": unit}).series["T"] == expected


def test_a_unit_that_contradicts_the_known_one_of_a_torque_is_refused(tmp_path: Path) -> None:
    path = written(
        tmp_path / "log.csv", text(("time (s)", "angle (deg)", "Torque (in-lb)"), TIME, ANGLE, TORQUE)
    )
    with pytest.raises(RecordError, match=r"row 1: has the unit lbf.in in its heading, but N.m is given"):
        read_log(path, columns={"T": "Torque (in-lb)"}, units={"T": "N.m"})
    path = written(tmp_path / "b.csv", text(("time (s)", "angle (deg)", "Torque (oz)"), TIME, ANGLE, TORQUE))
    log = read_log(path, columns={"T": "Torque (oz)"}, units={"T": "N.mm"})
    assert log.series["T"] == pytest.approx(1e-3 * np.asarray(TORQUE), rel=1e-8)
    assert "'Torque (oz)' is read in N.mm, as given" in log.notes


def test_headings_that_are_repeated_are_named(tmp_path: Path) -> None:
    lines = text(("time (s)", "angle (deg)"), TIME, ANGLE).splitlines()
    path = written(tmp_path / "log.csv", "\n".join([*lines[:20], lines[0], *lines[20:], ""]))
    with pytest.raises(RecordError, match=r"row 21: the headings are repeated here .*one record a file"):
        read_log(path)


def test_a_hole_between_two_records_is_noted(tmp_path: Path) -> None:
    time = np.asarray(TIME) + np.where(np.arange(COUNT) < 10, 0.0, 30.0)
    path = written(tmp_path / "log.csv", text(("time (s)", "angle (deg)"), time, ANGLE))
    [note] = read_log(path).notes
    assert note.startswith("a gap of 30")
    assert "between rows 11 and 12" in note


def test_a_counter_that_wraps_is_refused_with_the_rows(tmp_path: Path) -> None:
    """Its angles are all possible, and a fit to them would be one to nothing."""
    wrapped = (ANGLE + 10.0) % 20.0 - 10.0
    path = written(tmp_path / "wrapped.csv", text(("time (s)", "theta (deg)"), TIME, wrapped))
    with pytest.raises(RecordError, match=r"jumps by .* did a counter wrap around") as caught:
        read_log(path)
    jumps = np.flatnonzero(np.abs(np.diff(wrapped)) > 10.0)
    assert caught.value.rows == tuple(np.unique(np.concatenate((jumps, jumps + 1)) + 2).tolist())


def test_an_angle_from_0_to_360_degrees_is_not_taken_for_degrees_under_another_name(tmp_path: Path) -> None:
    path = written(tmp_path / "turn.csv", text(("time (s)", "theta (deg)"), TIME, ANGLE % 360.0))
    with pytest.raises(RecordError, match=r"90 degrees or more.* wrap around at a full turn, or is zero not"):
        read_log(path)


def test_degrees_under_the_name_of_radians_are_told_in_a_turn_too(tmp_path: Path) -> None:
    """Angles of up to 6 degrees are none of up to 6 rad, and could be such of a sensor that turns round."""
    small = written(
        tmp_path / "small.csv", text(("time (s)", "theta (rad)"), TIME, ANGLE * 6.0 / np.abs(ANGLE).max())
    )
    question = r"is this in degrees \(name the column theta \(deg\)\), does it wrap around at a full turn, or"
    with pytest.raises(RecordError, match=question):
        read_log(small)
    radians = written(tmp_path / "radians.csv", text(("time (s)", "theta (rad)"), TIME, ANGLE))
    with pytest.raises(RecordError, match="degrees labeled as radians"):
        read_log(radians)


LABVIEW = """LabVIEW Measurement\t
Writer_Version\t2
Separator\tTab
Decimal_Separator\t.
Multi_Headings\tNo
Time\t14:03:11.5017
***End_of_Header***\t
\t
{}"""
CHANNELS = """Channels\t1\t\t
Samples\t120\t\t
Time\t14:03:11.6\t\t
Y_Unit_Label\tdeg\t\t
Delta_X\t0.004000\t\t
***End_of_Header***\t\t\t
"""


def test_a_labview_measurement_without_times(tmp_path: Path) -> None:
    rows = "".join(f"\t{a:.6f}\n" for a in ANGLE)
    file = written(tmp_path / "log.lvm", LABVIEW.format(f"{CHANNELS}X_Value\tAngle\tComment\n{rows}"))
    with pytest.raises(
        RecordError, match=r"holds no two columns of numbers below its headers; .*X_Columns One"
    ):
        read_log(file, rate=250.0)


@pytest.mark.parametrize("delimiter", ["\t", ","], ids=["tab", "comma"])
@pytest.mark.parametrize("comment", ["", "\t", "\tpause"], ids=["no cells", "empty cells", "comments"])
def test_a_labview_measurement(comment: str, delimiter: str, tmp_path: Path) -> None:
    """The headings have a column more than the data if there are no comments."""
    rows = "".join(f"{t:.6f}\t{a:.6f}{comment}\n" for t, a in zip(TIME, ANGLE, strict=True))
    table = f"{CHANNELS}X_Value\tAngle\tComment\n{rows}"
    file = written(tmp_path / "log.lvm", LABVIEW.format(table).replace("\t", delimiter), "utf-8")
    names = {"columns": {"time": "X_Value", "theta": "Angle"}, "units": {"time": "s", "theta": "deg"}}
    log = read_log(file, **names)
    np.testing.assert_allclose(log.series["time"], TIME, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(log.series["theta"], DEG * ANGLE, rtol=0.0, atol=1e-9)

    at_first = table.replace(f"{ANGLE[0]:.6f}{comment}\n", f"{ANGLE[0]:.6f}\tstart\n", 1)
    file = written(tmp_path / "start.lvm", LABVIEW.format(at_first).replace("\t", delimiter), "utf-8")
    np.testing.assert_array_equal(read_log(file, **names).series["theta"], log.series["theta"])

    shifted = table.replace(f"{comment}\n", "\t0.5\n")
    file = written(tmp_path / "shifted.lvm", LABVIEW.format(shifted).replace("\t", delimiter), "utf-8")
    with pytest.raises(RecordError, match=r"holds no two columns|has \d cells under \d headings"):
        read_log(file, **names)

    file = written(tmp_path / "two.lvm", LABVIEW.format(2 * table), "utf-8")
    with pytest.raises(RecordError, match=r"two.lvm, row 141: holds 2 measurements"):
        read_log(file, **names)


@pytest.mark.parametrize(
    ("heading", "factor", "words"), [("T (N.m)", 1e3, "200 N.m"), ("F (N)", 1e4, "2000 N")]
)
def test_torques_and_forces_that_no_joystick_takes_are_refused(
    heading: str, factor: float, words: str, tmp_path: Path
) -> None:
    table = text(("time (s)", "angle (deg)", heading), TIME, ANGLE, factor * TORQUE)
    path = written(tmp_path / "log.csv", table)
    with pytest.raises(RecordError, match=f"a joystick takes up to {words}; is this really in"):
        read_log(path)


@pytest.mark.parametrize(
    "heading",
    [
        "-theta (rad)",
        "\N{MINUS SIGN}Winkel (rad)",
        "\N{FULLWIDTH HYPHEN-MINUS}theta (rad)",
        "_-theta (rad)",
        ".-theta (rad)",
        "- Angle (rad)",
        "-theta_rad",
        "neg. angle (rad)",
        "neg.theta (rad)",
        "2.theta (rad)",
        "abs.theta (rad)",
    ],
)
def test_the_negative_of_a_quantity_is_not_taken_for_it(heading: str, tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text(text(("time (s)", heading), TIME, ANGLE), "utf-8")
    with pytest.raises(RecordError, match="has no column 'theta'"):
        read_log(path)


@pytest.mark.parametrize("heading", ["data.theta (rad)", "data.inverted.theta (rad)"])
def test_a_quantity_in_a_structure_is_noted(heading: str, tmp_path: Path) -> None:
    """What stands before the point may change its meaning."""
    path = tmp_path / "log.csv"
    path.write_text(text(("time (s)", heading), TIME, np.radians(ANGLE)), "utf-8")
    assert f"{heading!r} is read as theta" in read_log(path).notes


def test_quoted_thousands_between_commas_are_refused(tmp_path: Path) -> None:
    rows = ["0,20,000", "10,18,542", "20,-6,427", "30,687"]
    quoted = "".join('"{}","{}"\n'.format(*row.split(",", 1)) for row in rows)
    path = written(tmp_path / "log.csv", f"time (ms),angle (mdeg)\n{quoted}")
    with pytest.raises(RecordError, match=r"row 2: may be a decimal mark or separate thousands .*'20,000'"):
        read_log(path)


@pytest.mark.parametrize("heading", ["Frame", "Sample", "Nr.", "frameNumber", "Lfd. Nr.", "Zähler"])
def test_numbers_of_samples_that_are_skipped_take_their_time(heading: str, tmp_path: Path) -> None:
    numbers = np.delete(np.arange(1, COUNT + 1), [6, 7, 20])
    angle = np.delete(ANGLE, [6, 7, 20])
    log = read_log(written(tmp_path / "log.csv", text((heading, "angle (deg)"), numbers, angle)), rate=250.0)
    np.testing.assert_allclose(log.series["time"], (numbers - 1) / 250.0, rtol=0, atol=1e-12)
    assert f"{heading!r} skips 3 samples, which the times follow" in log.notes


def test_numbers_of_samples_in_larger_steps_are_noted(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", text(("Frame", "angle (deg)"), 2 * np.arange(COUNT), ANGLE))
    log = read_log(path, rate=250.0)
    np.testing.assert_allclose(log.series["time"], np.arange(COUNT) / 250.0, rtol=0, atol=1e-12)
    assert "'Frame' counts in steps of 2; the rows are 250 per second" in log.notes


def _other_steps() -> list[str]:
    numbers = 2 * np.arange(COUNT)
    numbers[10:] += 1
    return list(map(str, numbers))


@pytest.mark.parametrize(
    ("heading", "numbers"),
    [
        ("Frame", _other_steps()),
        ("frame_id", [str(i % 32) for i in range(COUNT)]),
        ("SampleNumber", [str(i - (i > 9)) for i in range(COUNT)]),
        ("unnamed", [str(i + 3 * (i > 9)) for i in range(COUNT)]),
    ],
)
def test_numbers_of_samples_that_do_not_fit_are_noted(
    heading: str, numbers: list[str], tmp_path: Path
) -> None:
    path = written(tmp_path / "log.csv", text((heading, "angle (deg)"), numbers, ANGLE))
    log = read_log(path, rate=250.0)
    np.testing.assert_allclose(log.series["time"], np.arange(COUNT) / 250.0, rtol=0, atol=1e-12)
    (note,) = [one for one in log.notes if "does not count on at row" in one]
    assert note.startswith(repr(heading))


@pytest.mark.parametrize(("delay", "notes"), [(0.1, 1), (0.0, 0)])
def test_a_quantity_with_another_clock_is_noted(delay: float, notes: int, tmp_path: Path) -> None:
    headings = ("X_Value", "Angle (deg)", "X_Value", "Torque (N.m)")
    path = written(tmp_path / "log.csv", text(headings, TIME, ANGLE, TIME + delay, TORQUE))
    log = read_log(path, columns={"time": "X_Value #1"}, units={"time": "s"})
    found = [note for note in log.notes if "another clock" in note]
    assert len(found) == notes
    for note in found:
        behind = "'Torque (N.m)' stands behind 'X_Value #3', another clock"
        assert note == f"{behind}, but is read at the times of 'X_Value #1'"


@pytest.mark.parametrize("lost", [0, 1])
def test_a_sample_or_a_separator_is_lost_among_lines_with_empty_ones_between(
    lost: int, tmp_path: Path
) -> None:
    lines = text(("angle (deg)", "remark (V)"), ANGLE, TORQUE).splitlines()
    spaced = [line for one in lines for line in (one, "")]
    del spaced[40 : 40 + (2 if lost else 0)]
    if lost:
        spaced[40:40] = ["", ""]
    else:
        del spaced[39]
    log = read_log(written(tmp_path / "log.csv", "\n".join(spaced)), rate=250.0)
    assert len(log.series["time"]) == COUNT - lost
    assert log.series["time"][-1] == pytest.approx((COUNT - 1) / 250.0)


@pytest.mark.parametrize("heading", ["Drehmoment/kgf.cm", "Drehmoment (kgf.cm)", "force/dyn", "T/gf.cm"])
def test_a_torque_or_force_with_a_unit_that_is_not_known_is_noted(heading: str, tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", text(("time (s)", "angle (deg)", heading), TIME, ANGLE, TORQUE))
    log = read_log(path)
    assert {*log.series} == {"time", "theta"}
    assert f"{heading!r} is left alone: --column and --unit say what it is" in log.notes


@pytest.mark.parametrize(
    "content",
    [
        "time (ms),angle (deg)\n0,20,00\n10,18,54\n20,-0,52\n30,1,25\n",
        "time (ms),angle (deg)\n0,3,18.00\n10,3,17.70\n20,2,15.20\n",
        "time (ms),angle (deg)\n0,0,18.0 deg\n10,1,17.7 deg\n20,2,15.2 deg\n",
        "time (ms),angle (deg),\n0,20,00,\n10,18,54,\n20,-0,52,\n30,1,25,\n",
        "time (ms),angle (deg),Unnamed: 2\n0,20,00\n10,18,54\n20,-0,52\n30,1,25\n",
        '"angle (deg)","torque (N.m)"\n"1",20.0,0.5\n"2",18.5,0.5\n"3",15.5,0.5\n',
    ],
)
def test_cells_under_no_heading_are_refused(content: str, tmp_path: Path) -> None:
    """Decimal commas between commas, and the numbers of rows that R writes."""
    with pytest.raises(RecordError, match=r"row 2: has [34] cells under 2 headings; .* decimal marks commas"):
        read_log(written(tmp_path / "log.csv", content), rate=100.0)


def test_an_empty_cell_under_no_heading_is_left_out(tmp_path: Path) -> None:
    content = text(("time (s)", "angle (deg)"), TIME, ANGLE).replace("\n", ",\n").replace(",\n", "\n", 1)
    assert len(read_log(written(tmp_path / "log.csv", content)).series["time"]) == COUNT
