"""``pyjoystick parameters``, and ``--parameters`` of the other commands."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    read_parameter_file,
    read_parameters,
    write_parameters,
)
from pyjoystick.runs import read_sweep
from tests.pyjoystick.cli.conftest import Command

RECORD = Path(__file__).parents[3] / "scenarios" / "data" / "synthetic_constant_1.csv"


@pytest.fixture
def heavy(tmp_path: Path) -> Path:
    """A file of another joystick, which has constant damping only."""
    path = tmp_path / "heavy.toml"
    write_parameters(path, NOMINAL.replace({"J": 0.02, "damping.C": 0.06}))
    text = path.read_text(encoding="utf-8")
    path.write_text(text[: text.index("[damping.power-law]")], encoding="utf-8")
    return path


def test_it_prints_the_shipped_file(command: Command) -> None:
    outcome = command("parameters")
    assert (outcome.code, outcome.out) == (0, PAPER.path.read_text(encoding="utf-8"))


def test_it_writes_a_file_with_changes_and_replaces_none(command: Command, tmp_path: Path) -> None:
    arguments = ("parameters", "--set", "J=0.012", "--damping", "power-law", "-o", "mine.toml")
    assert command(*arguments).code == 0
    assert read_parameters(tmp_path / "mine.toml") == NOMINAL_POWER_LAW.replace({"J": 0.012})
    assert read_parameter_file(tmp_path / "mine.toml").title == "mine"  # no longer the paper's joystick
    refused = command(*arguments)
    assert (refused.code, refused.message) == (
        1,
        "cannot write mine.toml: it exists; --overwrite replaces it",
    )
    assert command("parameters", "-o", "mine.toml", "--overwrite").code == 0
    assert read_parameters(tmp_path / "mine.toml") == NOMINAL


def test_a_mistake_in_the_file_is_named(command: Command, heavy: Path) -> None:
    heavy.write_text(heavy.read_text(encoding="utf-8").replace("J = 0.02", "J = 0"), encoding="utf-8")
    outcome = command("parameters", "-p", "heavy.toml")
    expected = "heavy.toml: [body] J = 0: must be a finite number above 0 kg.m2"
    assert (outcome.code, outcome.message) == (1, expected)


def test_a_run_of_a_file_is_the_run_with_its_values_set(command: Command, heavy: Path) -> None:
    by_file = command("free-oscillation", "-p", "heavy.toml").out
    assert by_file == command("free-oscillation", "--set", "J=0.02", "--set", "damping.C=0.06").out
    assert by_file != command("free-oscillation").out


def test_set_goes_before_the_file(command: Command, heavy: Path) -> None:
    by_both = command("free-oscillation", "-p", "heavy.toml", "--set", "J=0.01135", "-s", "damping.C=0.045")
    assert by_both.out == command("free-oscillation").out


def test_a_law_that_the_file_lacks(command: Command, heavy: Path) -> None:
    for arguments in (["--damping", "power-law"], ["--fmu", "JoystickPowerLaw"]):
        outcome = command("free-oscillation", "-p", "heavy.toml", *arguments)
        expected = "heavy.toml: [damping.power-law]: is missing (it has those of the law constant)"
        assert (outcome.code, outcome.message) == (1, expected)


def test_the_law_is_that_of_the_file(command: Command, tmp_path: Path) -> None:
    write_parameters(tmp_path / "law.toml", NOMINAL_POWER_LAW)
    assert command("free-oscillation", "-p", "law.toml").out.startswith("JoystickPowerLaw.fmu")
    assert command("free-oscillation", "-p", "law.toml", "--damping", "constant").out.startswith(
        "Joystick.fmu"
    )


def test_the_fmu_of_a_file_agrees_with_the_reference(command: Command, heavy: Path) -> None:
    """Both take the file: the FMU by the names of its parameters, the reference by its own."""
    assert command("compare", "-p", "heavy.toml", "-d", "0.3").code == 0


def test_two_fmus_with_a_file(command: Command, heavy: Path) -> None:
    arguments = ("compare", "Joystick", "Joystick", "-a", "10", "-d", "0.1", "--interface", "cs")
    assert command(*arguments, "-p", "heavy.toml").code == 0
    refused = command("compare", "JoystickPowerLaw", "JoystickPowerLaw", "-p", "heavy.toml")
    assert "[damping.power-law]: is missing" in refused.message


def test_peaks_take_the_inertia_of_the_file(command: Command, heavy: Path) -> None:
    by_file = command("peaks", str(RECORD), "-p", "heavy.toml")
    assert by_file.code == 0
    by_option = command("peaks", str(RECORD), "--set", "J=0.02", "--set", "damping.C=0.06")
    assert by_file.out == by_option.out


def test_a_fit_takes_the_file(command: Command, heavy: Path, tmp_path: Path) -> None:
    assert command("fit", str(RECORD), "-p", "heavy.toml", "-o", "by_file").code in (0, 3)
    settings = json.loads((tmp_path / "by_file" / "fit.json").read_text())["settings"]
    assert settings["fixed"]["J"] == 0.02
    (start,) = [one["start"] for one in settings["free"] if one["name"] == "damping.C"]
    assert start == 0.06


def test_a_sweep_of_a_file(command: Command, heavy: Path, tmp_path: Path) -> None:
    settings = """
[fmu]
path = "Joystick"
{file}
[experiment]
duration = 0.3
[parameters]
theta_start = -0.3
{values}
[vary.m]
values = [0.5, 0.87]
[sampling]
method = "grid"
[[results]]
variable = "E"
kind = "loss"
"""
    (tmp_path / "by_file.toml").write_text(settings.format(file='parameters = "heavy.toml"', values=""))
    (tmp_path / "by_value.toml").write_text(settings.format(file="", values='J = 0.02\n"damping.C" = 0.06'))
    for name in ("by_file", "by_value"):
        outcome = command("sweep", f"{name}.toml")
        assert outcome.code == 0, outcome.err
    losses = [read_sweep(tmp_path / f"{name}.csv")["E.loss"] for name in ("by_file", "by_value")]
    assert len(losses[0]) == 2
    # The springs of the file are computed from x and k, those of the FMU are its own: equal to rounding.
    assert losses[0].to_numpy() == pytest.approx(losses[1].to_numpy(), rel=1e-12)
