"""docs/your-joystick.md, executed as printed: the fit recovers the values that were put in."""

from __future__ import annotations

import json
import math
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.laboratory import true_joystick
from pyjoystick.model import ParameterFile, read_parameter_file, simulate
from pyjoystick.motion import read_record
from pyjoystick.reports import read_laboratory, run_project
from tests.docs import commands

PAGE = (Path(__file__).parents[1] / "docs" / "your-joystick.md").read_text(encoding="utf-8")
#: The file of the fit, and the commands with their continuation lines, in the order of the page.
BLOCKS = re.compile(r"^```toml\n(?P<toml>(?:.*\n)*?)```$|^    (?P<command>\S(?:.*\\\n)*.*)$", re.MULTILINE)
#: The page takes a minute: one process goes through it.
pytestmark = pytest.mark.xdist_group("your-joystick")
#: The standard normal deviate of a 95 % interval.
Z = 1.96
#: What `pyjoystick run` has done at length; as single commands they are only read.
LONG = ("fit", "budget", "export")
#: What takes long to load, and is for steps that are done.
HEAVY = {"asteval", "jinja2", "lmfit", "matplotlib", "numba", "rumoca", "scipy"}
SECOND_RUN = """
import sys
from pyjoystick.cli import main
assert main(["run"]) == 0
print(*sys.modules)
"""


