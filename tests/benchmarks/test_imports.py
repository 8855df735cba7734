"""The import benchmark measures the imports that it names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from benchmarks import imports
from pyjoystick.laboratory import read_markers


def test_all_kinds_of_files_hold_the_same_markers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(imports, "DURATION", 8.0)
    table = imports.markers_table(tmp_path, 1)
    assert [line.split("|")[1].strip() for line in table.splitlines()[2:]] == [
        "C3D",
        "Nexus CSV",
        "plain CSV",
    ]
    files = [read_markers(tmp_path / name) for name in ("a.c3d", "nexus.csv", "plain.csv")]
    for markers in files:
        assert markers.positions.shape == (1920, 20, 3)
        assert markers.rate == pytest.approx(240.0)
        # Single precision, six and nine digits of mm.
        np.testing.assert_allclose(markers.positions, files[2].positions, atol=6e-6)


def test_a_long_record_takes_no_memory_of_its_length(tmp_path: Path) -> None:
    rows = imports.accelerometer_table(tmp_path, 500_000).splitlines()[2:]
    memory = {line.split("|")[1].strip(): float(line.split("|")[5]) for line in rows}
    assert memory["CSV, pyjoystick"] < 0.5 * memory["CSV, pandas"]
    assert (tmp_path / "long.npy").stat().st_size == pytest.approx(2_000_000, rel=1e-3)
