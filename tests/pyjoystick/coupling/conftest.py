"""What the tests of coupled systems share."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick import Fmu


@pytest.fixture(scope="session")
def monolithic(joystick_fmus: Path) -> Callable[..., pd.Series]:
    """The joystick's angle by the same system as one model, at the instants of a coupled run."""

    def run(time: pd.Index, **parameters: float) -> pd.Series:
        with Fmu(joystick_fmus / "OperatedJoystick.fmu") as fmu:
            table = fmu.run(
                np.asarray(time), parameters=parameters, outputs=["joystick.theta"], tolerance=1e-11
            )
        return table["joystick.theta"]

    return run


_ECOS = """
import json, sys
from ecospy import EcosLib, EcosSimulation
path, step, count, name = sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
EcosLib.set_log_level("warn")
with EcosSimulation(ssp_path=path, step_size=step) as simulation:
    simulation.init()
    values = [simulation.get_real(name)]
    for _ in range(count):
        simulation.step()
        values.append(simulation.get_real(name))
print(json.dumps(values))
"""


@pytest.fixture(scope="session")
def ecos() -> Callable[..., list[float]]:
    """A function that runs an SSP archive in ecos: path, step (s), number of steps, variable -> its values.

    In a process of its own, since ecos loads FMUs into it for good. Skips where ecos cannot be loaded.
    """
    loads = subprocess.run(
        [sys.executable, "-c", "import ecospy"], capture_output=True, text=True, check=False
    )
    if loads.returncode:
        pytest.skip(f"ecos cannot be loaded: {loads.stderr.strip().splitlines()[-1]}")

    def run(path: Path, step: float, count: int, variable: str) -> list[float]:
        arguments = [str(path), str(step), str(count), variable]
        done = subprocess.run(
            [sys.executable, "-c", _ECOS, *arguments], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        values: list[float] = json.loads(done.stdout.splitlines()[-1])
        return values

    return run
