"""``pyjoystick peaks``."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.pyjoystick.cli.conftest import Command

DATA = Path(__file__).parents[3] / "scenarios" / "data"
RECORDS = [str(path) for path in sorted(DATA.glob("synthetic_constant_?.csv"))]


def test_the_estimate_is_printed_beside_its_bias(command: Command, tmp_path: Path) -> None:
    outcome = command("peaks", *RECORDS, "--released", "backward", "--plot", "peaks.png")
    assert outcome.code == 0
    assert outcome.err.splitlines()[-1] == "wrote peaks.png"
    assert (tmp_path / "peaks.png").stat().st_size > 10_000
    row = next(line for line in outcome.out.splitlines() if line.startswith("| C, both "))
    cells = [cell.strip() for cell in row.split("|")[2:-1]]
    assert abs(float(cells[0]) - 0.045) < 0.001
    assert abs(float(cells[3]) - 0.045) < 0.001
    assert "synthetic_constant_4" in outcome.out


def test_the_results_are_saved(command: Command, tmp_path: Path) -> None:
    outcome = command("peaks", *RECORDS, "--json", "peaks.json", "--csv", "peaks.csv")
    assert outcome.code == 0, outcome.err
    found = json.loads((tmp_path / "peaks.json").read_text(encoding="utf-8"))
    both = {one["name"]: one for one in found["constants"]}["both"]
    row = next(line for line in outcome.out.splitlines() if line.startswith("| C, both "))
    assert f"{both['corrected']:.4f}" == row.split("|")[5].strip()
    assert both["interval"][0] < both["estimate"] < both["interval"][1]
    assert [one["name"] for one in found["lines"]] == ["A_pos", "n_pos", "A_neg", "n_neg", "B", "m"]
    assert [one["name"] for one in found["releases"]] == [Path(record).stem for record in RECORDS]
    assert found["releases"][0]["release_angle"] == pytest.approx(math.radians(-20.0), rel=0.01)
    table = pd.read_csv(tmp_path / "peaks.csv")
    assert list(table) == ["record", "number", "time (s)", "theta (rad)", "omega (rad/s)", "C (N.m.s/rad)"]
    assert set(table["record"]) == {Path(record).stem for record in RECORDS}
    assert table["theta (rad)"].isna().equals(table["omega (rad/s)"].notna())


def test_columns_units_and_parameters(command: Command, tmp_path: Path) -> None:
    table = np.loadtxt(RECORDS[0], delimiter=",", skiprows=3)
    lines = ["t,Angle", *(f"{t},{np.radians(a)}" for t, a in table)]
    (tmp_path / "plain.csv").write_text("\n".join(lines))
    columns = ("--column", "time=t", "--column", "theta=Angle", "--unit", "time=s", "--unit", "theta=rad")
    plain = command("peaks", "plain.csv", *columns)
    assert plain.code == 0
    first = command("peaks", RECORDS[0])
    estimates = [
        [line.split("|")[2].strip() for line in one.out.splitlines() if line.startswith("| C, ")]
        for one in (plain, first)
    ]
    assert estimates[0] == estimates[1]
    double = command("peaks", RECORDS[0], "--set", "J=0.0227")
    row = next(line for line in double.out.splitlines() if line.startswith("| C, displacement "))
    assert abs(float(row.split("|")[2]) - 2.0 * float(estimates[1][0])) < 2e-4


def test_a_bad_record_is_one_message(command: Command, tmp_path: Path) -> None:
    lines = Path(RECORDS[0]).read_text().splitlines()
    lines[9] = lines[8]
    (tmp_path / "bad.csv").write_text("\n".join(lines))
    outcome = command("peaks", "bad.csv")
    assert outcome.code == 1
    assert outcome.message.startswith("bad.csv, column 'time', row 10: times are repeated")
    wrong = command("peaks", RECORDS[0], "--released", "forward")
    assert "released backward instead of forward" in wrong.message


def test_wrong_usage(command: Command) -> None:
    for arguments in (
        ("peaks",),
        ("peaks", RECORDS[0], "--released", "left"),
        ("peaks", RECORDS[0], "--column", "theta"),
    ):
        assert command(*arguments).code == 2
    assert command("peaks", RECORDS[0], "--plot", "peaks.doc").code == 1


def test_notes_are_told(command: Command, tmp_path: Path) -> None:
    lines = Path(RECORDS[0]).read_text().splitlines()
    del lines[30]
    (tmp_path / "gap.csv").write_text("\n".join(lines))
    outcome = command("peaks", "gap.csv")
    assert outcome.code == 0
    assert "gap: gaps: about 1 samples are missing between rows 30-31" in outcome.err


def test_the_j_of_another_joystick_is_doubted(command: Command) -> None:
    """C is in proportion to J, and nothing else shows that it is twice as large as it should be."""
    doubled = command("peaks", *RECORDS, "--set", "J=0.0227")
    assert doubled.code == 0
    note = " ".join(doubled.err.split())
    assert "but the joystick has 0.0227" in note
    assert float(note.partition("require J = ")[2].split()[0]) == pytest.approx(0.01135, rel=0.05)
    assert "of the swings require" not in command("peaks", *RECORDS, "--set", "J=0.0125").err
