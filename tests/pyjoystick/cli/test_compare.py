"""``pyjoystick compare``."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.runs.experiments import COLUMNS
from tests.pyjoystick.cli.conftest import Command


def _row(out: str, name: str) -> list[str]:
    return next(line.split() for line in out.splitlines() if line.split()[:1] == [name])


@pytest.mark.parametrize(("law", "limit"), [("constant", "1.0e-07"), ("power-law", "7.0e-07")])
def test_every_variable_is_compared(command: Command, law: str, limit: str) -> None:
    outcome = command("compare", "--damping", law)
    assert (outcome.code, outcome.err) == (0, "")
    assert "free oscillation from -20 deg, 1.5 s, tolerance 1e-08" in outcome.out.splitlines()[0]
    for name in COLUMNS:
        assert _row(outcome.out, name)[0] == name
    theta = _row(outcome.out, "theta")
    assert theta[1] == "rad"
    assert 0.0 < float(theta[2]) < 1e-7
    assert theta[-2:] == [limit, "ok"]


def test_a_difference_above_its_limit_is_exit_code_1(command: Command) -> None:
    outcome = command("compare", "-d", "0.3", "--limit", "theta=1e-15", "--limit", "E=1")
    assert outcome.code == 1
    assert _row(outcome.out, "theta")[-1] == "exceeded"
    assert _row(outcome.out, "E")[-1] == "ok"
    assert outcome.err == ""


def test_settings_reach_both_sides(command: Command, fmus_by_name: Path) -> None:
    settings = ("-a", "12deg", "-d", "0.5", "--set", "damping.alpha=0.4", "--set", "m=0.5")
    outcome = command("compare", "--fmu", str(fmus_by_name / "JoystickPowerLaw.fmu"), *settings)
    assert outcome.code == 0
    assert _row(outcome.out, "theta")[-1] == "ok"


def test_a_coarse_tolerance_shows(command: Command) -> None:
    coarse, fine = (
        float(_row(command("compare", "-d", "0.5", "--tolerance", tolerance).out, "theta")[2])
        for tolerance in ("1e-4", "1e-10")
    )
    assert fine < coarse / 100.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--limit", "speed=1"), "there is no variable 'speed'; known are theta, omega"),
        (("--limit", "theta=0"), "limit of theta = 0.0: must be a finite number above 0 rad"),
        (("--limit", "theta=nan"), "limit of theta = nan: must be a finite number above 0 rad"),
        (("--set", "m=-1"), "m = -1.0: must be "),
        (("-d", "inf"), "duration = inf: must be "),
        (("--fmu", "nowhere.fmu"), "there is no FMU nowhere.fmu"),
    ],
)
def test_wrong_input_is_one_message(command: Command, arguments: tuple[str, ...], message: str) -> None:
    outcome = command("compare", *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert message in outcome.message


def test_degrees_given_for_radians(command: Command) -> None:
    outcome = command("compare", "-a", "-20rad")
    assert (outcome.code, outcome.out) == (2, "")
    assert "did you mean -20deg?" in outcome.err
