"""``pyjoystick fit``."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.pyjoystick.cli.conftest import Command

DATA = Path(__file__).parents[3] / "scenarios" / "data"
RECORDS = sorted(str(path) for path in DATA.glob("synthetic_constant_*.csv"))

SETTINGS = """
[fmu]
path = "Joystick"

[free]
"damping.C" = { start = 0.06, minimum = 0.0, maximum = 0.5 }
theta_start = { per_record = true }
release_time = { per_record = true }

[noise]
sigma = { theta = "0.1deg" }

[search]
starts = 3

[uncertainty]
profiles = []
bootstrap = 4
resampling = "residuals"
"""


@pytest.mark.usefixtures("fmus_by_name")
def test_report_and_files(command: Command, tmp_path: Path) -> None:
    outcome = command("fit", *RECORDS[:2], "--output", str(tmp_path / "out"))
    assert outcome.code == 0, outcome.err
    assert "runs of the FMU in" in outcome.out
    found = json.loads((tmp_path / "out" / "fit.json").read_text(encoding="utf-8"))
    damping = found["parameters"][0]
    assert damping["name"] == "damping.C"
    low, high = damping["profile"]["interval"]
    assert low < damping["value"] < high
    assert damping["value"] == pytest.approx(0.045, rel=0.01)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written == {
        "fit.md", "fit.json", "records.png", "residuals.png", "correlation.png", "profiles.png"
    }  # fmt: skip


@pytest.mark.usefixtures("fmus_by_name")
def test_settings_from_a_file(command: Command, tmp_path: Path) -> None:
    path = tmp_path / "fit.toml"
    path.write_text(SETTINGS, encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--settings", str(path))
    assert outcome.code == 0, outcome.err
    assert "3 searches ended in" in outcome.out
    assert "Bootstrap over residuals: 4 fits" in outcome.out


@pytest.mark.usefixtures("fmus_by_name")
def test_doubtful_fit(command: Command) -> None:
    """A constant coefficient on motion made with the power law."""
    outcome = command("fit", str(DATA / "synthetic_power_law_1.csv"))
    assert outcome.code == 3
    assert "NOT TO BE TRUSTED: whiteness" in outcome.out
    assert "not to be trusted: whiteness" in outcome.err


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"damping.C" = {', '"damping.c" = {', "damping.c"),
        ("maximum = 0.5", "maximum = -1.0", "damping.C"),
        ('sigma = { theta = "0.1deg" }', "sigma = { omega = 0.1 }", "omega"),
        ('resampling = "residuals"', 'resampling = "days"', "'records' or 'residuals'"),
        ("starts = 3", "start = 3", "did you mean starts?"),
        ('path = "Joystick"', 'path = "Joystik.fmu"', "Joystik.fmu"),
    ],
)
def test_settings_that_are_refused(
    command: Command, tmp_path: Path, old: str, new: str, message: str
) -> None:
    path = tmp_path / "fit.toml"
    path.write_text(SETTINGS.replace(old, new), encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--settings", str(path))
    assert outcome.code == 1
    assert message in outcome.err
    assert "Traceback" not in outcome.err


def test_settings_and_damping_exclude_each_other(command: Command, tmp_path: Path) -> None:
    outcome = command("fit", RECORDS[0], "--settings", str(tmp_path / "x.toml"), "--damping", "constant")
    assert outcome.code == 2
