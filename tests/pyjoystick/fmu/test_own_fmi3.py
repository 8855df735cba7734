"""The joystick's FMI 3 FMUs give the results of the FMI 2 FMUs in every way of running them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from pyjoystick.cli import app
from pyjoystick.fmu import Final, Fmu, FmuRunError, read_description, run_model_exchange
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import ParameterError, PyJoystickError

TIME = np.linspace(0.0, 1.0, 501)
RELEASE = {"theta_start": math.radians(-20.0)}


@pytest.fixture
def old(joystick_fmus: Path) -> Path:
    """Of FMI 2."""
    return joystick_fmus / "Joystick.fmu"


@pytest.fixture
def new(joystick_fmus3: Path) -> Path:
    """Of FMI 3."""
    return joystick_fmus3 / "Joystick.fmu"


def test_the_same_bits(old: Path, new: Path, loop: str) -> None:
    """Both are one runtime and one model; held inputs included."""
    outputs = ["theta", "omega", "alpha", "E", "forward.returnSpring.isEngaged"]
    with Fmu(old) as fmu2, Fmu(new) as fmu3:
        runs = [fmu.run(TIME, parameters=RELEASE, inputs={"T": 0.5}, outputs=outputs) for fmu in (fmu2, fmu3)]
    pd.testing.assert_frame_equal(runs[0], runs[1], check_exact=True)
    assert runs[0].attrs["units"] == runs[1].attrs["units"]


@pytest.mark.parametrize("own_process", [False, True])
def test_inputs_that_move(old: Path, new: Path, loop: str, own_process: bool) -> None:
    """Straight within a step, with kinks and jumps: FMI 2 is told the slopes, FMI 3 asks for the values."""
    drive = pd.DataFrame({"T": [0.0, 0.9, 0.4, -0.6, -0.6]}, index=[0.0, 0.213, 0.5, 0.5, 0.9])
    coarse = np.linspace(0.0, 1.0, 21)
    runs = []
    for path in (old, new):
        with Fmu(path, own_process=own_process) as fmu:
            idle = fmu.run(coarse, parameters=RELEASE)
            runs.append(fmu.run(coarse, parameters=RELEASE, inputs=drive, outputs=["theta", "omega"]))
            pd.testing.assert_frame_equal(fmu.run(coarse, parameters=RELEASE), idle, check_exact=True)
    # At the jump the integrator begins anew with another first step; until then the bits are the same.
    pd.testing.assert_frame_equal(runs[0][:0.5], runs[1][:0.5], check_exact=True)
    assert np.abs(runs[0] - runs[1])["theta"].max() < 1e-8

    def torque(time: float) -> float:
        return float(np.interp(time, drive.index[:3] if time < 0.5 else drive.index[3:],
                               drive["T"].iloc[:3] if time < 0.5 else drive["T"].iloc[3:]))  # fmt: skip

    exact = simulate(NOMINAL, time=coarse, torque=torque, torque_breakpoints=drive.index, **RELEASE)
    assert np.abs(runs[1]["theta"] - exact.theta).max() < 1e-6


def test_batches_with_inputs_that_move(old: Path, new: Path) -> None:
    drive = pd.DataFrame({"T": [0.0, 1.0]}, index=[0.0, 1.0])
    found = []
    for path in (old, new):
        with Fmu(path) as fmu:
            plan = fmu.plan(TIME[::50], varied="theta_start", inputs=drive, outputs="theta")
            found.append(plan.run_batch(np.radians([[-20.0], [-3.0], [8.0]] * 3), threads=2).values)
    np.testing.assert_array_equal(*found)


def test_a_closed_fmu_says_so_to_inputs_that_move(new: Path) -> None:
    drive = pd.DataFrame({"T": [0.0, 1.0]}, index=[0.0, 1.0])
    fmu = Fmu(new)
    plan = fmu.plan(TIME, varied="theta_start", inputs=drive, outputs="theta")
    fmu.run(TIME, inputs=drive)
    fmu.close()
    for call in (lambda: fmu.run(TIME, inputs=drive), lambda: plan.run([0.1])):
        with pytest.raises(PyJoystickError, match="has been closed"):
            call()


def test_batches(old: Path, new: Path) -> None:
    angles = np.radians([[-20.0], [-10.0], [5.0], [15.0]] * 5)
    results = []
    for path in (old, new):
        with Fmu(path) as fmu:
            plan = fmu.plan(TIME, varied="theta_start", outputs="theta")
            results.append(plan.run_batch(angles, reductions=[Final("theta")], threads=2))
    assert not results[1].failed.any()
    np.testing.assert_array_equal(results[0].reduced["theta.final"], results[1].reduced["theta.final"])


def test_failures_say_why(new: Path) -> None:
    with Fmu(new) as fmu:
        with pytest.raises(FmuRunError, match=r"backward\.balanceSpring\.x_0 must not be less"):
            fmu.run(TIME, parameters={"backward.balanceSpring.x_0": 0.0})
        with pytest.raises(ParameterError):
            fmu.run(TIME, parameters={"J": -1.0})
        assert len(fmu.run(TIME, parameters=RELEASE)) == len(TIME), "the next run goes well"


def test_model_exchange(new: Path) -> None:
    table = run_model_exchange(new, TIME, parameters=RELEASE | {"J": 0.012})
    expected = simulate(NOMINAL.replace({"J": 0.012}), time=TIME, theta_start=RELEASE["theta_start"])
    assert np.abs(table["theta"] - expected.theta).max() < 1e-6


def test_model_exchange_follows_inputs(old: Path, new: Path) -> None:
    torque = pd.DataFrame({"T": 2.0 * np.sin(6.0 * TIME)}, index=TIME)
    runs = [run_model_exchange(path, TIME, inputs=torque, outputs=["theta"]) for path in (old, new)]
    assert np.abs(runs[0]["theta"] - runs[1]["theta"]).max() < 1e-9
    assert np.ptp(runs[1]["theta"]) > 0.01


def test_descriptions_agree(old: Path, new: Path) -> None:
    first, second = read_description(old), read_description(new)
    assert second.fmi_version == "3.0"
    assert set(second.variables) - set(first.variables) == {f"eventIndicator[{i}]" for i in range(1, 10)}
    for name, variable in first.variables.items():
        other = second.variables[name]
        assert other.quantity == variable.quantity
        assert (other.start, other.minimum, other.maximum) == (
            variable.start,
            variable.minimum,
            variable.maximum,
        )
        assert other.settable_at_start == variable.settable_at_start
    assert first.experiment == second.experiment


def test_command_line(old: Path, new: Path) -> None:
    runner = CliRunner()
    shown = runner.invoke(app, ["info", str(new)])
    assert shown.exit_code == 0, shown.output
    assert "3.0" in shown.output
    compared = runner.invoke(app, ["compare", str(old), str(new), "--release-angle", "-10"])
    assert compared.exit_code == 0, compared.output
