"""Runs of a loaded FMU: results, independence of earlier runs, and messages of failures."""

from __future__ import annotations

import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu, FmuRunError
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.awkward import Trouble
from tests.pyjoystick.fmu.doctored import doctored

TIME = np.linspace(0.0, 0.5, 101)
RELEASE = {"theta_start": math.radians(-20.0)}


def test_the_table_follows_the_reference_and_carries_units(joystick: Fmu) -> None:
    table = joystick.run(TIME, parameters=RELEASE)
    assert tuple(table.columns) == joystick.description.names("output")
    assert table.index.name == "time"
    np.testing.assert_array_equal(table.index, TIME)
    expected = simulate(NOMINAL, time=TIME, theta_start=RELEASE["theta_start"])
    assert np.abs(table["theta"] - expected.theta).max() < 1e-7
    assert table.attrs["units"]["alpha"] == "rad/s2"
    assert table.attrs["display_units"]["theta"] == {
        "unit": "deg",
        "factor": pytest.approx(math.degrees(1.0)),
        "offset": 0.0,
    }
    assert "omega" in table.attrs["descriptions"]


def test_the_tolerance_reaches_the_integrator(joystick: Fmu) -> None:
    expected = simulate(NOMINAL, time=TIME, theta_start=RELEASE["theta_start"]).theta
    coarse, fine = (
        np.abs(joystick.run(TIME, parameters=RELEASE, tolerance=tolerance)["theta"] - expected).max()
        for tolerance in (1e-4, 1e-10)
    )
    assert fine < coarse / 100.0


def test_the_run_may_start_late_and_have_unequal_steps(joystick: Fmu) -> None:
    time = np.array([0.2, 0.21, 0.3, 0.7])
    table = joystick.run(time, parameters=RELEASE, outputs=["theta"])
    expected = simulate(NOMINAL, time=time, theta_start=RELEASE["theta_start"]).theta
    assert np.abs(table["theta"] - expected).max() < 1e-7


@pytest.mark.parametrize(("start", "error"), [(1e5, 1e-8), (1e7, 1e-6), (1.6e9, 1e-4)])
@pytest.mark.parametrize("step", [1.0 / 64.0, 1e-3])
def test_the_clock_may_show_any_time(joystick: Fmu, start: float, error: float, step: float) -> None:
    """Events beside communication points; errors are rounding of the events' times, 2.4e-7 s at 1.6e9 s."""
    time = np.arange(0.0, 1.0, step)
    for angle in (-0.35, -0.3, -0.2, -0.1):
        settings = {"parameters": {"theta_start": angle}, "outputs": ["theta"]}
        expected = joystick.run(time, **settings)["theta"]
        found = joystick.run(start + time, **settings)["theta"]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=error)


def test_outputs_are_the_named_variables_in_their_order(joystick: Fmu) -> None:
    names = ["omega", "forward.returnSpring.isEngaged", "theta", "m"]
    table = joystick.run(TIME, outputs=[*names, "omega"], parameters=RELEASE)
    assert list(table.columns) == names
    assert table["forward.returnSpring.isEngaged"].dtype == np.bool_
    assert set(table["m"]) == {0.87}
    clear = table["theta"].abs() > math.radians(1.0)
    engaged = table["forward.returnSpring.isEngaged"][clear]
    assert (engaged == (table["theta"][clear] > 0.0)).all()
    assert engaged.any()


def test_one_output_may_be_given_bare(joystick: Fmu) -> None:
    assert list(joystick.run(TIME, outputs="theta").columns) == ["theta"]


def test_runs_leave_no_trace(joystick: Fmu) -> None:
    first = joystick.run(TIME, parameters=RELEASE)
    joystick.run(TIME, parameters={"J": 0.02, "theta_start": 0.1}, inputs={"T": 0.3}, tolerance=1e-4)
    pd.testing.assert_frame_equal(joystick.run(TIME, parameters=RELEASE), first, check_exact=True)
    assert (joystick.run(TIME)["theta"] == 0.0).all()


def test_a_failed_run_leaves_no_trace_either(joystick: Fmu) -> None:
    first = joystick.run(TIME, parameters=RELEASE)
    with pytest.raises(FmuRunError):
        joystick.run(TIME, parameters={"forward.balanceSpring.x_0": 0.0})
    pd.testing.assert_frame_equal(joystick.run(TIME, parameters=RELEASE), first, check_exact=True)


def test_a_refused_start_carries_what_the_fmu_said(joystick: Fmu, joystick_path: Path) -> None:
    with pytest.raises(FmuRunError) as caught:
        joystick.run(TIME, parameters={"forward.balanceSpring.x_0": 0.0})
    error = caught.value
    assert error.path == joystick_path
    assert error.time == 0.0
    assert any("forward.balanceSpring.x_0 must not be less than" in message for message in error.messages)
    assert "fmi2ExitInitializationMode" in error.reason
    assert str(error).startswith("Joystick.fmu at t = 0 s: ")
    assert error.messages[0].rstrip(".") in str(error)
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), vars(copy)) == (str(error), vars(error))


def test_a_failing_step_names_the_time_that_was_reached(mixed: Fmu) -> None:
    with pytest.raises(
        FmuRunError, match=r"Mixed\.fmu at t = 0\.2 s: .*past the last moment 100 %"
    ) as caught:
        mixed.run([0.0, 0.1, 0.2, 0.3, 0.4], parameters={"last": 0.25})
    assert caught.value.time == 0.2
    with pytest.raises(FmuRunError) as second:  # and the messages of an earlier failure are not told again
        mixed.run([0.0, 0.1], parameters={"last": 0.05})
    assert len(second.value.messages) == len(caught.value.messages) > 0


