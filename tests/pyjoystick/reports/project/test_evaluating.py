"""The fit of a project: its results, and the steps that a doubtful fit prevents."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pyjoystick import reports
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL, read_parameter_file, write_parameters
from pyjoystick.reports import StepState, read_laboratory, run_project
from pyjoystick.reports.project.evaluating import peaks
from tests.docs.pages import ROOT

#: Two synthetic releases, fitted with a moment of inertia that is known.
LABORATORY = """
title = "Stick"
[[record]]
files = "synthetic_constant_[12].csv"
[fit]
settings = "fit.toml"
[fmus]
fmi = []
"""
FIT = """
[fmu]
path = "Joystick"
[parameters]
J = 0.01135
[free]
"damping.C" = { start = 0.04 }
theta_start = { per_record = true }
release_time = { per_record = true }
[uncertainty]
profiles = []
"""


@pytest.fixture
def run(
    tmp_path: Path, joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str, str], dict[str, StepState]]:
    """Writes and runs the project; without the report."""
    monkeypatch.setattr(reports, "joystick_report", lambda *_, **__: "<html></html>")
    for number in (1, 2):
        name = f"synthetic_constant_{number}.csv"
        (tmp_path / name).write_bytes((ROOT / "scenarios" / "data" / name).read_bytes())

    def states(laboratory: str, fit: str) -> dict[str, StepState]:
        (tmp_path / "laboratory.toml").write_text(laboratory, encoding="utf-8")
        (tmp_path / "fit.toml").write_text(fit, encoding="utf-8")
        done = run_project(tmp_path, find=lambda name: joystick_fmus / f"{name}.fmu")
        return {one.name: one for one in done.steps if one.state != "missing"}

    return states


def test_a_fit_of_one_s_own_becomes_the_joystick(
    run: Callable[[str, str], dict[str, StepState]], tmp_path: Path
) -> None:
    assert {one.state for one in run(LABORATORY, FIT).values()} == {"done"}
    file = read_parameter_file(tmp_path / "results" / "joystick.toml")
    assert file.title == "Stick"
    error = file.uncertainties["damping.constant.C"]
    assert abs(file.joystick.to_names()["damping.C"] - NOMINAL.to_names()["damping.C"]) < 3.0 * error < 1e-3
    names = "synthetic_constant_1.csv, synthetic_constant_2.csv"
    assert file.sources["damping.constant"] == f"fit to {names}"
    assert file.sources["body"] == "Rogers et al. (2004), Table 2"
    again = run(LABORATORY, FIT)
    assert {one.state for one in again.values()} == {"unchanged"}


def test_a_doubtful_fit_is_told_once_and_goes_no_further(
    run: Callable[[str, str], dict[str, StepState]], tmp_path: Path
) -> None:
    wrong = FIT.replace("0.01135", "0.0125")
    for state in ("done", "unchanged"):
        steps = run(LABORATORY, wrong)
        assert (steps["fit"].state, steps["fit"].remark.split()[0]) == (state, "failed")
        assert "do not trust this fit" in steps["fit"].notes[0]
        assert steps["joystick"].state == "not done"
        assert steps["joystick"].remark.startswith("needs the fit, which failed ")
    content = json.loads((tmp_path / "results" / "fit" / "fit.json").read_text(encoding="utf-8"))
    assert not content["trusted"]
    assert not (tmp_path / "results" / "fit" / "joystick.toml").exists()
    taken = LABORATORY.replace("[fmus]", "even_if_doubtful = true\n[fmus]")
    steps = run(taken, wrong)
    assert steps["joystick"].state == "done"
    sources = read_parameter_file(tmp_path / "results" / "joystick.toml").sources
    assert "; doubtful: " in sources["damping.constant"]
    assert "J: as fixed in the fit to" in sources["body"]


def test_a_fit_takes_what_was_measured_and_no_other_file(
    run: Callable[[str, str], dict[str, StepState]],
) -> None:
    steps = run(LABORATORY, FIT.replace('path = "Joystick"', 'path = "Joystick"\nparameters = "other.toml"'))
    assert steps["fit"].state == "failed"
    assert '[fmu] parameters = "other.toml": must be left out in a project' in steps["fit"].remark


@pytest.mark.parametrize(("slow", "contradicts"), [(1.0, False), (1.02, True)])
def test_a_fit_that_contradicts_a_measurement_is_doubted(
    run: Callable[[str, str], dict[str, StepState]], tmp_path: Path, slow: float, contradicts: bool
) -> None:
    """The clock of the records is 2 % slow, which leaves no trace in the residuals and makes J 4 % larger."""
    for number in (1, 2):
        path = tmp_path / f"synthetic_constant_{number}.csv"
        lines = path.read_text(encoding="utf-8").splitlines()
        rows = [line.split(",") for line in lines[3:]]
        scaled = [f"{slow * float(time):.6f},{angle}" for time, angle in rows]
        path.write_text("\n".join([*lines[:3], *scaled, ""]), encoding="utf-8")
    swing = f'{LABORATORY}[body]\nJ = {NOMINAL.J}\nu_J = 5e-5\nsource = "swing test"\n'
    steps = run(swing, FIT.replace("[parameters]\nJ = 0.01135\n[free]", "[free]\nJ = {}"))
    assert steps["fit"].remark.startswith("J = "), steps["fit"]
    body = read_parameter_file(tmp_path / "results" / "joystick.toml").sources["body"]
    notes = steps["joystick"].notes
    assert bool(notes) == contradicts
    assert ("J is " in body) == contradicts
    if contradicts:
        assert "of the fit contradicts 0.01135 +- 5e-05 of the swing test" in notes[0]
        assert notes[0].endswith("Check the clock of the records, the scale of their angle and h")
        assert "combined standard uncertainties off the swing test" in body


def test_a_fit_may_change_what_was_measured_within_its_uncertainty(
    run: Callable[[str, str], dict[str, StepState]], tmp_path: Path
) -> None:
    """J is measured 1 % too large: fixed, it spoils the fit; with its uncertainty, the records correct it."""
    wrong = f'[body]\nJ = {1.01 * NOMINAL.J}\nu_J = {0.01 * NOMINAL.J}\nsource = "swing test"\n'
    own = FIT.replace("[parameters]\nJ = 0.01135\n", "")
    assert run(LABORATORY + wrong, own)["fit"].remark.startswith("failed ")
    known = LABORATORY.replace("[fmus]", 'known = ["J"]\n[fmus]') + wrong
    steps = run(known, own)
    assert "J = " in steps["fit"].remark, steps["fit"]
    file = read_parameter_file(tmp_path / "results" / "joystick.toml")
    assert abs(file.joystick.J - NOMINAL.J) < 3.0 * file.uncertainties["body.J"] < 0.005 * NOMINAL.J
    assert abs(file.joystick.to_names()["damping.C"] / NOMINAL.to_names()["damping.C"] - 1.0) < 0.01


def test_what_was_not_measured_is_not_known(run: Callable[[str, str], dict[str, StepState]]) -> None:
    steps = run(LABORATORY.replace("[fmus]", 'known = ["*Spring.x_0"]\n[fmus]'), FIT)
    assert steps["fit"].state == "failed"
    assert "known = *Spring.x_0: must be one that " in steps["fit"].remark


@pytest.mark.parametrize("known", [False, True])
def test_peaks_of_a_joystick_whose_inertia_was_not_measured(
    known: bool, joystick_fmus: Path, tmp_path: Path
) -> None:
    """C of peaks is in proportion to J: with the paper's it would be 1.6 times too large."""
    joystick = NOMINAL.replace({"J": 0.0071, "damping.C": 0.03})
    records = []
    for k, angle in enumerate((-19.0, -18.0, -17.0)):
        random = np.random.default_rng(k)
        record = synthetic_record(joystick, release_angle=math.radians(angle), random=random, rate=200.0)
        records.append(f"{k}.csv")
        rows = "".join(f"{t:.6f},{one:.8f}\n" for t, one in zip(record.time, record.theta, strict=True))
        (tmp_path / records[-1]).write_text(f"time (s),theta (rad)\n{rows}", encoding="utf-8")
    (tmp_path / "laboratory.toml").write_text("", encoding="utf-8")
    write_parameters(tmp_path / "results" / "measured.toml", NOMINAL)
    lab = read_laboratory(tmp_path / "laboratory.toml")
    step = peaks(lab, tuple(records), lambda name: joystick_fmus / f"{name}.fmu", inertia_known=known)
    done = step.work(lambda _: None)
    [note] = done.notes
    found = json.loads((tmp_path / "results" / "peaks" / "peaks.json").read_text(encoding="utf-8"))
    both = {one["name"]: one["corrected"] for one in found["constants"]}["both"]
    begins = "with these springs, the periods" if known else "J is not measured: C is based on"
    assert note.startswith(begins)
    assert float(note.partition("J = ")[2].split()[0]) == pytest.approx(0.0071, rel=0.05)
    assert both == pytest.approx(0.03 * NOMINAL.J / 0.0071 if known else 0.03, rel=0.1)
