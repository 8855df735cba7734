"""CasADi's DaeBuilder: the FMU as a function to differentiate and integrate, against the reference.

CasADi sets states and asks for derivatives without handling events, so that the branch stays that of the
start. The motions here stay within one: from 6 degrees down to 1 degree, between two kinks of the springs.
"""

from __future__ import annotations

import math
import zipfile
from pathlib import Path
from typing import cast

import numpy as np
import pytest

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.model import JoystickParameters, simulate
from tests.joystick_fmu.analytic import jacobian
from tests.other_tools.programs import require, run

RELEASE = math.radians(6.0)
STEP = 5e-4
COUNT = 80

PROGRAM = """
import casadi
dae = casadi.DaeBuilder("joystick", folder, {})
dae.set("theta_start", release)
f = dae.create("f", ["x", "u"], ["ode"])
x, u = casadi.MX.sym("x", 2), casadi.MX.sym("u")
problem = {"x": x, "u": u, "ode": f(x, u)}
times = [step * i for i in range(1, count + 1)]
integrator = casadi.integrator("motion", "cvodes", problem, 0.0, times, {"reltol": 1e-11, "abstol": 1e-13})
motion = integrator(x0=[release, 0.0], u=0.0)["xf"]
print(json.dumps(motion.full().tolist()))
"""


@pytest.fixture(
    params=[("Joystick", NOMINAL), ("JoystickPowerLaw", NOMINAL_POWER_LAW)], ids=lambda one: one[0]
)
def parameters(request: pytest.FixtureRequest, joystick_fmus: Path, tmp_path: Path) -> JoystickParameters:
    """Those of a joystick whose FMU is unpacked in the test's folder."""
    require("casadi")
    name, found = request.param
    with zipfile.ZipFile(joystick_fmus / f"{name}.fmu") as archive:
        archive.extractall(tmp_path)
    return cast("JoystickParameters", found)


def test_motion_within_a_branch(parameters: JoystickParameters, tmp_path: Path) -> None:
    theta, omega = run(PROGRAM, folder=str(tmp_path), release=RELEASE, step=STEP, count=COUNT)
    expected = simulate(parameters, time=STEP * np.arange(COUNT + 1), theta_start=RELEASE)
    assert not expected.events
    assert 0.0 < expected.theta[-1] < math.radians(2.0)
    assert np.abs(theta - expected.theta[1:]).max() < 1e-8
    assert np.abs(omega - expected.omega[1:]).max() < 1e-6


JACOBIAN = """
import casadi
dae = casadi.DaeBuilder("joystick", folder, {})
dae.set("theta_start", release)
f = dae.create("f", ["x", "u"], ["ode"], {"uses_directional_derivatives": True})
jacobian = f.factory("jacobian", ["x", "u"], ["jac:ode:x", "jac:ode:u"])
by_x, by_u = jacobian([release, omega], torque)
print(json.dumps([by_x.full().tolist(), by_u.full().tolist()]))
"""


def test_jacobian_is_that_of_the_fmu(parameters: JoystickParameters, tmp_path: Path) -> None:
    """From directional derivatives: differences of the states' rates would be off by about 1e-8."""
    by_x, by_u = run(JACOBIAN, folder=str(tmp_path), release=RELEASE, omega=-0.7, torque=0.2)
    expected = jacobian(parameters.to_names(), RELEASE, -0.7, 0.2)
    assert by_x[0] == [0.0, 1.0]
    assert by_x[1] == pytest.approx([expected["alpha", known] for known in ("theta", "omega")], rel=1e-12)
    assert by_u == [[0.0], [pytest.approx(1.0 / parameters.J, rel=1e-12)]]
