"""The script of Fig. 12: the energy falls in steps, and where it rises that is the filter's doing."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.scenarios.scripts import cells, load


def test_fig_12(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scenario = load("fig12_measured_energy")
    assert scenario.main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        *("energy.pdf", "energy.png", "plateaus.pdf", "plateaus.png", "summary.md")
    ]
    assert printed.rstrip() == (tmp_path / "summary.md").read_text().rstrip()
    lost, swing = map(float, cells(printed, "0.1192")[-2:])
    assert 0.0 <= lost < 0.045 * swing
    measured = {
        line.split("|")[1].strip(): [float(cell) for cell in line.split("|")[2:-1]]
        for line in printed.splitlines()
        if " camera " in line and line.startswith("| ")
    }
    assert measured["13 Hz, camera 60 Hz"][0] == pytest.approx(6.7, abs=0.2)
    assert measured["13 Hz, camera 60 Hz"][-1] == pytest.approx(5.9, abs=0.2)
    assert measured["13 Hz, camera 240 Hz"][-1] == pytest.approx(5.9, abs=0.2)
    assert measured["100 Hz, camera 240 Hz"][-1] < 0.3
