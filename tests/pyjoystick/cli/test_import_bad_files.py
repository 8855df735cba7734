"""Faulty files are reported in one line: file, column, row, and what to do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import BASE, TOP, synthetic_markers
from pyjoystick.model import FORWARD_TABLE
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.laboratory.load_curve.machine import cycle, write
from tests.pyjoystick.laboratory.measurements.c3d_writer import write_c3d
from tests.pyjoystick.laboratory.measurements.made import nexus_text, plain_text, swing

TIME = np.arange(180) / 60.0
SEEN = synthetic_markers(TIME, swing(TIME), random=np.random.default_rng(1))
POINTS = 1e3 * SEEN.positions
NEXUS, PLAIN = nexus_text(POINTS), plain_text(TIME, POINTS)
CURVE = "# synthetic\ntravel (mm);force (N)\n" + "".join(f"{i / 100};{i % 7}.5\n" for i in range(90))
MARKERS = ("markers", "bad", "--top", TOP, "--base", *BASE, "-o", "record.csv")


def _row(text: str, number: int, new: str) -> str:
    lines = text.splitlines()
    lines[number - 1] = new
    return "\n".join([*lines, ""])


def _refused(command: Command, arguments: tuple[str, ...], file: str, words: tuple[str, ...]) -> None:
    outcome = command("import", *(file if one == "bad" else one for one in arguments))
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.message.startswith(file)
    for word in words:
        assert word in outcome.message
    assert not Path("record.csv").exists()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (PLAIN.replace(",", " "), ("row 1", "no column 'time'", "separate the columns by commas")),
        (PLAIN.replace(",", ";").replace(".", ","), ("'time (s)'", "row 3", "decimal point")),
        (NEXUS.replace(",", ";").replace(".", ","), ("'Joystick:TOP X'", "row 11", "not commas")),
        (PLAIN.replace("TOP", "TIP"), ("no marker 'TOP'", "did you mean TIP?")),
        (PLAIN.replace("(mm)", "(ft)"), ("'TOP x (ft)'", "unknown unit", "known are m, cm, mm")),
        (_row(PLAIN, 9, PLAIN.splitlines()[5]), ("'time'", "row 9", "does not increase")),
        (_row(NEXUS, 20, NEXUS.splitlines()[14]), ("'Frame'", "row 20", "does not come after")),
        ("", ("has no headings", "begin with one line of column names and units, such as time (s)")),
    ],
)
def test_markers_as_text(command: Command, text: str, words: tuple[str, ...]) -> None:
    Path("bad.csv").write_text(text, encoding="utf-8")
    _refused(command, MARKERS, "bad.csv", words)


def test_c3d_files(command: Command) -> None:
    write_c3d(Path("whole.c3d"), SEEN.names, POINTS, rate=60.0)
    Path("cut.c3d").write_bytes(Path("whole.c3d").read_bytes()[:-5000])
    words = ("rows 76-180", "declares 180 frames and has", "copy or export the file again")
    _refused(command, MARKERS, "cut.c3d", words)
    write_c3d(Path("unit.c3d"), SEEN.names, POINTS, rate=60.0, unit="inch")
    _refused(command, MARKERS, "unit.c3d", ("'POINT:UNITS'", "unknown unit", "'inch'", "known are m, cm, mm"))
    Path("text.c3d").write_text(PLAIN, encoding="utf-8")
    _refused(command, MARKERS, "text.c3d", ("is not a C3D file", "export it again"))
    _refused(command, MARKERS, "none.c3d", ("cannot be read: No such file", "check the path"))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (CURVE.replace("(N)", "(dyn)"), ("'force (dyn)'", "unknown unit", "N, kN, mN")),
        (_row(CURVE, 60, "0.10;3.5"), ("'travel'", "rows 60-61", "jumps", "wrong")),
        (_row(CURVE, 40, ";3.5"), ("'travel (mm)'", "row 40")),
    ],
)
def test_load_curves(command: Command, text: str, words: tuple[str, ...]) -> None:
    Path("bad.csv").write_text(text, encoding="utf-8")
    _refused(command, ("load-curve", "bad"), "bad.csv", words)


def test_slack_in_a_load_curve_is_a_note_with_its_rows(command: Command) -> None:
    write(Path("slack.csv"), *cycle(FORWARD_TABLE, 6, slack=(1.5e-3, 0.05e-3)))
    outcome = command("import", "load-curve", "slack.csv")
    assert outcome.code == 0
    (note,) = [line for line in outcome.err.splitlines() if "look there for slack" in line]
    assert note.startswith("slack.csv: ")
    assert "most in rows " in note


def test_a_saturated_accelerometer_is_a_note_with_its_rows(command: Command) -> None:
    Path("whole.csv").write_text(PLAIN, encoding="utf-8")
    assert command("import", "markers", "whole.csv", *MARKERS[2:]).code == 0
    time = np.arange(5400) / 1800.0
    reading = np.clip(40.0 * np.cos(4.0 * np.pi * time), -30.0, 30.0)
    lines = [f"{t:.9g},{a:.6g}" for t, a in zip(time, reading, strict=True)]
    Path("clipped.csv").write_text("\n".join(["time (s),acceleration (m/s2)", *lines, ""]), encoding="utf-8")
    outcome = command("import", "accelerometer", "clipped.csv", "--angle", "record.csv", "--distance", "0.25")
    assert outcome.code == 0
    (note,) = [line for line in outcome.err.splitlines() if "saturated" in line]
    assert note.startswith("clipped.csv: ")
    assert "row" in note
    backward = "\n".join(["time (s),acceleration (m/s2)", *lines[:30], lines[10], *lines[30:], ""])
    Path("back.csv").write_text(backward, encoding="utf-8")
    outcome = command("import", "accelerometer", "back.csv", "--angle", "record.csv", "--distance", "0.25")
    assert outcome.code == 1
    for words in ("back.csv, column 'time', row 32", "the time does not increase"):
        assert words in outcome.message
