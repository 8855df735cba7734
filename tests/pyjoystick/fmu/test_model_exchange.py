"""Model Exchange through FMPy's CVode."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import (
    Fmu,
    FmuRunError,
    UnsupportedFmuError,
    checked_inputs,
    read_description,
    run_model_exchange,
)
from pyjoystick.fmu.model_exchange import input_signals
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import ParameterError, SimulationError, UnknownInputError
from tests.pyjoystick.fmu.doctored import doctored
from tests.shared_fmus import SharedFmus

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


def test_a_failure_says_how_far_the_run_came(mixed_path: Path) -> None:
    with pytest.raises(FmuRunError, match="past the last moment") as caught:
        run_model_exchange(mixed_path, np.linspace(0.0, 1.0, 21), parameters={"last": 0.52})
    assert caught.value.time == pytest.approx(0.5)


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


def test_inputs_are_followed_between_the_steps(mixed_path: Path) -> None:
    """The integral of a ramp, of its kink, and of a jump: FMPy alone would be off by a step of CVode."""
    table = pd.DataFrame({"u": [0.0, 2.0, 1.0, 3.0, 3.0]}, index=[0.0, 1.0, 1.5, 1.5, 2.0])
    time = np.linspace(0.0, 2.0, 9)
    run = run_model_exchange(mixed_path, time, inputs=table, outputs=["y", "integral"])
    before = np.where(time <= 1.0, time**2, 1.0 + 2.0 * (time - 1.0) - (time - 1.0) ** 2)
    expected = np.where(time <= 1.5, before, 1.75 + 3.0 * (time - 1.5))
    assert np.abs(run["integral"] - expected).max() < 1e-8
    np.testing.assert_allclose(run["y"].iloc[:6], 2.0 * time[:6] - 4.0 * np.maximum(time[:6] - 1.0, 0.0))
    assert run["y"].iloc[-1] == 3.0


def test_inputs_that_are_not_given_keep_their_start_values(mixed_path: Path) -> None:
    for inputs in (None, {}, {"u": 0.5}):
        run = run_model_exchange(mixed_path, [0.0, 1.0, 2.0], inputs=inputs, outputs=["integral"])
        np.testing.assert_allclose(run["integral"], [0.0, 0.5, 1.0], atol=1e-9)


def test_driven_motion_is_that_of_co_simulation(joystick_path: Path) -> None:
    torque = pd.DataFrame({"T": 2.0 * np.sin(6.0 * np.pi * TIME)}, index=TIME)
    run = run_model_exchange(joystick_path, TIME, inputs=torque)
    with Fmu(joystick_path) as joystick:
        expected = joystick.run(TIME, inputs=torque, tolerance=1e-11)
    assert np.abs(run["theta"] - expected["theta"]).max() < 1e-7
    assert np.abs(run["theta"]).max() > 0.1


def test_where_cvode_gives_up(shared_fmus: SharedFmus) -> None:
    models = Path(__file__).parents[2] / "fmu_build" / "models" / "failing" / "Failing.mo"
    pole = shared_fmus.fmu("Failing.Pole", models)
    with pytest.raises(
        SimulationError, match=r"stopped at t = 0\.98 s: CVode: At t = (0\.99|1\.00)\d+"
    ) as caught:
        run_model_exchange(pole, np.linspace(0.0, 1.5, 76), outputs=["x"])
    assert not isinstance(caught.value, FmuRunError)


def test_inputs_that_are_refused(mixed_path: Path) -> None:
    with pytest.raises(UnknownInputError, match="no input 'v'"):
        run_model_exchange(mixed_path, TIME, inputs={"v": 1.0})
    with pytest.raises(ParameterError, match="u = nan"):
        run_model_exchange(mixed_path, TIME, inputs={"u": math.nan})


def test_signals_have_every_digit(echo3_path: Path) -> None:
    """Of inputs that the table gives, and of those that keep their start values; texts have no way in."""
    description = read_description(echo3_path)
    table = checked_inputs(description, {"u_UInt64": 2**64 - 1, "u_Int64": -(2**53) - 1, "u_Float32": 0.5})
    signals = input_signals(description, table)
    assert signals["u_UInt64"].tolist() == [2**64 - 1]
    assert signals["u_Int64"].tolist() == [-(2**53) - 1]
    assert (signals["u_Int8"].dtype, signals["u_Int8"].tolist()) == (np.int8, [0])
    assert "text_input" not in (signals.dtype.names or ())
    with pytest.raises(ParameterError, match="text_input = text: must be left out"):
        input_signals(description, checked_inputs(description, {"text_input": "a"}))


def test_times_at_which_steps_are_rounded_are_refused(joystick_path: Path) -> None:
    """There, FMPy's loop takes another number of samples, as if the FMU had ended the simulation."""
    with pytest.raises(
        ParameterError, match=r"time = up to 1000001 s: must be nearer to 0 for Model Exchange"
    ):
        run_model_exchange(joystick_path, 1e6 + 0.001 * np.arange(1001))
