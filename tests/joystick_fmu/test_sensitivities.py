"""Sensitivities of the joystick FMUs, against variational equations integrated by SciPy."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import MODELS, Fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from tests.pyjoystick.random_parameters import RandomCase, random_cases
from tests.shared_fmus import SharedFmus

from .variational import Joystick

#: Inertia, damping, the start, and two springs' parameters that move events.
COMMON = ["J", "theta_start", "omega_start", "backward.returnSpring.x_0", "forward.balanceSpring.k_h"]
PARAMETERS = {
    "Joystick": [*COMMON, "damping.C"],
    "JoystickPowerLaw": [*COMMON, "damping.A_neg", "damping.n_neg", "damping.B"],
}
CASES = [("Joystick", case) for case in random_cases(NOMINAL, 25)] + [
    ("JoystickPowerLaw", case) for case in random_cases(NOMINAL_POWER_LAW, 25)
]
TIMES = np.linspace(0.0, 1.5, 151)
STATES = ("theta", "omega")


@pytest.mark.parametrize("model", PARAMETERS)
def test_the_model_itself_stays_as_it_is(model: str, joystick_fmus: Path) -> None:
    """Without sensitivities there is no trace of them; with them all variables keep their bits."""
    paths = (joystick_fmus / f"{model}.fmu", joystick_fmus / "sensitivities" / f"{model}.fmu")
    plain, extended = (_generated(path) for path in paths)
    assert "sensitivity" not in plain
    assert "sensitivity" in extended
    for kind in "YP":
        numbered = re.compile(rf"^    ({kind}_\w+),", re.MULTILINE)
        more = iter(numbered.findall(extended))
        assert all(name in more for name in numbered.findall(plain))  # in the same order
    random = np.random.default_rng(1)
    starts = random.uniform([-1.2, -9.0, -3.0], [1.2, 9.0, 3.0], (40, 3))
    with Fmu(paths[0]) as without, Fmu(paths[1]) as with_them:
        shared = [one.name for one in without.description.variables.values() if one.name != "time"]
        points = [
            fmu.plan(
                [0.0, 1e-9], varied=["theta_start", "omega_start"], inputs={"T": torque}, outputs=shared
            ).run([theta, omega])[0]
            for theta, omega, torque in starts
            for fmu in (without, with_them)
        ]
    np.testing.assert_array_equal(points[::2], points[1::2])


def _generated(path: Path) -> str:
    with zipfile.ZipFile(path) as archive:
        return archive.read("sources/model.c").decode()


def _fmu(model: str, fmus: SharedFmus) -> Path:
    request = f"{','.join(STATES)}:{','.join(PARAMETERS[model])}"
    return fmus.fmu(MODELS[model], sensitivity=request)


def _expected(model: str, case: RandomCase) -> tuple[dict[str, np.ndarray], int]:
    parameters = PARAMETERS[model]
    joystick = Joystick(case.parameters.to_names(), parameters)
    rows, events = joystick.motion(TIMES, case.theta_start)
    names = [f"sensitivity.{state}.{parameter}" for parameter in parameters for state in STATES]
    return dict(zip([*STATES, *names], rows, strict=True)), events


def _worst(fmu: Fmu, case: RandomCase, expected: dict[str, np.ndarray], tolerance: float) -> float:
    """The largest error of a sensitivity over the run, relative to its largest value."""
    values = {**case.parameters.to_names(), "theta_start": case.theta_start}
    table = fmu.run(TIMES, parameters=values, outputs=list(expected), tolerance=tolerance)
    return max(
        float(np.abs(table[name].to_numpy() - column).max() / np.abs(column).max())
        for name, column in expected.items()
        if name not in STATES and column.any()
    )


@pytest.mark.parametrize(("model", "case"), CASES, ids=[case.name for _, case in CASES])
def test_random_joysticks(model: str, case: RandomCase, shared_fmus: SharedFmus) -> None:
    """On average 162 events with constant damping and 111 with eq. (11); 13 in the smallest release."""
    expected, events = _expected(model, case)
    assert events > 10
    with Fmu(_fmu(model, shared_fmus)) as fmu:
        assert _worst(fmu, case, expected, 1e-8) < 1e-5
        assert _worst(fmu, case, expected, 1e-10) < 5e-7
