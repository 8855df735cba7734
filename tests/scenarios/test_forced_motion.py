"""The scripts of Figs. 14 and 15 and of the shift."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from tests.scenarios.scripts import load

NAMES = ("fig14_forced_motion", "fig15_torque", "ergonomics")


def _rows(printed: str) -> dict[str, list[str]]:
    """The cells of every row of a table by its first."""
    rows = (line for line in printed.splitlines() if line.startswith("| "))
    return {row.split("|")[1].strip(): [cell.strip() for cell in row.split("|")[2:-1]] for row in rows}


def _run(name: str, results: Path, capsys: pytest.CaptureFixture[str]) -> dict[str, list[str]]:
    assert load(name).main(results) == 0
    printed = capsys.readouterr().out
    assert printed.rstrip() == (results / "summary.md").read_text().rstrip()
    return _rows(printed)


def test_fig_14(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = _run("fig14_forced_motion", tmp_path, capsys)
    exact = [float(cell) for cell in rows["in closed form"]]
    assert exact == pytest.approx([18.0, 4.91, -4.91, 125.9, -125.9], abs=0.01)
    measured = [float(cell) for cell in rows["synthetic measurement"]]
    assert measured[0] == pytest.approx(18.0, abs=0.5)
    assert 0.8 * exact[3] < measured[3] < exact[3]
    made = ["in_closed_form.csv", "motion.pdf", "motion.png", "summary.md", "synthetic_measurement.csv"]
    assert sorted(path.name for path in tmp_path.iterdir()) == made
    table = pd.read_csv(tmp_path / "in_closed_form.csv", index_col="time (s)")
    assert {"theta (rad)", "T (N.m)", "F (N)"} < set(table)


def test_fig_15(fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Section 5: inertia comparable to stiffness, damping about 10 %, eq. (11)'s about double: 1.55."""
    rows = _run("fig15_torque", tmp_path, capsys)
    inertia, constant, power_law, ratio, falling = rows["0.12 s"]
    assert float(inertia) == pytest.approx(0.65, abs=0.01)
    assert [float(cell.rstrip(" %")) for cell in (constant, power_law)] == pytest.approx([7.9, 12.0], abs=0.1)
    assert float(ratio) == pytest.approx(1.55, abs=0.01)
    assert float(falling) == pytest.approx(2.09, abs=0.01)
    assert float(rows["0.3 s"][0]) < 0.15
    text = (tmp_path / "summary.md").read_text()
    against, returned = (float(text.split(before)[1].split()[0]) for before in ("Python: ", "differs by "))
    assert against < 1e-12
    assert returned < 1e-6
    figures = [f"torque{kind}.{suffix}" for kind in ("", "_measured") for suffix in ("pdf", "png")]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(["summary.md", *figures])


def test_ergonomics(fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = _run("ergonomics", tmp_path, capsys)
    loads = {name: [float(cell) for cell in cells] for name, cells in rows.items() if name.count(",") == 1}
    nominal = [float(cell) for cell in rows["as it is"]]
    assert len(loads) == 6
    assert nominal[:4] == sorted(nominal[:4])
    assert loads["preload, half"][1] < 0.6 * nominal[1]
    assert loads["speed, double"][4] > 2.0 * nominal[4]
    assert nominal[8] == pytest.approx(20.0 * nominal[6], abs=0.011)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["force.pdf", "force.png", "summary.md"]
