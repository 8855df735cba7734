"""Implausible values, most likely in another unit, prompt a question."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.laboratory import BASE, TOP
from pyjoystick.model import NOMINAL, PAPER, read_parameters, write_parameters
from tests.pyjoystick.cli.conftest import Command

SWING = ("import", "swing", "--time", "8.09", "--swings", "10", "--amplitude", "10")
CURVE = ("import", "load-curve", "none.csv")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("free-oscillation", "--set", "a=24.1"), "a = 24.1: must be between 0.001 and 0.5 m"),
        (("free-oscillation", "--set", "a=24.1"), "did you mean 24.1 mm = 0.0241 m?"),
        (("free-oscillation", "--set", "J=11.35"), "did you mean 11.35 g.m2 = 0.01135 kg.m2?"),
        (("torque", "--set", "m=870"), "did you mean 870 g = 0.87 kg?"),
        (("parameters", "--set", "b=0.5", "--set", "h=8.2"), "did you mean 8.2 cm = 0.082 m?"),
        (("peaks", "none.csv", "--set", "damping.C=45"), "did you mean 45 mN.m.s/rad = 0.045 N.m.s/rad?"),
        (("report", "-o", "a.html", "--set", "g=981"), "g = 981.0: must be between 0.01 and 30 m/s2"),
        (("compare", "--set", "forward.returnSpring.k_s=2.6"), "did you mean 2.6 N/mm = 2600 N/m?"),
        (("compare", "Joystick", "Joystick", "--set", "a=24.1"), "did you mean 24.1 mm = 0.0241 m?"),
        ((*SWING, "--set", "h=82"), "did you mean 82 mm = 0.082 m?"),
        ((*SWING, "--uncertainty", "m=1"), "--uncertainty m = 1.0: must be below a third of m = 0.87"),
        (("import", "swing", "--time", "809", "--amplitude", "10"), "J = "),
        ((*CURVE, "--travel-noise", "0.001"), "did you mean 0.001 mm = 1e-06 m?"),
        (("torque", "--pivot-to-handle", "266"), "--pivot-to-handle = 266.0: must be between 0.005 and 2 m"),
        (
            ("import", "accelerometer", "none.csv", "--angle", "none.csv", "--distance", "250"),
            "--distance = 250.0: must be between 0.005 and 2 m",
        ),
        (
            (
                "import",
                "markers",
                "none.c3d",
                "--top",
                TOP,
                "--base",
                *BASE,
                "--radius",
                "266",
                "-o",
                "r.csv",
            ),
            "--radius = 266.0: must be between 0.005 and 2 m, as a joystick's is "
            "(did you mean 266 mm = 0.266 m?",
        ),
    ],
)
def test_it_is_refused_by_name_with_what_was_probably_meant(
    command: Command, tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    outcome = command(*arguments)
    assert (outcome.code, outcome.out) == (1, "")
    error = outcome.err.splitlines()[-1]
    assert words in error
    assert "pyjoystick --implausible COMMAND accepts it" in error
    assert list(tmp_path.iterdir()) == []


def test_who_insists_gets_it_and_so_does_who_reads_the_file(command: Command, tmp_path: Path) -> None:
    outcome = command("--implausible", "parameters", "--set", "J=11.35", "-o", "heavy.toml")
    assert outcome.code == 0, outcome.err
    assert read_parameters(tmp_path / "heavy.toml").J == 11.35
    assert command("parameters", "-p", "heavy.toml").code == 0
    assert command("parameters", "-p", "heavy.toml", "--set", "J=12").code == 1


def test_a_file_that_insists_is_updated_and_goes_on_insisting(command: Command, tmp_path: Path) -> None:
    write_parameters(tmp_path / "a.toml", NOMINAL.replace({"a": 24.1}))
    (tmp_path / "parts.csv").write_text("part,mass (g),height (mm),inertia (g.cm2)\nrod,870,82,0\n")
    assert command("import", "parts", "parts.csv", "-p", "a.toml").code == 0
    found = read_parameters(tmp_path / "a.toml")
    assert (found.a, found.m) == (24.1, pytest.approx(0.87))


def test_parts_in_kilograms_that_are_grams(command: Command, tmp_path: Path) -> None:
    (tmp_path / "parts.csv").write_text("part,mass (kg),height (mm),inertia (g.cm2)\nrod,870,82,0\n")
    assert "m = 870.0: must be between" in command("import", "parts", "parts.csv").err


@pytest.mark.parametrize("angle", ["-0.35", "1.5"])
def test_an_angle_that_may_be_in_radians_is_asked_about(command: Command, angle: str) -> None:
    """It runs: the period at a degree and below is studied too."""
    outcome = command("free-oscillation", "-a", angle, "-d", "0.1")
    assert outcome.code == 0
    assert f"note: --release-angle {angle} is in degrees; in radians it is written {angle}rad" in outcome.err


@pytest.mark.parametrize("angle", ["-0.35deg", "-0.35rad", "-20", "1.6"])
def test_an_angle_that_says_its_unit_or_must_be_in_degrees_is_not(command: Command, angle: str) -> None:
    assert "written" not in command("free-oscillation", "-a", angle, "-d", "0.1").err


def test_the_paper_s_joystick_can_be_halved_and_doubled(command: Command) -> None:
    for name, value in {**NOMINAL.to_names(), **PAPER.with_law("power-law").to_names()}.items():
        for factor in (0.5, 1.0, 1.05, 2.0):
            outcome = command("parameters", "--set", f"{name}={factor * value!r}", "--damping", "power-law")
            assert "as a joystick's is" not in outcome.err


@pytest.mark.parametrize("given", ["-1", "nan", "inf"])
def test_an_uncertainty_is_no_less_than_zero(command: Command, tmp_path: Path, given: str) -> None:
    outcome = command(*SWING, "--uncertainty", f"m={given}", "-p", str(tmp_path / "u.toml"))
    assert outcome.code == 1
    assert f"--uncertainty m = {float(given)}: must be a finite number, 0 or more" in outcome.err
    assert not (tmp_path / "u.toml").exists()
