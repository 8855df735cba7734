"""docs/your-joystick.md, typed as it is printed: what comes out is what was put in."""

from __future__ import annotations

import json
import math
import os
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.model import ParameterFile, read_parameter_file, simulate
from pyjoystick.motion import read_record
from tests.scenarios.scripts import load

PAGE = (Path(__file__).parents[1] / "docs" / "your-joystick.md").read_text(encoding="utf-8")
#: The file of the fit, and the commands with their continuation lines, in the order of the page.
BLOCKS = re.compile(r"^```toml\n(?P<toml>(?:.*\n)*?)```$|^    (?P<command>\S(?:.*\\\n)*.*)$", re.MULTILINE)
#: The standard normal deviate of a 95 % interval.
Z = 1.96


def _carry_out(command: str) -> None:
    """A line of the page, in this process. One that ends in ``# refused`` must be."""
    program, *arguments = shlex.split(command, comments=True)
    if program == "cd":
        os.chdir(arguments[0])
    elif program == "python":
        name = arguments[0].removeprefix("scenarios/").removesuffix(".py")
        assert load(name).main(*map(Path, arguments[1:])) == 0
    elif program == "pyjoystick":
        assert main(arguments) == (1 if command.endswith("# refused") else 0), command
    else:
        assert command == ". .venv/bin/activate"


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory, joystick_fmus: Path) -> Iterator[Path]:
    """The folder in which the page ends."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pyjoystick.fmu.files.build_folder", lambda: joystick_fmus)
        patch.chdir(tmp_path_factory.mktemp("your_joystick"))
        for block in BLOCKS.finditer(PAGE):
            if block["toml"]:
                Path("fit.toml").write_text(block["toml"], encoding="utf-8")
            else:
                _carry_out(block["command"].replace("\\\n", " "))
        yield Path.cwd()


@pytest.fixture(scope="module")
def truth(laboratory: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((laboratory / "truth" / "truth.json").read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="module")
def found(laboratory: Path) -> ParameterFile:
    return read_parameter_file(laboratory / "joystick.toml")


def test_body_and_damping_are_within_their_intervals(truth: dict[str, Any], found: ParameterFile) -> None:
    places = {"m": "body.m", "h": "body.h", "J": "body.J", "damping.C": "damping.constant.C"}
    for name, place in places.items():
        true, value = truth["parameters"][name], found.joystick.to_names()[name]
        assert abs(value - true) <= Z * found.uncertainties[place], name
        assert found.uncertainties[place] < 3e-3 * true, name


@pytest.mark.parametrize("side", ["forward", "backward"])
@pytest.mark.parametrize("key", ["x", "k"])
def test_curves_are_within_their_intervals(
    truth: dict[str, Any], found: ParameterFile, side: str, key: str
) -> None:
    values = getattr(found.curves[side], key)  # type: ignore[index]  # one of the two sides
    for i, (value, true) in enumerate(zip(values, truth["curves"][side][key], strict=True)):
        assert abs(value - true) <= Z * found.uncertainties[f"{side}.{key}[{i}]"], i


def test_geometry_is_what_was_set_and_every_table_says_where_it_is_from(found: ParameterFile) -> None:
    assert (found.joystick.a, found.joystick.b) == (0.0241, 0.0051)
    files = {"forward": "synthetic_forward.csv", "backward": "synthetic_backward.csv", "body": "trial_1.csv"}
    for table, file in files.items() | {("damping.constant", "trial_4.csv")}:
        assert file in found.sources[table]


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_theta_is_within_the_noise(laboratory: Path, truth: dict[str, Any], number: int) -> None:
    record = read_record(laboratory / f"trial_{number}.csv")
    true = np.loadtxt(laboratory / "truth" / f"trial_{number}.csv", delimiter=",", skiprows=2)
    error = record.theta - np.interp(record.time, true[:, 0], true[:, 1])
    noise = truth["marker_noise"] / truth["radius"]
    assert math.sqrt(float(np.mean(error**2))) == pytest.approx(noise, rel=0.25)
    # What is not noise: zero, from fifteen frames, and the scale.
    assert abs(float(np.mean(error))) < 4.0 * noise / math.sqrt(15.0)
    largest = float(np.max(np.abs(true[:, 1])))
    assert abs(float(np.polyfit(record.theta, error, 1)[0])) * largest < noise


def test_the_run_of_the_fmu_is_that_of_the_true_joystick(laboratory: Path, truth: dict[str, Any]) -> None:
    script = load("data/make_synthetic_laboratory")
    run = np.loadtxt(laboratory / "run.csv", delimiter=",", skiprows=1)
    exact = simulate(script.true_joystick(), time=run[:, 0], theta_start=math.radians(-20.0))
    assert np.max(np.abs(run[:, 1] - exact.theta)) < truth["marker_noise"] / truth["radius"]


def test_figures_and_reports_are_there(laboratory: Path) -> None:
    pictures = ["forward.png", "backward.png", "peaks.png", "run.png", "fit/records.png"]
    for name in [*pictures, "motion_1.csv", "acceleration_1.csv", "fit/fit.md"]:
        assert (laboratory / name).stat().st_size > 1000, name
