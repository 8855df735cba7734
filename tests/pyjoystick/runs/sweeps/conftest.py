"""Settings and FMUs for the tests of sweeps."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pytest

from pyjoystick.runs import Settings, Sweep, read_settings, run_sweep

Write = Callable[..., Path]

#: A sweep of the joystick that takes moments: 12 runs.
SMALL = """
[fmu]
path = "{fmus}/Joystick.fmu"

[experiment]
duration = 0.3
output_interval = 0.001

[sampling]
method = "grid"

[vary."damping.C"]
values = [0.03, 0.045, 0.06]

[vary.theta_start]
from = "-20deg"
to = "-5deg"
count = 4

[[results]]
kind = "peaks"
variable = "theta"
derivative = "omega"
count = 2

[[results]]
kind = "loss"
variable = "E"
"""

#: One that takes some seconds: 4096 runs.
LONG = """
[fmu]
path = "{fmus}/Joystick.fmu"

[experiment]
duration = 1.5
output_interval = 0.001

[sampling]
method = "sobol"
count = 4096
seed = 7

[vary."damping.C"]
distribution = "uniform"
low = 0.03
high = 0.06

[vary.theta_start]
distribution = "uniform"
low = "-20deg"
high = "20deg"

[[results]]
kind = "peaks"
variable = "theta"
derivative = "omega"
count = 3

[[results]]
kind = "extremes"
variable = "omega"
"""


@pytest.fixture
def written(tmp_path: Path, joystick_fmus: Path) -> Write:
    """Writes settings, in which {fmus} is the folder of the joystick's FMUs."""

    def write(text: str = SMALL, name: str = "sweep.toml", **places: object) -> Path:
        path = tmp_path / name
        for key, place in {"fmus": joystick_fmus, **places}.items():
            text = text.replace(f"{{{key}}}", str(place))
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture(scope="session")
def long_table(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> pd.DataFrame:
    """The results of `LONG`, carried out here without an interruption."""
    folder = tmp_path_factory.mktemp("long")
    settings = folder / "sweep.toml"
    settings.write_text(LONG.replace("{fmus}", str(joystick_fmus)), encoding="utf-8")
    outcome = run_sweep(Sweep(read_settings(settings)), folder / "whole.parquet")
    assert (outcome.found, outcome.done, outcome.failed) == (0, 4096, 0)
    assert outcome.table is not None
    return outcome.table


@pytest.fixture
def small(written: Write) -> Settings:
    return read_settings(written())


@pytest.fixture
def small_sweep(small: Settings) -> Sweep:
    return Sweep(small)
