"""Model Exchange through FMPy's CVode."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fmu_build import FmiVersion
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
    assert caught.value.time == pytest.approx(0.515)  # of 200 steps


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


@pytest.mark.parametrize("width", [0.0005, 0.005, 0.02])
def test_a_pulse_is_not_stepped_over_at_rest(joystick_path: Path, width: float) -> None:
    pulse = pd.DataFrame(
        {"T": [0.0, 0.0, 5.0, 0.0]}, index=[0.0, 0.5031, 0.5031 + width, 0.5031 + 2.0 * width]
    )
    run = run_model_exchange(joystick_path, TIME, inputs=pulse)
    with Fmu(joystick_path) as joystick:
        expected = joystick.run(TIME, inputs=pulse, tolerance=1e-11)
    assert np.abs(expected["theta"]).max() > 1e-3
    assert np.abs(run["theta"] - expected["theta"]).max() < 1e-7


def test_a_steep_rise_elsewhere_hides_no_pulse(joystick_path: Path) -> None:
    index = [0.0, 0.6, 0.6005, 0.601, 0.9, 0.9 + 1e-12, 1.0]
    table = pd.DataFrame({"T": [0.0, 0.0, 0.2, 0.0, 0.0, 1.0, 1.0]}, index=index)
    time = np.linspace(0.0, 1.0, 51)
    with Fmu(joystick_path) as joystick:
        expected = joystick.run(time, inputs=table)["theta"].loc[:0.89]
    found = run_model_exchange(joystick_path, time, inputs=table)["theta"].loc[:0.89]
    assert np.abs(expected).max() > 1e-3
    np.testing.assert_allclose(found, expected, atol=1e-7)


def test_of_more_kinks_those_after_a_pause_are_events(mixed_path: Path) -> None:
    time = np.linspace(0.0, 2.0, 20_001)
    ripple = pd.DataFrame({"u": np.where(time > 1.0, 1.0 + 0.5 * (np.arange(20_001) % 2), 0.0)}, index=time)
    signals = input_signals(
        read_description(mixed_path), checked_inputs(read_description(mixed_path), ripple), 0.0
    )
    twice = signals["time"][1:][np.diff(signals["time"]) == 0.0]
    np.testing.assert_allclose(twice, [1.0], atol=1e-12)


def test_a_jump_at_the_start_counts(mixed_path: Path, joystick_path: Path) -> None:
    """A run begins with the last of the rows at its start, whichever came before."""
    table = pd.DataFrame({"u": [9.0, 1.0, 3.0, 3.0]}, index=[0.0, 0.5, 0.5, 1.5])
    run = run_model_exchange(mixed_path, [0.5, 1.0, 1.5], inputs=table, outputs=["integral"])
    np.testing.assert_allclose(run["integral"], [0.0, 1.5, 3.0], atol=1e-9)
    torque = pd.DataFrame({"T": [0.0, 1.5]}, index=pd.Index([0.0, 0.0], name="time"))
    found = run_model_exchange(joystick_path, TIME, inputs=torque, outputs=["T", "alpha"])
    with Fmu(joystick_path) as joystick:
        expected = joystick.run(TIME, inputs=torque, outputs=["T", "alpha"])
    assert found["T"].iloc[0] == 1.5
    assert found["alpha"].iloc[0] == pytest.approx(expected["alpha"].iloc[0], rel=1e-12)


def test_discrete_inputs(shared_fmus: SharedFmus) -> None:
    switched = shared_fmus.fmu("Switched", Path(__file__).with_name("Switched.mo"))
    constant = run_model_exchange(switched, [0.0, 0.5, 1.0], inputs={"u": 0.5, "n": 4, "on": True})
    np.testing.assert_allclose(constant["x"], [0.0, 1.0, 2.0], atol=1e-9)
    index = pd.Index([0.0, 0.0, 0.25, 0.25, 1.0], name="time")
    table = pd.DataFrame({"u": 1.0, "n": [7, 2, 2, 3, 3], "on": [False, True, True, True, True]}, index=index)
    changed = run_model_exchange(switched, [0.0, 0.5, 1.0], inputs=table)
    np.testing.assert_allclose(changed["x"], [0.0, 1.25, 2.75], atol=1e-9)


@pytest.mark.parametrize("fmi_version", ["2.0", "3.0"])
def test_discrete_inputs_beside_state_events(
    fmi_version: FmiVersion, shared_fmus: SharedFmus, tmp_path: Path
) -> None:
    """FMPy sets discrete inputs wherever CVode looks for events, which the standard forbids."""
    file = tmp_path / "Counted.mo"
    file.write_text(
        "model Counted input Integer n; input Boolean on; Real x(start = 0, fixed = true);"
        " Boolean high = x > 0.4; equation der(x) = if on then 2*n else n; end Counted;",
        "utf-8",
    )
    path = shared_fmus.fmu("Counted", file, fmi_version=fmi_version)
    index = [0.0, 0.3000123, 0.70004]
    table = pd.DataFrame({"n": [1, 1, 3], "on": [False, True, False]}, index=index)
    run = run_model_exchange(path, np.linspace(0.0, 1.0, 11), inputs=table, outputs=["x", "high"])
    end = index[1] + 2.0 * (index[2] - index[1]) + 3.0 * (1.0 - index[2])
    assert run["x"].iloc[-1] == pytest.approx(end, abs=1e-9)
    assert list(run["high"]) == [False] * 4 + [True] * 7


def test_few_outputs_of_a_long_run(joystick_path: Path) -> None:
    """FMPy lets CVode take at most 500 steps from one to the next."""
    run = run_model_exchange(joystick_path, [0.0, 1.0, 2.0], inputs={"T": 1.0})
    with Fmu(joystick_path) as joystick:
        expected = joystick.run([0.0, 1.0, 2.0], inputs={"T": 1.0})
    assert np.abs(run["theta"] - expected["theta"]).max() < 1e-7


def test_equal_steps_far_from_zero(joystick_path: Path) -> None:
    late = run_model_exchange(
        joystick_path, 86_400.0 + np.arange(80) / 240.0, parameters={"theta_start": 0.3}
    )
    early = run_model_exchange(joystick_path, np.arange(80) / 240.0, parameters={"theta_start": 0.3})
    assert np.abs(late["theta"].to_numpy() - early["theta"].to_numpy()).max() < 1e-6


def test_where_cvode_gives_up(shared_fmus: SharedFmus) -> None:
    models = Path(__file__).parents[2] / "fmu_build" / "models" / "failing" / "Failing.mo"
    pole = shared_fmus.fmu("Failing.Pole", models)
    with pytest.raises(
        SimulationError, match=r"stopped at t = 0\.99\d* s: CVode: At t = (0\.99|1\.00)\d+"
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
    signals = input_signals(description, table, 0.0)
    assert signals["u_UInt64"].tolist() == 2 * [2**64 - 1]  # FMPy needs two rows
    assert signals["u_Int64"].tolist() == 2 * [-(2**53) - 1]
    assert (signals["u_Int8"].dtype, signals["u_Int8"].tolist()) == (np.int8, [0, 0])
    assert "text_input" not in (signals.dtype.names or ())
    with pytest.raises(ParameterError, match="text_input = text: must be left out"):
        input_signals(description, checked_inputs(description, {"text_input": "a"}), 0.0)


def test_times_at_which_steps_are_rounded_are_refused(joystick_path: Path) -> None:
    """There, FMPy's loop takes another number of samples, as if the FMU had ended the simulation."""
    with pytest.raises(
        ParameterError, match=r"time = up to 1000001 s: must be nearer to 0 for Model Exchange"
    ):
        run_model_exchange(joystick_path, 1e6 + 0.001 * np.arange(1001))


