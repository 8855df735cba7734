"""The sensitivity benchmark builds and runs what it times."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks import sensitivities


def test_a_row_for_each_number_of_parameters(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(sensitivities, "NUMBERS", (1,))
    monkeypatch.setattr(sensitivities, "LAWS", ("constant",))
    monkeypatch.setattr(sensitivities, "RUNS", 3)
    (row,) = sensitivities.table(tmp_path, 2).splitlines()[2:]
    law, number, ratio, each = (cell.strip() for cell in row.strip("|").split("|"))
    assert (law, number) == ("constant", "1")
    assert float(ratio.split()[0]) == pytest.approx(1.0 + float(each), abs=0.02)
