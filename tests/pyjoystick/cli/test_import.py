"""``pyjoystick import``: from markers and accelerometers to files that the other commands read."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import BASE, TOP, synthetic_acceleration, synthetic_markers
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import measured_peaks, read_record
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.laboratory.measurements.c3d_writer import write_c3d

RELEASE = math.radians(-20.0)
MARKERS = ("--top", TOP, "--base", *BASE)


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with trial.c3d, two frames lost in a peak and six later, and acceleration.csv, 0.02 s late."""
    folder = tmp_path_factory.mktemp("laboratory")
    random = np.random.default_rng(8)
    time = np.arange(5400) / 1800.0
    run = simulate(NOMINAL, time=time[450:], theta_start=RELEASE)
    theta, alpha = np.full(5400, RELEASE), np.zeros(5400)
    theta[450:], alpha[450:] = run.theta, run.alpha
    markers = synthetic_markers(time[::30], theta[::30], random=random)
    points = markers.positions * 1e3
    points[20:22, 0] = np.nan
    points[120:126, 0] = np.nan
    write_c3d(folder / "trial.c3d", markers.names, points, rate=60.0)
    reading = synthetic_acceleration(theta, alpha, distance=0.25, random=random)
    rows = "".join(f"{t + 0.02:.9g},{a:.6g}\n" for t, a in zip(time, reading, strict=True))
    (folder / "acceleration.csv").write_text(f"time (s),acceleration (m/s2)\n{rows}", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def record(laboratory: Path) -> Path:
    from pyjoystick.cli import main

    arguments = [
        "import",
        "markers",
        str(laboratory / "trial.c3d"),
        *MARKERS,
        "-o",
        str(laboratory / "r.csv"),
    ]
    assert main([*arguments, "--motion", str(laboratory / "m.csv")]) == 0
    return laboratory / "r.csv"


def test_the_record_is_one_that_the_other_commands_read(record: Path) -> None:
    measured = read_record(record, released="backward")
    assert len(measured.theta) == 172
    peaks = measured_peaks(measured)
    assert peaks.release_angle == pytest.approx(RELEASE, abs=3.0 * math.radians(0.2))
    exact = simulate(NOMINAL, time=np.arange(0.0, 1.5, 1e-3), theta_start=RELEASE)
    assert peaks.displacement["value"].iloc[0] == pytest.approx(exact.theta.max(), abs=math.radians(0.4))


def test_the_motion_has_velocity_acceleration_and_the_mark_of_bridged_gaps(record: Path) -> None:
    table = np.loadtxt(record.with_name("m.csv"), delimiter=",", skiprows=3)
    heading = record.with_name("m.csv").read_text(encoding="utf-8").splitlines()[2]
    assert heading == "time (s),theta (rad),omega (rad/s),alpha (rad/s2),bridged"
    bridged = table[table[:, 4] == 1.0, 0]
    assert 19 / 60 < bridged.min() < bridged.max() < 22 / 60
    assert np.max(np.diff(table[:, 0])) == pytest.approx(7 / 60, abs=1e-6)  # six frames lost: not bridged
    assert read_record(record.with_name("m.csv"), free_oscillation=False).omega is not None


def test_the_report_says_what_was_found(command: Command, laboratory: Path, tmp_path: Path) -> None:
    outcome = command(
        "import", "markers", str(laboratory / "trial.c3d"), *MARKERS, "-o", str(tmp_path / "r.csv")
    )
    assert outcome.code == 0
    for words in (
        "TOP 8, BASE1 0, BASE2 0",
        "180 at 60 Hz",
        "1.985 to 2.098 s",
        "Butterworth 4, 13 Hz",
        "11.65",
    ):
        assert words in outcome.out


def test_the_accelerometer_beside_the_angle(command: Command, record: Path, tmp_path: Path) -> None:
    file, result = str(record.with_name("acceleration.csv")), str(tmp_path / "alpha.csv")
    arguments = ("import", "accelerometer", file, "--angle", str(record), "--distance", "0.25")
    off = command(*arguments)
    assert "| add to the delay (s)" in off.out
    assert "+0.0200 |" in off.out
    outcome = command(*arguments, "--delay", "0.02", "-o", result)
    assert outcome.code == 0
    assert "+0.0000 |" in outcome.out
    assert len(np.loadtxt(result, delimiter=",", skiprows=2)) > 5000
    assert "-0.1200 |" in command(*arguments, "--delay", "0.14").out
    assert "opposes the angle" not in command(*arguments, "--delay", "0.07").err
    assert "opposes the angle" in command(*arguments, "--delay", "0.07", "--backward").err
    assert "add --backward" in command(*arguments, "--delay", "0.02", "--backward").err


def test_the_column_of_an_accelerometer_as_its_message_names_it(
    command: Command, record: Path, tmp_path: Path
) -> None:
    lines = record.with_name("acceleration.csv").read_text(encoding="utf-8").splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("time"))
    lines[head] = "time (s),a"
    file = tmp_path / "acceleration.csv"
    file.write_text("\n".join(lines), encoding="utf-8")
    arguments = ("import", "accelerometer", str(file), "--angle", str(record), "--distance", "0.25")
    assert "--column acceleration=HEADING" in command(*arguments).message
    named = (*arguments, "--column", "acceleration=a")
    assert "--unit acceleration=UNIT" in command(*named).message
    assert command(*named, "--unit", "acceleration=m/s2").code == 0


