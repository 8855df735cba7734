"""``pyjoystick import record``: from a laboratory's table to a record; other commands read such tables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.motion import read_record
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.motion.logs.made import ANGLE, TIME, TORQUE, text, written
from tests.pyjoystick.motion.records.made import motion

GERMAN = text(
    ("Zeit [ms]", "Winkel [Grad]", "Drehmoment [Nm]"), 1e3 * TIME, ANGLE, TORQUE, delimiter=";", decimal=","
)


def test_a_table_becomes_a_record(tmp_path: Path, command: Command) -> None:
    log, record = written(tmp_path / "log.csv", GERMAN, "latin-1"), tmp_path / "record.csv"
    result = command("import", "record", str(log), "--output", str(record), "--from", "0.1", "--to", "0.4")
    assert result.code == 0, result.err
    assert "'Winkel [Grad]', in deg" in result.out
    lines = record.read_text(encoding="utf-8").splitlines()
    assert lines[0] == (
        "# from log.csv: time from 'Zeit [ms]' in ms, theta from 'Winkel [Grad]' in deg, T from "
        "'Drehmoment [Nm]' in N.m"
    )
    assert lines[1] == "time (s),theta (rad),T (N.m)"
    found = read_record(record, free_oscillation=False)
    inside = (TIME >= 0.1) & (TIME <= 0.4)
    np.testing.assert_allclose(found.time, TIME[inside], atol=1e-12)
    np.testing.assert_allclose(found.theta, np.radians(ANGLE[inside]), atol=1e-11)


def test_a_clock_since_1970_keeps_its_digits(tmp_path: Path, command: Command) -> None:
    log = written(
        tmp_path / "log.csv", text(("timestamp [s]", "angle [deg]"), 1.7e9 + TIME, ANGLE, digits=17)
    )
    record = tmp_path / "record.csv"
    result = command("import", "record", str(log), "--output", str(record))
    assert "1700000000 to 1700000000.476" in result.out
    found = read_record(record, free_oscillation=False)
    np.testing.assert_array_equal(found.time, 1.7e9 + TIME)


def test_the_rate_is_that_of_rounded_times_and_not_of_gaps(tmp_path: Path, command: Command) -> None:
    """240 Hz in whole milliseconds are steps of 4 and 5 ms."""
    time = np.round(1e3 * np.arange(len(ANGLE)) / 240.0)
    kept = (time < 200.0) | (time > 400.0)
    log = written(tmp_path / "log.csv", text(("time (ms)", "angle (deg)"), time[kept], ANGLE[kept]))
    result = command("import", "record", str(log), "--output", str(tmp_path / "r.csv"), "--json", "-")
    assert json.loads(result.out)["rate"] == pytest.approx(240.0, rel=0.005)


def test_a_given_rate_in_place_of_times_is_noted(tmp_path: Path, command: Command) -> None:
    log = written(tmp_path / "log.csv", GERMAN)
    result = command("import", "record", str(log), "-o", "r.csv", "--samples-per-second", "500")
    assert result.code == 0
    assert "'Zeit [ms]' is left alone: the samples are 500 per second, as given" in result.err
    assert "left alone" not in command("import", "record", str(log), "-o", "r2.csv").err


def test_a_preview_comes_before_anything_is_written(tmp_path: Path, command: Command) -> None:
    log, figure = written(tmp_path / "log.csv", GERMAN), tmp_path / "log.svg"
    assert command("import", "record", str(log), "--preview", str(figure)).code == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["log.csv", "log.svg"]
    assert "give --output, --preview or both" in command("import", "record", str(log)).err
    assert "is the table itself" in command("import", "record", str(log), "-o", str(log)).err
    assert log.read_text(encoding="utf-8") == GERMAN


def test_readings_are_calibrated(tmp_path: Path, command: Command) -> None:
    counts, volts = np.round(ANGLE / 0.01) + 2048.0, 1e3 * (2.5 + TORQUE / 4.0)
    log = written(
        tmp_path / "log.csv", text(("t/s", "Winkel", "Moment (mV)"), TIME, counts, volts, digits=12)
    )
    record = tmp_path / "record.csv"
    arguments = ["import", "record", str(log), "-o", str(record)]
    result = command(*arguments)
    assert result.code == 1
    assert "--scale T=NUMBERN.m/mV" in result.err or "--unit theta=" in result.err
    scales = [
        "--scale",
        "theta=0.01deg/count",
        "--scale",
        "T=4N.m/V",
        "--zero",
        "theta=2048",
        "--zero",
        "T=2.5",
    ]
    assert command(*arguments, *scales).code == 0
    table = np.loadtxt(record, delimiter=",", skiprows=2)
    np.testing.assert_allclose(table[:, 1], np.radians(0.01 * np.round(ANGLE / 0.01)), atol=1e-10)
    np.testing.assert_allclose(table[:, 2], TORQUE, atol=1e-9)
    for wrong in ("theta=0.01deg", "theta=deg/count", "T=4deg/V", "J=4deg/V", "theta=1deg/apple"):
        assert "must be NAME=FACTOR, such as" in command(*arguments, "--scale", wrong).err
    assert "theta has no --scale" in command(*arguments, "--zero", "theta=1").err
    # 20.48 deg is no reading: in rad, it would be taken for one of 0.357 counts.
    refused = command(*arguments, *scales, "--zero", "omega=20.48deg/s").message
    assert refused == "--zero omega = 20.48deg/s: must be a number without a unit"


def test_options_go_before_what_the_file_says(tmp_path: Path, command: Command) -> None:
    log = written(
        tmp_path / "log.csv", text(("time (s)", "angle (rad)", "phi (deg)"), 1e3 * TIME, ANGLE, -ANGLE)
    )
    record = tmp_path / "record.csv"
    options = ["--unit", "time=ms", "--unit", "theta=deg", "--column", "theta=angle (rad)", "-o", str(record)]
    result = command("import", "record", str(log), *options)
    assert result.code == 0, result.err
    assert "'time (s)' is read in ms, as given" in result.err
    np.testing.assert_allclose(
        read_record(record, free_oscillation=False).theta, np.radians(ANGLE), atol=1e-11
    )


def test_other_commands_read_the_same_tables(tmp_path: Path, command: Command) -> None:
    time, theta, _ = motion()
    german = text(("Zeit [s]", "Winkel [Grad]"), time, theta, delimiter=";", decimal=",", before="Stand 3\n")
    log = written(tmp_path / "log.csv", german, "utf-16")
    plain = written(tmp_path / "plain.csv", text(("time (s)", "theta (deg)"), time, theta))
    assert read_record(log).theta == pytest.approx(read_record(plain).theta, abs=1e-12)
    tables = [
        command("torque", str(path), "--csv", str(path.with_suffix(".torque.csv"))) for path in (log, plain)
    ]
    assert [table.code for table in tables] == [0, 0]
    assert log.with_suffix(".torque.csv").read_bytes() == plain.with_suffix(".torque.csv").read_bytes()
    markers = tmp_path / "trial.c3d"
    markers.write_bytes(b"\x02\x50" + bytes(600))
    for name in ("peaks", "torque", "fit"):
        result = command(name, str(markers))
        assert result.code == 1
        assert "pyjoystick import markers" in result.err
