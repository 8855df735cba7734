"""Linearizations of the joystick against derivatives by hand and against its own motion."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.linalg import expm

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError, UnknownInputError
from tests.joystick_fmu.analytic import jacobian

OUTPUTS = ("alpha", "M_s", "E")


@pytest.fixture(scope="module")
def joystick(joystick_fmus: Path) -> Fmu:
    return Fmu(joystick_fmus / "Joystick.fmu")


def test_matrices_by_hand(joystick: Fmu) -> None:
    start = {"theta_start": 0.2, "omega_start": -1.5}
    found = joystick.linearize(parameters=start, inputs={"T": 0.4}, outputs=OUTPUTS)
    by_hand = jacobian(NOMINAL.to_names(), 0.2, -1.5, 0.4)
    slope, damping = by_hand["alpha", "theta"], by_hand["alpha", "omega"]
    pd.testing.assert_frame_equal(
        found.A,
        pd.DataFrame([[0.0, 1.0], [slope, damping]], ["theta", "omega"], ["theta", "omega"]),
        rtol=1e-12,
    )
    expected_b = pd.DataFrame([[0.0], [1.0 / NOMINAL.J]], ["theta", "omega"], ["T"])
    pd.testing.assert_frame_equal(found.B, expected_b, rtol=1e-12)
    c = [[by_hand.get((output, state), 0.0) for state in ("theta", "omega")] for output in OUTPUTS]
    pd.testing.assert_frame_equal(found.C, pd.DataFrame(c, OUTPUTS, ["theta", "omega"]), rtol=1e-12)
    d = [[by_hand.get((output, "T"), 0.0)] for output in OUTPUTS]
    pd.testing.assert_frame_equal(found.D, pd.DataFrame(d, OUTPUTS, ["T"]), rtol=1e-12)
    assert found.point["theta"] == 0.2
    assert found.point["T"] == 0.4


def test_along_a_motion(joystick: Fmu) -> None:
    """At a later time the point is that of the motion, and earlier calls leave no trace."""
    start = {"theta_start": math.radians(-20.0)}
    table = joystick.run(np.linspace(0.0, 0.1, 11), parameters=start, outputs=["theta", "omega"])
    for time in (0.1, 0.05, 0.1):
        found = joystick.linearize(time, parameters=start)
        theta, omega = table.loc[time, ["theta", "omega"]]
        assert (found.point["theta"], found.point["omega"]) == pytest.approx((theta, omega), abs=1e-8)
        by_hand = jacobian(NOMINAL.to_names(), found.point["theta"], found.point["omega"], 0.0)
        assert found.A.loc["omega", "theta"] == pytest.approx(by_hand["alpha", "theta"], rel=1e-12)


def test_poles_in_the_clearance_are_those_of_the_swing_test(joystick: Fmu) -> None:
    """Without springs and damping, theta'' = (m*g*h/J)*theta: the pendulum of the swing test upside down."""
    found = joystick.linearize(parameters={"theta_start": 1e-6, "damping.C": 0.0})
    swing = math.sqrt(NOMINAL.m * NOMINAL.g * NOMINAL.h / NOMINAL.J)
    poles = found.poles()
    assert list(poles["real"]) == pytest.approx([-swing, swing], rel=1e-9)
    assert list(poles["imaginary"]) == [0.0, 0.0]
    assert list(poles["damping"]) == pytest.approx([1.0, -1.0])
    assert swing / (2.0 * math.pi) == pytest.approx(1.25, abs=0.01)


def test_a_small_motion_is_that_of_the_linear_system(joystick: Fmu) -> None:
    """Around the angle where a constant torque holds the handle, with the springs released."""
    rest, offset = 0.06, 1e-6
    held = joystick.linearize(parameters={"theta_start": rest}).point
    torque = held["M_s"] - held["M_g"]
    linear = joystick.linearize(parameters={"theta_start": rest}, inputs={"T": torque})
    time = np.linspace(0.0, 0.3, 31)
    start = {"theta_start": rest + offset}
    motion = joystick.run(time, parameters=start, inputs={"T": torque}, tolerance=1e-12)["theta"] - rest
    expected = [offset * expm(linear.A.to_numpy() * t)[0, 0] for t in time]
    assert np.abs(motion - expected).max() < 1e-3 * offset
    pair = linear.poles()
    assert pair["frequency"].iloc[0] == pytest.approx(math.sqrt(-linear.A.loc["omega", "theta"]), rel=1e-12)
    assert 0.0 < pair["damping"].iloc[0] < 1.0


def test_what_is_refused(joystick: Fmu) -> None:
    with pytest.raises(ParameterError, match="time"):
        joystick.linearize(-0.1)
    with pytest.raises(UnknownInputError, match="torque"):
        joystick.linearize(inputs={"torque": 1.0})