def test_a_wrong_sign_is_an_error_where_the_side_is_known(
    command: Command, laboratory: Path, tmp_path: Path
) -> None:
    arguments = ("import", "markers", str(laboratory / "trial.c3d"), *MARKERS, "-o", str(tmp_path / "r.csv"))
    outcome = command(*arguments, "--forward", "-x", "--released", "backward")
    assert outcome.code == 1
    assert "released forward instead of backward: wrong sign?" in outcome.message
    assert not (tmp_path / "r.csv").exists()


def test_zero_is_the_middle_of_the_clearance_where_the_side_of_rest_is_known(
    command: Command, laboratory: Path, record: Path
) -> None:
    arguments = ("import", "markers", str(laboratory / "trial.c3d"), *MARKERS, "-o", "leaning.csv")
    assert command(*arguments, "--rests", "forward").code == 2
    command("parameters", "--output", "paper.toml")
    assert command(*arguments, "--rests", "forward", "-p", "paper.toml").code == 0
    moved = read_record(Path("leaning.csv")).theta - read_record(record).theta
    # Without the cam surface, which adds 0.03 % to x_0/a.
    np.testing.assert_allclose(moved, 0.075e-3 / NOMINAL.a, rtol=1e-3)


@pytest.mark.parametrize(
    ("changes", "code", "words"),
    [
        (("--top", "TIP"), 1, "has no marker 'TIP'; did you mean TOP?"),
        (("--forward", "y"), 1, "is not along the direction called forward"),
        (("--cutoff", "400"), 1, "must be below half of the sampling rate"),
        (("--middle", "--radius", "0.266"), 2, "use --middle or --radius"),
        (("--released", "left"), 2, "'left' is not one of 'forward', 'backward'"),
    ],
)
def test_wrong_options_are_one_message(
    command: Command, laboratory: Path, tmp_path: Path, changes: tuple[str, ...], code: int, words: str
) -> None:
    arguments = ("import", "markers", str(laboratory / "trial.c3d"), *MARKERS, "-o", str(tmp_path / "r.csv"))
    outcome = command(*arguments, *changes)
    assert (outcome.code, outcome.out) == (code, "")
    assert words in outcome.err


def test_help_has_examples(command: Command) -> None:
    assert "pyjoystick import markers trial1.c3d" in command("import", "markers", "--help").out
    assert "--distance 0.25" in command("import", "accelerometer", "--help").out
