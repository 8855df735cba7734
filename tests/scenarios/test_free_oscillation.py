"""The scenario that ``make run`` calls."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pandas as pd
import pytest

from tests.scenarios.scripts import load


@pytest.fixture
def scenario() -> ModuleType:
    return load("free_oscillation")


def test_it_writes_and_prints_its_results(
    scenario: ModuleType, fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert scenario.main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        *("constant_damping.csv", "motion.pdf", "motion.png", "power-law_damping.csv", "summary.md"),
    ]
    assert printed.rstrip("\n") == (tmp_path / "summary.md").read_text().rstrip("\n")
    assert len(printed.splitlines()) <= 30
    # The last line, the versions, may be wrapped by the terminal.
    assert max(map(len, printed.rstrip("\n").splitlines()[:-1])) <= 80
    table = pd.read_csv(tmp_path / "constant_damping.csv", index_col="time (s)")
    assert table["theta (rad)"].iloc[0] == np.radians(-20.0)
    assert table.index[-1] == 1.5


def test_an_fmu_too_far_from_the_reference_is_a_failure(
    scenario: ModuleType, fmus_by_name: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(scenario, "LIMITS", {"theta": 1e-16})
    assert scenario.main(tmp_path) == 1
