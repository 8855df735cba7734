"""The script of the shaken joystick."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.scenarios.scripts import load


def test_response(fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert load("response").main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert "| periodic, T |               25.57 |" in printed
    assert "| 1      | fold | " in printed
    assert "3.48697" in printed
    made = ["branch.pdf", "branch.png", "motions.pdf", "motions.png", "summary.md"]
    assert sorted(path.name for path in tmp_path.iterdir()) == made
