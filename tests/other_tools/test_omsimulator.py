"""OMSimulator where it is installed, on an SSP archive, against the reference."""

from __future__ import annotations

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick import NOMINAL
from pyjoystick.model import simulate
from pyjoystick.runs import Component, CoupledSystem, write_ssp

RELEASE = math.radians(-20.0)


def test_free_oscillation(joystick_fmus: Path, tmp_path: Path) -> None:
    program = shutil.which("OMSimulator")
    if program is None:
        pytest.skip("OMSimulator was not found on the path")
    joystick = Component("joystick", joystick_fmus / "Joystick.fmu", {"theta_start": RELEASE})
    write_ssp(CoupledSystem("released", (joystick,), (), 1.5), tmp_path / "released.ssp")
    command = [program, "--stopTime=1.5", "--resultFile=result.csv", "--tempDir=unpacked", "released.ssp"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
    table = pd.read_csv(tmp_path / "result.csv").drop_duplicates("time")
    (theta,) = [name for name in table.columns if name.split(".")[-1] == "theta"]
    expected = simulate(NOMINAL, time=table["time"].to_numpy(), theta_start=RELEASE).theta
    assert np.abs(table[theta].to_numpy() - expected).max() < 1e-7
