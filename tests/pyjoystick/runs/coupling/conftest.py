"""Fixtures for the tests of coupled systems."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick import Fmu
from tests.other_tools.programs import require, run


@pytest.fixture(scope="session")
def monolithic(joystick_fmus: Path) -> Callable[..., pd.Series]:
    """The joystick's angle by the same system as one model, at the instants of a coupled run."""

    def angle(time: pd.Index, **parameters: float) -> pd.Series:
        with Fmu(joystick_fmus / "OperatedJoystick.fmu") as fmu:
            table = fmu.run(
                np.asarray(time), parameters=parameters, outputs=["joystick.theta"], tolerance=1e-11
            )
        return table["joystick.theta"]

    return angle


Ecos = Callable[[Path, float, int, str], list[float]]
_ECOS = """
from ecospy import EcosLib, EcosSimulation
EcosLib.set_log_level("warn")
with EcosSimulation(ssp_path=path, step_size=step) as simulation:
    simulation.init(parameter_set="parameters")
    values = [simulation.get_real(variable)]
    for _ in range(count):
        simulation.step()
        values.append(simulation.get_real(variable))
print(json.dumps(values))
"""


@pytest.fixture(scope="session")
def ecos() -> Ecos:
    """Runs an SSP archive in ecos: path, step (s), number of steps, variable -> its values."""
    require("ecospy")

    def values(path: Path, step: float, count: int, variable: str) -> list[float]:
        found: list[float] = run(_ECOS, path=str(path), step=step, count=count, variable=variable)
        return found

    return values
