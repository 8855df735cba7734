"""Model Exchange through FMPy's CVode."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.errors import ParameterError
from pyjoystick.fmu import FmuRunError, UnsupportedFmuError, run_model_exchange
from pyjoystick.parameters import NOMINAL
from pyjoystick.reference import simulate
from tests.pyjoystick.fmu.doctored import doctored

TIME = np.linspace(0.0, 1.0, 201)
RELEASE = {"theta_start": math.radians(-20.0)}


def test_it_follows_the_reference(joystick_path: Path, unpacking_folder: Path) -> None:
    table = run_model_exchange(joystick_path, TIME, parameters=RELEASE | {"J": 0.012})
    expected = simulate(NOMINAL.replace({"J": 0.012}), time=TIME, theta_start=RELEASE["theta_start"])
    assert np.abs(table["theta"] - expected.theta).max() < 1e-6
    np.testing.assert_array_equal(table.index, TIME)
    assert table.attrs["units"]["omega"] == "rad/s"
    assert list(unpacking_folder.iterdir()) == []


def test_a_failure_carries_what_the_fmu_said(joystick_path: Path, unpacking_folder: Path) -> None:
    with pytest.raises(FmuRunError, match=r"balanceSpring\.x_0 must not be less"):
        run_model_exchange(joystick_path, TIME, parameters={"forward.balanceSpring.x_0": 0.0})
    assert list(unpacking_folder.iterdir()) == []


def test_unequal_steps_are_refused(joystick_path: Path) -> None:
    with pytest.raises(ParameterError, match="equally spaced for Model Exchange"):
        run_model_exchange(joystick_path, [0.0, 0.1, 0.3])


def test_without_model_exchange(joystick_path: Path, tmp_path: Path) -> None:
    def only_co_simulation(text: str) -> str:
        start, end = text.index("<ModelExchange"), text.index("</ModelExchange>")
        return text[:start] + text[end + len("</ModelExchange>") :]

    path = doctored(joystick_path, tmp_path / "cs.fmu", description=only_co_simulation)
    with pytest.raises(UnsupportedFmuError, match=r"cs\.fmu: has no ModelExchange"):
        run_model_exchange(path, TIME)
