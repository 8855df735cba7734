"""``pyjoystick response``."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from tests.pyjoystick.cli.conftest import Command


def test_the_motions_at_one_frequency(command: Command, tmp_path: Path) -> None:
    outcome = command("response", "--json", "r.json", "--plot", "r.png")
    assert outcome.code == 0
    assert "| periodic, T |               25.57 |" in outcome.out
    assert "| chaotic" in outcome.out
    assert "motions that did not become periodic are listed without a period" in outcome.err
    content = json.loads((tmp_path / "r.json").read_text())
    large, small = content["attractors"]
    assert large["exponents"][0][0] == pytest.approx(-0.5 * 0.045 / 0.01135, rel=1e-6)
    assert small["kind"] == "chaotic"
    assert small["exponent"] > 3.0 * small["exponent_error"]
    assert small["trusted_until"] < 4.0
    assert (tmp_path / "r.png").stat().st_size > 1e4


def test_releases_at_several_speeds(command: Command, tmp_path: Path) -> None:
    outcome = command(
        "response", "--torque", "12", "--frequency", "6", "--speed=-6", "--speed", "0", "--json", "r.json"
    )
    assert outcome.code == 0, outcome.err
    releases = pd.DataFrame(json.loads((tmp_path / "r.json").read_text())["releases"])
    assert releases.groupby("omega")["theta"].nunique().to_dict() == {-6.0: 16, 0.0: 16}


def test_branches_over_a_parameter(command: Command, tmp_path: Path) -> None:
    options = ("--torque", "12", "--frequency", "6", "--vary", "torque", "11.9", "12")
    outcome = command("response", *options, "--csv", "r.csv", "--plot", "r.svg")
    assert outcome.code == 0, outcome.err
    assert "| branch |" in outcome.out
    table = pd.read_csv(tmp_path / "r.csv")
    assert table["torque"].between(11.89, 12.01).all()
    assert (table["stable"]).any()
    assert "</svg>" in (tmp_path / "r.svg").read_text()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--torque", "0"), r"torque = 0.0: must be a finite number above 0 N.m"),
        (("--set", "friction.T_c=0.01"), "no derivatives to search by"),
        (("--vary", "frequency", "5", "3"), "the first below the second"),
        (("--vary", "damping.D", "0", "1"), "there is no parameter 'damping.D'"),
        (("--vary", "frequency", "3", "20000"), "--vary frequency = 20000.0: must be from 0.1 to 200"),
        (("--vary", "J", "0.01", "11.35"), "--vary J = 11.35"),
    ],
)
def test_what_cannot_be_searched_is_refused(command: Command, options: tuple[str, ...], message: str) -> None:
    outcome = command("response", *options)
    assert outcome.code == 1
    assert message in outcome.message


def test_branches_need_a_range(command: Command) -> None:
    outcome = command("response", "--csv", "r.csv")
    assert outcome.code == 2
    assert "needs --vary" in outcome.err


@pytest.mark.parametrize(
    "setting", [("--frequency", "20000"), ("--frequency", "1e-6"), ("--speed", "1e7"), ("--torque", "1e9")]
)
def test_what_no_joystick_can_do_is_refused(setting: tuple[str, str], command: Command) -> None:
    outcome = command("response", *setting)
    assert outcome.code == 2
    assert "Input should be" in outcome.err
