"""``pyjoystick --verbose``: shows the package's log, which is silent by default."""

from __future__ import annotations

import logging
import re
import subprocess
import sys
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu
from tests.pyjoystick.cli.conftest import Command

RECORD = str(Path(__file__).parents[3] / "scenarios" / "data" / "synthetic_constant_1.csv")


def _records(text: str) -> list[tuple[str, str]]:
    """Logger and message of each line."""
    return re.findall(r"^(pyjoystick[.\w]*): (.*)$", text, re.MULTILINE)


def test_the_fmu_its_values_and_the_files_are_logged(command: Command, fmus_by_name: Path) -> None:
    command("parameters", "--set", "m=0.9", "-o", "heavy.toml")
    plain = command("free-oscillation", "-p", "heavy.toml", "--set", "J=0.012", "--csv", "a.csv")
    outcome = command("-v", "free-oscillation", "-p", "heavy.toml", "--set", "J=0.012", "--csv", "a.csv")
    assert (outcome.code, outcome.out) == (0, plain.out)
    found = _records(outcome.err)
    messages = [message for _, message in found]
    assert "read heavy.toml" in messages
    assert "wrote a.csv" in messages
    (fmu,) = (one for one in messages if one.startswith("opened "))
    assert fmu.startswith(
        f"opened {fmus_by_name / 'Joystick.fmu'}: PreloadedSprings.Joystick.Joystick, FMI 2.0"
    )
    assert "made by pyjoystick" in fmu
    (run,) = (one for one in messages if one.startswith("Joystick.fmu from 0 to 1.5 s, 1501 samples"))
    assert "set: J = 0.012, m = 0.9, theta_start = -0.349" in run
    assert len(found) < 10


def test_the_stages_of_a_fit_are_logged(command: Command) -> None:
    outcome = command("--verbose", "fit", RECORD)
    messages = [message for name, message in _records(outcome.err) if ".fitting." in name]
    beginnings = ["fit of 4 values to 1 records: damping.C", "searched: 1 minima", "noise, round 1"]
    beginnings += ["judged: 10 checks, failed: none", "fitted with "]
    assert all(any(one.startswith(begin) for one in messages) for begin in beginnings), messages
    assert any(message.startswith(f"read {RECORD}: ") for _, message in _records(outcome.err))
    assert len(_records(outcome.err)) < 20


def test_twice_verbose_logs_all_runs(command: Command) -> None:
    once, twice = (command(option, "fit", RECORD).err for option in ("-v", "-vv"))
    assert "varied: damping.C" in twice
    assert "varied: damping.C" not in once
    assert len(_records(twice)) > len(_records(once))


def test_the_log_ends_with_the_call(command: Command) -> None:
    package = logging.getLogger("pyjoystick")
    before = package.handlers[:], package.level
    assert _records(command("-v", "free-oscillation").err)
    assert (package.handlers, package.level) == before
    assert command("free-oscillation").err == ""
    assert command("-v", "free-oscillation", "--set", "J=-1").code == 1
    assert (package.handlers, package.level) == before


def test_a_library_is_silent() -> None:
    """Without a handler, Python prints warnings and errors of loggers: there are none."""
    program = "import pyjoystick; pyjoystick.free_oscillation(-0.3)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


def test_programs_can_listen(caplog: pytest.LogCaptureFixture, fmus_by_name: Path) -> None:
    with caplog.at_level(logging.INFO, logger="pyjoystick"), Fmu("Joystick") as fmu:
        fmu.run([0.0, 0.1])
        fmu.run([0.0, 0.1], parameters={"theta_start": 0.2, "m": 0.9})
    assert {one.levelno for one in caplog.records} == {logging.INFO}
    assert "set: theta_start = 0.2, m = 0.9" in caplog.text
    assert "set: nothing" in caplog.text
