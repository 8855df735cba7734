"""The computed torque of a motion drives the joystick, in several forms of input."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Final

import fmpy
import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Interface
from pyjoystick.forced_motion import ForwardAndReturn, round_trip, torque_rows
from pyjoystick.model import NOMINAL, JoystickParameters, inverse_torque
from pyjoystick.support import ParameterError
from tests.pyjoystick.forced_motion.cases import JOYSTICKS, MOTIONS

ALLOWED: Final = 1e-6  # rad
MOTION: Final = ForwardAndReturn(amplitude=math.radians(15.0), rise=0.15, dwell=0.05, rest=0.05)
STEP: Final = 1e-3  # s


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_co_simulation_returns_the_motion(motion: ForwardAndReturn, joystick: JoystickParameters) -> None:
    """Jumps of the torque included, at the corners of raised cosine and trapezoid."""
    trip = round_trip(joystick, motion)
    assert trip.theta_error < ALLOWED
    assert trip.omega_error < 1e-4


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
@pytest.mark.parametrize("name", ["minimum-jerk +15 deg", "trapezoid -18 deg"])
def test_model_exchange_returns_the_motion(name: str, joystick: JoystickParameters) -> None:
    trip = round_trip(joystick, MOTIONS[name], interface="ModelExchange")
    assert trip.theta_error < ALLOWED


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize("interface", ["CoSimulation", "ModelExchange"])
def test_the_error_is_that_of_the_lines(interface: Interface) -> None:
    """A hundred times the distance between torque and lines is a hundred times the error of the angle."""
    coarse, fine = (
        round_trip(
            NOMINAL, MOTION, interface=interface, torque=torque_rows(NOMINAL, MOTION, tolerance=tolerance)
        )
        for tolerance in (1e-5, 1e-7)
    )
    assert 50.0 < coarse.theta_error / fine.theta_error < 200.0


def _fmpy_error(path: Path, kind: str, tolerance: float) -> float:
    """Largest error of the angle (rad) in FMPy's own loop."""
    torque = torque_rows(NOMINAL, MOTION)
    signals = np.array(
        list(zip(torque.index, torque["T"], strict=True)), dtype=[("time", np.float64), ("T", np.float64)]
    )
    result = fmpy.simulate_fmu(
        str(path),
        fmi_type=kind,
        solver="CVode",
        stop_time=MOTION.duration,
        output_interval=STEP,
        relative_tolerance=tolerance,
        record_events=False,
        input=signals,
        output=["theta"],
    )
    return float(np.max(np.abs(result["theta"] - MOTION.at(result["time"]).theta)))


def test_fmpy_alone_does_not_return_it(fmus_by_name: Path) -> None:
    """FMPy 0.3 sets inputs between CVode's steps but not inside its right-hand side: 0.4 of 15 degrees off.

    Its Co-Simulation holds each value for a step: 1.6e-3 rad at 1 ms. Ours follow the slopes.
    """
    path = fmus_by_name / "Joystick.fmu"
    exchange = _fmpy_error(path, "ModelExchange", 1e-6)
    held = _fmpy_error(path, "CoSimulation", 1e-8)
    print(f"FMPy's Model Exchange: {exchange:.2e} rad; values held for {STEP:g} s: {held:.2e} rad")
    assert exchange > 1e-3
    assert 5e-4 < held < 5e-3
    for interface in ("CoSimulation", "ModelExchange"):
        assert round_trip(NOMINAL, MOTION, interface=interface).theta_error < ALLOWED  # type: ignore[arg-type]


@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_the_lines_stay_close_to_the_torque(motion: ForwardAndReturn, joystick: JoystickParameters) -> None:
    tolerance = 1e-6
    rows = torque_rows(joystick, motion, tolerance=tolerance)
    time, torque = rows.index.to_numpy(), rows["T"].to_numpy()
    assert np.all(np.diff(time) >= 0.0)
    assert (time[0], time[-1]) == (0.0, pytest.approx(motion.duration))
    middle = 0.5 * (time[1:] + time[:-1])[np.diff(time) > 0.0]
    lines = 0.5 * (torque[1:] + torque[:-1])[np.diff(time) > 0.0]
    now = motion.at(middle)
    exact = inverse_torque(joystick, now.theta, now.omega, now.alpha).T
    assert np.abs(lines - exact).max() < 1.5 * tolerance


def test_a_jump_has_two_rows_and_nothing_else_has() -> None:
    def repeated(shape: str) -> int:
        motion = ForwardAndReturn(amplitude=0.3, rise=0.2, rest=0.1, dwell=0.1, shape=shape)  # type: ignore[arg-type]
        rows: pd.DataFrame = torque_rows(NOMINAL, motion, tolerance=1e-4)
        return int(np.count_nonzero(np.diff(rows.index) == 0.0))

    assert [repeated(shape) for shape in ("minimum-jerk", "raised-cosine", "trapezoid")] == [0, 4, 8]


def test_what_is_refused() -> None:
    with pytest.raises(ParameterError, match="tolerance = 0"):
        torque_rows(NOMINAL, MOTION, tolerance=0)
    with pytest.raises(ParameterError, match="output_interval"):
        round_trip(NOMINAL, MOTION, output_interval=-1.0)
