"""``pyjoystick budget``."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import BACKWARD_TABLE, NOMINAL, read_parameter_file, write_parameters
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.laboratory.load_curve.machine import cycle, write
from tests.scenarios.scripts import cells

SAVED = ("--json", "budget.json", "--csv", "budget.csv")


@pytest.fixture
def record(tmp_path: Path) -> str:
    """A record, and joystick.toml with an uncertainty of m."""
    made = synthetic_record(NOMINAL, release_angle=math.radians(-20.0), random=np.random.default_rng(4))
    rows = [f"{t:.9g},{math.degrees(a):.9g}" for t, a in zip(made.time, made.theta, strict=True)]
    (tmp_path / "record.csv").write_text("\n".join(["time (s),theta (deg)", *rows, ""]), encoding="utf-8")
    write_parameters(tmp_path / "joystick.toml", NOMINAL, uncertainties={"body.m": 0.01})
    return "record.csv"


def test_what_is_uncertain_has_a_row_and_the_file_the_whole(command: Command, record: str) -> None:
    before = read_parameter_file(Path("joystick.toml")).joystick
    outcome = command(
        "budget", record, "-p", "joystick.toml", "--uncertainty", "scale=0.002", "--update", *SAVED
    )
    assert outcome.code == 0, outcome.err
    none = "the absence of dry friction"
    exact = f"h, g, a, b, {none}, load curve forward, load curve backward, time base, scale of the force"
    assert f"taken as exact: {exact}" in outcome.err
    parts = [
        [float(cell or 0.0) for cell in cells(outcome.out, stage)[3:]]
        for stage in (
            "scale of the angle, 0.2 %",
            "m +- 0.01",
            "fit, noise of the records",
        )
    ]
    whole = [float(cell) for cell in cells(outcome.out, "all")[3:]]
    np.testing.assert_allclose(np.sqrt(np.sum(np.square(parts), axis=0)), whole, atol=2e-3)
    assert all(0.0 < part < total for row in parts for part, total in zip(row, whole, strict=True))
    saved = json.loads(Path("budget.json").read_text(encoding="utf-8"))
    assert saved["trusted"] is True
    inertia, damping = saved["parameters"]
    assert (inertia["name"], damping["name"], inertia["unit"]) == ("J", "damping.C", "kg.m2")
    assert inertia["value"] == pytest.approx(NOMINAL.J, rel=0.01)
    assert inertia["standard_uncertainty"] / inertia["value"] == pytest.approx(whole[0] / 100.0, abs=1e-5)
    table = pd.read_csv("budget.csv", index_col="stage")
    assert list(table) == ["theta (rad)", "omega (rad/s)", "period", "J", "C"]
    np.testing.assert_allclose(
        np.sqrt(np.nansum(table[["J", "C"]] ** 2, axis=0)), np.array(whole) / 100, atol=1e-5
    )
    assert [one["stage"] for one in saved["contributions"]] == list(table.index)
    found = read_parameter_file(Path("joystick.toml"))
    assert found.uncertainties["body.J"] == pytest.approx(whole[0] / 100.0 * NOMINAL.J, rel=0.06)
    assert found.uncertainties["body.m"] == 0.01
    assert abs(found.joystick.J - NOMINAL.J) < 3.0 * found.uncertainties["body.J"]
    assert found.sources["damping.constant"] == "fit to record.csv, uncertainty from the budget"
    assert found.joystick.forward == before.forward


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (("--uncertainty", "k=1"), 1, "k = 1.0: must be one of m, h, J, g, a, b, friction.T_c, friction.F_c"),
        (("--curve", "left=a.csv"), 2, "must be forward or backward"),
        (("--curve", "forward=none.csv"), 1, "none.csv: cannot be read"),
    ],
)
def test_wrong_usage(command: Command, record: str, options: tuple[str, ...], code: int, words: str) -> None:
    outcome = command("budget", record, "-p", "joystick.toml", *options)
    assert outcome.code == code
    assert words in outcome.err


def test_another_curve_and_another_law_are_refused(command: Command, record: str) -> None:
    write(Path("other.csv"), *cycle(BACKWARD_TABLE, 1))
    outcome = command("budget", record, "-p", "joystick.toml", "--curve", "forward=other.csv")
    assert outcome.code == 2
    words = " ".join(outcome.err.replace("│", " ").split())
    assert "[forward] of joystick.toml does not come from other.csv; import it first" in words
    assert command("parameters", "--damping", "power-law", "-o", "power.toml").code == 0
    outcome = command("budget", record, "-p", "power.toml")
    assert outcome.code == 2
    assert "must choose constant damping" in outcome.err


def test_a_fit_that_is_not_to_be_trusted_is_not_written(command: Command, record: str) -> None:
    text = Path("joystick.toml").read_text(encoding="utf-8")
    Path("joystick.toml").write_text(
        text.replace("k = [430e3, 2625.0", "k = [430e3, 4625.0"), encoding="utf-8"
    )
    before = Path("joystick.toml").read_text(encoding="utf-8")
    assert before != text
    outcome = command("budget", record, "-p", "joystick.toml", "--update")
    assert outcome.code == 3
    assert "do not trust the fit: it failed whiteness" in outcome.err
    assert Path("joystick.toml").read_text(encoding="utf-8") == before
