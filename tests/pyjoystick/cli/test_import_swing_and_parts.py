"""``pyjoystick import swing`` and ``pyjoystick import parts``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, read_parameter_file
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.laboratory.inertia.pendulum import swing
from tests.pyjoystick.laboratory.inertia.test_parts import FILE


def test_a_recorded_swing_goes_into_the_parameter_file(command: Command, tmp_path: Path) -> None:
    record = swing(1)
    lines = [f"{t:.6f},{angle:.5f}" for t, angle in zip(record.time, np.degrees(record.theta), strict=True)]
    (tmp_path / "swing.csv").write_text("\n".join(("time (s),theta (deg)", *lines)), encoding="utf-8")
    known = ("--uncertainty", "m=0.001", "--uncertainty", "h=0.0005", "--set", "m=0.871")
    outcome = command("import", "swing", "swing.csv", "-p", "joystick.toml", *known)
    assert outcome.code == 0, outcome.err
    assert "damping ratio 0.011" in outcome.out
    found = read_parameter_file(tmp_path / "joystick.toml")
    assert found.joystick.m == 0.871
    assert pytest.approx(NOMINAL.J * 0.871 / NOMINAL.m, rel=2e-4) == found.joystick.J
    assert found.uncertainties["body.m"] == 0.001
    expected = found.joystick.J * np.hypot(0.001 / 0.871, 0.0005 / NOMINAL.h)
    assert found.uncertainties["body.J"] == pytest.approx(expected, rel=0.02)
    assert found.sources["body"] == "swing test swing.csv"
    again = command("import", "swing", "swing.csv", "-p", "joystick.toml")
    assert again.code == 0
    assert "taken as exact" not in again.err


def test_stopwatch_readings(command: Command) -> None:
    readings = ("--time", "8.03", "--time", "8.07", "--time", "8.01", "--swings", "10")
    outcome = command("import", "swing", *readings, "--amplitude", "12deg", "--end-amplitude", "7deg")
    assert outcome.code == 0
    assert "from reaction" in outcome.out
    assert "Period 0.803667 s as measured" in outcome.out
    assert "m = 0.87 has no uncertainty and is taken as exact" in outcome.err


def test_parts_give_a_joystick(command: Command, tmp_path: Path) -> None:
    (tmp_path / "parts.csv").write_text(FILE, encoding="utf-8")
    outcome = command("import", "parts", "parts.csv", "-p", "joystick.toml")
    assert outcome.code == 0, outcome.err
    found = read_parameter_file(tmp_path / "joystick.toml")
    assert found.joystick.m == pytest.approx(0.87)
    assert found.uncertainties["body.m"] == pytest.approx(0.0023)
    assert found.sources["body"] == "parts parts.csv"


def test_wrong_usage(command: Command) -> None:
    assert command("import", "swing").code == 2
    assert command("import", "swing", "--time", "8").code == 2
    refused = command("import", "swing", "--time", "8", "--amplitude", "10", "--set", "J=1")
    assert (refused.code, refused.message) == (1, "J = 1.0: must be one of m, h, g")


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (("--set", "h=-0.1"), 1, "h = -0.1: must be a finite number above 0 m"),
        (("--set", "m=-1"), 1, "m = -1.0: must be a finite number above 0 kg"),
        (("--set", "m=-1", "--set", "h=-0.1"), 1, "m = -1.0: must be a finite number above 0 kg"),
        (("--set", "g=-9.8"), 1, "g = -9.8: must be a finite number above 0 m/s2"),
        (("--amplitude-uncertainty", "-1deg"), 2, "--amplitude-uncertainty: '-1deg' must be 0deg or more"),
        (("--amplitude", "-5deg"), 2, "--amplitude: '-5deg' must be 0deg or more"),
        (("--time", "0"), 1, "--time = 0.0: must be a finite number above 0 s"),
    ],
)
def test_what_a_swing_cannot_have_is_refused(
    command: Command, options: tuple[str, ...], code: int, words: str
) -> None:
    outcome = command("import", "swing", "--time", "0.81", "--amplitude", "10deg", *options)
    assert outcome.code == code
    assert words in outcome.err


@pytest.mark.parametrize("time", ["1e300", "1e-300"])
def test_a_time_that_no_swing_takes_is_refused(command: Command, time: str) -> None:
    outcome = command("import", "swing", "--time", time, "--amplitude", "10deg", "--reaction-time", "0")
    assert outcome.code == 1
    assert "must be between 0.001 and 10000 s for 1 swing" in outcome.err


def test_forgotten_swings_and_options_without_effect_are_refused(command: Command, tmp_path: Path) -> None:
    outcome = command("import", "swing", "--time", "8.03", "--amplitude", "10deg")
    assert outcome.code != 0
    told = "radius of gyration = 1.144: must be below 1 m, as a joystick's is (how many --swings?)"
    assert told in outcome.err
    for option in (("--swings", "10"), ("--amplitude", "10deg"), ("--reaction-time", "0.1")):
        outcome = command("import", "swing", "pendulum.csv", *option)
        assert outcome.code == 2
        assert option[0] in outcome.err
