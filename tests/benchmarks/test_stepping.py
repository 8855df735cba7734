"""The benchmark of single steps measures what it names."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from benchmarks import stepping
from pyjoystick.fmu import Fmu


def test_three_ways(joystick_fmus: Path, joystick_fmus3: Path, tmp_path: Path) -> None:
    for name, folder in (("fmi2", joystick_fmus), ("fmi3", joystick_fmus3)):
        (tmp_path / name).symlink_to(folder, target_is_directory=True)
    rows = stepping.table(tmp_path, 200, 0.02).splitlines()[2:]
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    assert [row[0] for row in cells] == [
        "FMI 2, in this process",
        "FMI 3, in this process",
        "FMI 2, in its own process",
    ]
    assert all(0.0 < float(row[1]) <= float(row[2]) <= float(row[3]) for row in cells)
    assert 0.0 < float(cells[0][4]) < 100.0


def test_the_median_step_is_within_the_bar(joystick_fmus: Path) -> None:
    """On a busy machine too: the median of several rounds, the quickest of them."""
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        medians = [float(np.median(stepping.step_times(fmu, 500))) for _ in range(5)]
    assert min(medians) < 1e-6 * stepping.BAR