def test_variables_of_several_types(mixed: Fmu) -> None:
    time = np.linspace(0.0, 1.0, 11)
    parameters: dict[str, Any] = {"n": 5, "inverted": True, "gain": -2.0, "integral": 0.5}
    table = mixed.run(time, parameters=parameters, inputs={"u": 0.9})
    np.testing.assert_allclose(table["integral"], 0.5 + 0.9 * time, rtol=1e-12)
    assert (table["y"] == -1.8).all()
    assert list(table["steps"]) == [5 if value > 1.0 else -5 for value in 0.5 + 0.9 * time]
    assert table["steps"].dtype == np.int32
    assert table["above"].all()
    with pytest.raises(ParameterError, match="n = 10: must be an integer from 1 to 9"):
        mixed.run(time, parameters={"n": 10})


def test_after_a_fatal_failure_there_is_a_new_instance(awkward_fmu: Fmu) -> None:
    """The library aborts at a call to the old one."""
    sound = awkward_fmu.run(TIME, inputs={"u": 1.0})
    for trouble in (Trouble.FATAL, Trouble.FATAL_RESET, Trouble.NO_RESET, Trouble.FATAL):
        if trouble == Trouble.FATAL:
            with pytest.raises(
                FmuRunError, match=r"at t = 0\.3 s: trouble at 0\.3 \(fmi2DoStep failed with .*fatal"
            ):
                awkward_fmu.run(TIME, parameters={"trouble": trouble, "when": 0.2999})
        else:
            awkward_fmu.run(TIME, parameters={"trouble": trouble})
        pd.testing.assert_frame_equal(awkward_fmu.run(TIME, inputs={"u": 1.0}), sound, check_exact=True)


@pytest.mark.parametrize(
    ("time", "message"),
    [
        ([0.0], "two or more instants"),
        ([0.0, math.nan], r"time\[1\] = nan"),
        ([0.0, 0.2, 0.1], r"time\[2\] = 0.1"),
    ],
)
def test_times_that_are_refused(joystick: Fmu, time: list[float], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        joystick.run(time)


@pytest.mark.parametrize("tolerance", [0.0, -1e-8, math.nan, math.inf])
def test_tolerances_that_are_refused(joystick: Fmu, tolerance: float) -> None:
    with pytest.raises(ParameterError, match="tolerance = "):
        joystick.run(TIME, tolerance=tolerance)


def test_two_fmus_at_once_do_not_meddle(joystick_path: Path, mixed: Fmu) -> None:
    with Fmu(joystick_path) as first, Fmu(joystick_path) as second:
        alone = first.run(TIME, parameters=RELEASE)
        second.run(TIME, parameters={"theta_start": 0.2})
        with pytest.raises(FmuRunError, match=r"balanceSpring\.x_0 must not be less"):
            first.run(TIME, parameters={"forward.balanceSpring.x_0": 0.0})
        with pytest.raises(FmuRunError, match="past the last moment") as caught:
            mixed.run(TIME, parameters={"last": 0.1})
        assert not any("must be positive" in message for message in caught.value.messages)
        pd.testing.assert_frame_equal(second.run(TIME, parameters=RELEASE), alone, check_exact=True)


@pytest.mark.parametrize(("variable_steps", "steps"), [(True, 4), (False, 2)])
def test_an_fmu_with_fixed_steps_gets_equal_ones_at_the_output_instants_only(
    variable_steps: bool, steps: int, awkward_path: Path, tmp_path: Path
) -> None:
    attribute = "canHandleVariableCommunicationStepSize"
    path = doctored(
        awkward_path,
        tmp_path / "fixed.fmu",
        description=lambda text: text.replace(
            f'{attribute}="true"', f'{attribute}="{str(variable_steps).lower()}"'
        ),
    )
    with Fmu(path) as fmu:
        table = fmu.run([0.0, 0.25, 0.5], inputs=pd.DataFrame({"u": [0.0, 1.0]}, index=[0.123, 0.456]))
        assert table["steps"].iloc[-1] == steps
        if variable_steps:
            assert fmu.run([0.0, 0.2, 0.5])["steps"].iloc[-1] == 2
            return
        with pytest.raises(
            ParameterError, match=r"steps of 0\.2 s to 0\.3 s: must be equally spaced \(fixed\.fmu"
        ):
            fmu.run([0.0, 0.2, 0.5])
        with fmu.start() as stepper:
            for length in (0.2, 0.2, 0.2):
                stepper.step(length)
            with pytest.raises(
                ParameterError, match=r"length = 0\.3: must be 0\.2 s, as the first \(fixed\.fmu"
            ):
                stepper.step(0.3)
            assert stepper.step(0.2)["steps"] == 4


@pytest.mark.parametrize(
    ("tool", "stop_time"), [("pyjoystick", 0.5), ("OpenModelica Compiler OMCompiler v1.14.2", -1.0)]
)
def test_openmodelica_is_not_told_when_the_run_ends(
    tool: str, stop_time: float, awkward_path: Path, tmp_path: Path
) -> None:
    """Old ones would go there in the first step."""
    renamed = doctored(
        awkward_path,
        tmp_path / "renamed.fmu",
        description=lambda text: text.replace('generationTool=""', f'generationTool="{tool}"'),
    )
    with Fmu(renamed) as fmu:
        assert set(fmu.run(TIME, outputs="stop")["stop"]) == {stop_time}