def _carry_out(command: str) -> None:
    """A line of the page, in this process. One that ends in ``# refused`` must be."""
    program, *arguments = shlex.split(command, comments=True)
    if program == "cd":
        os.chdir(arguments[0])
    elif arguments[0] in LONG:
        commands.read(command)
    else:
        assert program == "pyjoystick"
        assert main(arguments) == (1 if command.endswith("# refused") else 0), command


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory, joystick_fmus: Path) -> Iterator[Path]:
    """The folder in which the page ends."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pyjoystick.fmu.files.build_folder", lambda: joystick_fmus)
        patch.chdir(tmp_path_factory.mktemp("your_joystick"))
        for block in BLOCKS.finditer(PAGE):
            if block["toml"]:
                name = "fit.toml" if "[free]" in block["toml"] else "printed.toml"
                Path(name).write_text(block["toml"], encoding="utf-8")
            else:
                _carry_out(block["command"].replace("\\\n", " "))
        yield Path.cwd()


@pytest.fixture(scope="module")
def truth(laboratory: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((laboratory / "truth" / "truth.json").read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="module")
def found(laboratory: Path) -> ParameterFile:
    return read_parameter_file(laboratory / "results" / "joystick.toml")


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
    record = read_record(laboratory / "results" / "records" / f"synthetic_trial_{number}.csv")
    true = np.loadtxt(laboratory / "truth" / f"trial_{number}.csv", delimiter=",", skiprows=2)
    error = record.theta - np.interp(record.time, true[:, 0], true[:, 1])
    noise = truth["marker_noise"] / truth["radius"]
    assert math.sqrt(float(np.mean(error**2))) == pytest.approx(noise, rel=0.25)
    # What is not noise: zero, from fifteen frames, and the scale.
    assert abs(float(np.mean(error))) < 4.0 * noise / math.sqrt(15.0)
    largest = float(np.max(np.abs(true[:, 1])))
    assert abs(float(np.polyfit(record.theta, error, 1)[0])) * largest < noise


def test_the_run_of_the_fmu_is_that_of_the_true_joystick(laboratory: Path, truth: dict[str, Any]) -> None:
    run = np.loadtxt(laboratory / "run.csv", delimiter=",", skiprows=1)
    exact = simulate(true_joystick(), time=run[:, 0], theta_start=math.radians(-20.0))
    assert np.max(np.abs(run[:, 1] - exact.theta)) < truth["marker_noise"] / truth["radius"]


def test_figures_and_reports_are_there(laboratory: Path) -> None:
    results = [
        "load_curves/forward.png",
        "peaks/peaks.png",
        "fit/records.png",
        "fit/fit.md",
        "budget/budget.md",
    ]
    results += ["motions/synthetic_trial_1.csv", "accelerometers/synthetic_acceleration_1.csv"]
    results += ["fmus/MyJoystick.fmu", "fmus/MyJoystickInverse.fmu", "report.html"]
    singly = ["forward.png", "backward.png", "peaks.png", "run.png", "motion_1.csv", "acceleration_1.csv"]
    singly.append("report.html")
    for name in [*(f"results/{one}" for one in results), *singly]:
        assert (laboratory / name).stat().st_size > 1000, name


def test_the_single_commands_do_the_same(laboratory: Path) -> None:
    single, whole = (
        read_parameter_file(laboratory / name) for name in ("joystick.toml", "results/measured.toml")
    )
    assert single.joystick == whole.joystick
    known = {name: one for name, one in whole.uncertainties.items() if name != "geometry.a"}
    assert single.uncertainties == known  # the budget is told that of a
    for number in (1, 2, 3, 4):
        one = laboratory / "results" / "records" / f"synthetic_trial_{number}.csv"
        assert one.read_bytes() == (laboratory / f"trial_{number}.csv").read_bytes()


def test_the_printed_project_is_the_example_s(laboratory: Path) -> None:
    printed, whole = (read_laboratory(laboratory / name) for name in ("printed.toml", "laboratory.toml"))
    assert printed.given == whole.given
    assert (printed.curves, printed.parts, printed.swing) == (whole.curves, whole.parts, whole.swing)
    assert printed.markers == whole.markers[:1]


def test_a_second_run_does_nothing_and_loads_nothing_for_it(laboratory: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in (laboratory / "results").rglob("*")}
    done = subprocess.run(
        [sys.executable, "-c", SECOND_RUN], cwd=laboratory, capture_output=True, text=True, check=True
    )
    *printed, loaded = done.stdout.splitlines()
    assert sum(" unchanged " in line for line in printed) == 16
    assert {path: path.stat().st_mtime_ns for path in (laboratory / "results").rglob("*")} == before
    assert {"pyjoystick.reports.project.running", "numpy"} <= set(loaded.split())
    assert HEAVY & set(loaded.split()) == set()


@pytest.mark.parametrize(
    ("file", "redone"),
    [
        ("synthetic_acceleration_1.csv", ["accelerometer synthetic_acceleration_1"]),
        ("synthetic_parts.csv", ["parts", "report"]),
        ("synthetic_swing.csv", ["swing", "report"]),
        ("synthetic_trial_3.csv", ["record synthetic_trial_3"]),
    ],
)
def test_only_what_hangs_on_a_file_is_done_again(
    laboratory: Path, joystick_fmus: Path, file: str, redone: list[str]
) -> None:
    """A comment, or an empty line, changes a file and nothing that is read from it."""
    path = laboratory / "data" / file
    before = path.read_bytes()
    edited = before.replace(b"# synthetic", b"# made up", 1)
    path.write_bytes(before + b"\n" if edited == before else edited)
    steps = run_project(laboratory, find=lambda name: joystick_fmus / f"{name}.fmu").steps
    assert [one.name for one in steps if one.state == "done"] == redone
    assert {one.state for one in steps} == {"done", "unchanged"}


def test_what_does_not_hang_on_a_damaged_file_is_done(laboratory: Path, joystick_fmus: Path) -> None:
    def find(name: str) -> Path:
        return joystick_fmus / f"{name}.fmu"

    trial, parts = (laboratory / "data" / f"synthetic_{name}.csv" for name in ("trial_2", "parts"))
    texts = trial.read_text(encoding="utf-8"), parts.read_text(encoding="utf-8")
    trial.write_text(texts[0].replace("\n100,0,", "\n100,0,x", 1), encoding="utf-8")
    parts.write_text(texts[1] + "\n", encoding="utf-8")
    steps = {one.name: one for one in run_project(laboratory, find=find).steps}
    assert steps["record synthetic_trial_2"].state == "failed"
    assert "synthetic_trial_2.csv" in steps["record synthetic_trial_2"].remark
    assert "row 105" in steps["record synthetic_trial_2"].remark
    assert steps["parts"].state == "done"
    behind = ("peaks", "fit", "error budget", "joystick", "FMUs", "report")
    assert {steps[name].state for name in behind} == {"not done"}
    for path, text in zip((trial, parts), texts, strict=True):
        path.write_text(text, encoding="utf-8")
    steps = {one.name: one for one in run_project(laboratory, find=find).steps}
    assert {steps[name].state for name in behind} == {"unchanged"}
