"""The settings files that the scenarios ship."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.cli import main
from pyjoystick.runs import Sweep, read_settings, read_sweep, sensitivity

FOLDER = Path(__file__).parents[2] / "scenarios" / "sweeps"
SETTINGS = sorted(FOLDER.glob("*.toml"))


@pytest.mark.parametrize("path", SETTINGS, ids=lambda path: path.stem)
def test_every_file_can_be_read(path: Path, fmus_by_name: Path) -> None:
    sweep = Sweep(read_settings(path))
    assert 100 < len(sweep.design) < 10_000
    assert f"scenarios/sweeps/{path.name}" in path.read_text()


def test_damping_takes_from_the_peaks_and_the_energy(fmus_by_name: Path, tmp_path: Path) -> None:
    target = tmp_path / "a.csv"
    assert main(["sweep", str(FOLDER / "release.toml"), "--output", str(target)]) == 0
    table = read_sweep(target)
    assert len(table) == 208
    assert not table["failed"].any()
    by_release = table.sort_values("damping.C").groupby("theta_start")
    assert (by_release["theta.peak1"].diff().dropna() < 0.0).all()
    assert (by_release["E.loss"].diff().dropna() > 0.0).all()


def test_the_second_peak_is_a_matter_of_damping(fmus_by_name: Path, tmp_path: Path) -> None:
    text = (FOLDER / "sensitivity.toml").read_text().replace("count = 512 ", "count = 64 ")
    (tmp_path / "s.toml").write_text(text)
    target = tmp_path / "s.parquet"
    assert (
        main(["sweep", str(tmp_path / "s.toml"), "-o", str(target), "--plot", str(tmp_path / "s.svg")]) == 0
    )
    indices = sensitivity(read_sweep(target), ["theta.peak2"]).set_index("parameter")
    assert indices["total"].idxmax() == "damping.C"
    assert indices.loc["damping.C", "total_low"] > 0.6
