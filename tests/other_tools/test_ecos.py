"""ecos, a co-simulation engine in C++ of its own, against the reference."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.model import JoystickParameters, simulate
from tests.other_tools.programs import require, run

RELEASE = math.radians(-20.0)
STEP = 1e-3

PROGRAM = """
from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure
EcosLib.set_log_level("warn")
with EcosSimulationStructure() as structure:
    structure.add_model("joystick", fmu)
    structure.add_parameter_set("release", {"joystick::theta_start": release})
    with EcosSimulation(structure=structure, step_size=step) as simulation:
        simulation.init(parameter_set="release")
        theta = [simulation.get_real("joystick::theta")]
        for _ in range(count):
            simulation.step()
            theta.append(simulation.get_real("joystick::theta"))
print(json.dumps(theta))
"""


@pytest.mark.parametrize("folder", ["joystick_fmus", "joystick_fmus3"])
@pytest.mark.parametrize(
    ("name", "parameters"), [("Joystick", NOMINAL), ("JoystickPowerLaw", NOMINAL_POWER_LAW)]
)
def test_free_oscillation(
    name: str, parameters: JoystickParameters, folder: str, request: pytest.FixtureRequest
) -> None:
    require("ecospy")
    fmu: Path = request.getfixturevalue(folder) / f"{name}.fmu"
    theta = run(PROGRAM, fmu=str(fmu), release=RELEASE, step=STEP, count=1500)
    expected = simulate(parameters, time=STEP * np.arange(1501), theta_start=RELEASE).theta
    assert np.abs(np.array(theta) - expected).max() < 1e-7