@pytest.mark.parametrize("start", [0.0, 1e3, 1e4])
@pytest.mark.parametrize("at", [0.1, 0.1234])
def test_a_jump_late_in_time(joystick_path: Path, start: float, at: float) -> None:
    """FMPy takes times for equal that differ by 1e-9 of the time: it would apply the jump too early."""
    table = pd.DataFrame({"T": [0.5, 0.5, -1.0, -1.0]}, index=[start, start + at, start + at, start + 1.0])
    time = start + np.linspace(0.0, 0.3, 301)
    settings = {"parameters": {"theta_start": -0.3}, "inputs": table, "outputs": ["theta"]}
    exchange = run_model_exchange(joystick_path, time, **settings)
    with Fmu(joystick_path) as fmu:
        np.testing.assert_allclose(exchange["theta"], fmu.run(time, **settings)["theta"], rtol=0, atol=1e-8)


def test_an_event_beside_a_sample_late_in_time(joystick_path: Path) -> None:
    """FMPy would record the event at 100000.06498 s instead of the sample 2e-5 s later."""
    time = np.linspace(0.0, 0.3, 301)
    settings = {"parameters": {"theta_start": -0.3}, "outputs": ["theta"]}
    late = run_model_exchange(joystick_path, 1e5 + time, **settings)
    with Fmu(joystick_path) as fmu:
        np.testing.assert_allclose(late["theta"], fmu.run(time, **settings)["theta"], rtol=0.0, atol=2e-8)


def test_a_time_event_before_a_sample_late_in_time(shared_fmus: SharedFmus, tmp_path: Path) -> None:
    """FMPy would carry it out at the sample, 4e-4 s late."""
    file = tmp_path / "Sched.mo"
    file.write_text(
        "model Sched parameter Real t0 = 0; Integer k(start = 0, fixed = true); discrete Real next(start = t0"
        " + 0.07, fixed = true); Real x(start = 0, fixed = true); equation when time >= pre(next) then"
        " k = pre(k) + 1; next = pre(next) + 0.07; end when; der(x) = k; end Sched;",
        "utf-8",
    )
    start = 1e6
    time = start + 4e-4 + 0.07 * np.arange(15)
    run = run_model_exchange(shared_fmus.fmu("Sched", file), time, parameters={"t0": start}, outputs=["x"])
    ticks = start + 0.07 * np.arange(1, 20)
    expected = [np.clip(now - ticks, 0.0, None).sum() for now in time]
    np.testing.assert_allclose(run["x"], expected, rtol=0.0, atol=1e-7)
