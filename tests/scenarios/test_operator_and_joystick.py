"""Operator and joystick as two FMUs: what the scenario prints and leaves."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.scenarios.scripts import cells, load


def test_operator_and_joystick(
    fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scenario = load("operator_and_joystick")
    assert scenario.main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert printed.rstrip() == (tmp_path / "summary.md").read_text().rstrip()
    files = [f"{name}.{suffix}" for name in ("errors", "motion") for suffix in ("pdf", "png")]
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        *files[:2],
        "joystick.ssp",
        *files[2:],
        "summary.md",
        "unpacked",
    ]
    orders = [float(cells(printed, scheme)[-1]) for scheme in ("delay", "hold", "extrapolate", "iterate")]
    assert orders == pytest.approx([1.0, 1.0, 2.0, 2.0], abs=0.1)
    steps = [int(cell) for cell in cells(printed, "hold", table=1)]
    assert steps == [2 * round(1.2 / step) for step in scenario.STEPS]
