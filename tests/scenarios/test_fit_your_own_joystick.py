"""The scenario of fitting a joystick, on records made with eq. (11)."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.scenarios.scripts import load


def test_the_records_ask_for_the_law_that_made_them(
    fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scenario = load("fit_your_own_joystick")
    assert scenario.main(tmp_path) == 0
    printed = capsys.readouterr().out
    cells = {
        line.split("|")[1].strip(): [cell.strip() for cell in line.split("|")[2:-1]]
        for line in printed.splitlines()
        if line.startswith(("| constant", "| power law"))
    }
    assert cells["power law"][1:3] == ["0.0", "0.0"]
    assert float(cells["constant"][1]) > 100.0
    # The same holds for records that were left out, so that it is no matter of more parameters.
    assert float(cells["constant"][4]) > 2.0 * float(cells["power law"][4])
    for law in ("constant", "power_law"):
        assert {"fit.md", "fit.json", "records.png"} <= {path.name for path in (tmp_path / law).iterdir()}
