"""The scenario of fitting a joystick, on records made with eq. (11)."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.model import read_parameter_file
from tests.scenarios.scripts import load


def test_the_records_ask_for_the_law_that_made_them(
    fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scenario = load("fit_your_own_joystick")
    # Two of the four records say the same in a quarter of the time.
    assert scenario.main(tmp_path, scenario.RECORDS[0:3:2]) == 0
    printed = capsys.readouterr().out
    cells = {
        line.split("|")[1].strip(): [cell.strip() for cell in line.split("|")[2:-1]]
        for line in printed.splitlines()
        if line.startswith(("| constant", "| displacement terms", "| power law"))
    }
    assert cells["displacement terms"][1:3] == ["0.0", "0.0"]
    # The velocity term is a tenth of the damping: these records cannot tell whether it is there.
    assert float(cells["power law"][1]) < 10.0
    assert float(cells["constant"][1]) > 100.0
    # The same holds for records that were left out, so that it is no matter of more parameters.
    assert float(cells["constant"][4]) > 2.0 * float(cells["power law"][4])
    assert "displacement terms: written into joystick.toml" in printed
    written = read_parameter_file(tmp_path / "joystick.toml")
    assert written.sources["damping.power-law"] == "fit to 2 records"
    assert written.joystick.to_names()["damping.alpha"] == 1.0
    damping = written.joystick.to_names()
    # At 0.1 rad, in the middle of the peaks, and 4 rad/s, where the velocity term adds a twentieth.
    true = 0.9 * 0.086 * 0.1**0.084 + 0.1 * 0.051 * 4.0**-0.26
    assert damping["damping.A_pos"] * 0.1 ** damping["damping.n_pos"] == pytest.approx(true, rel=0.05)
    assert 0.0 < written.uncertainties["damping.power-law.A_pos"] < 0.01
    for law in ("constant", "displacement_terms", "power_law"):
        assert {"fit.md", "fit.json", "records.png"} <= {path.name for path in (tmp_path / law).iterdir()}
