"""The joystick in an operator's hand: pointing at each picture, and release."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu

_RELEASE = {"theta_start": math.radians(-20.0), "friction.T_c": 0.02}


@pytest.mark.parametrize("law", ["", "PowerLaw"])
def test_without_a_hand_it_is_the_joystick_to_the_last_bit(fmus: Path, law: str) -> None:
    time = np.arange(1501) * 1e-3
    with Fmu(fmus / f"HeldJoystick{law}.fmu") as held, Fmu(fmus / f"JoystickFriction{law}.fmu") as free:
        variables = free.description.variables.values()
        outputs = [one.name for one in variables if one.causality == "output"]
        left = held.run(time, parameters=_RELEASE, inputs={"theta_ref": 0.2}, outputs=outputs)
        assert left.equals(free.run(time, parameters=_RELEASE, outputs=outputs))


def test_a_hand_that_is_pointed_once_a_frame_is_that_of_a_continuous_operator(fmus: Path) -> None:
    """Wanted angle straight between 60 pictures a second, against OperatedJoystick, whose move is smooth.

    The wanted angle is right at every frame. Between two its chord is off by at most h^2/8 times the greatest
    acceleration of the move, 962 degrees/s^2: 0.033 degrees.
    """
    frames = np.round(np.arange(0.0, 1.2, 1.0 / 60.0), 12)
    with Fmu(fmus / "OperatedJoystick.fmu") as operated, Fmu(fmus / "HeldJoystick.fmu") as held:
        expected = operated.run(frames, outputs=["operator_.theta_ref", "joystick.theta", "operator_.T"])
        wanted = expected["operator_.theta_ref"].to_numpy()
        speeds = np.diff(wanted) / np.diff(frames)
        hand = pd.DataFrame(
            {
                "theta_ref": np.stack((wanted[:-1], wanted[1:]), axis=1).ravel(),
                "omega_ref": np.repeat(speeds, 2),
                "grip": 1.0,
            },
            index=np.stack((frames[:-1], frames[1:]), axis=1).ravel(),
        )
        found = held.run(frames, inputs=hand, outputs=["theta"])
    error = np.degrees(found["theta"].to_numpy() - expected["joystick.theta"].to_numpy())
    assert np.abs(error).max() < 0.03
    lag = np.degrees(expected["joystick.theta"] - expected["operator_.theta_ref"]).abs().max()
    assert lag > 3.0  # the hand gives way by far more than that


@pytest.mark.parametrize("law", ["", "PowerLaw"])
def test_a_hand_can_hold_still(fmus: Path, law: str) -> None:
    """At rest under load the speed is rounding errors about zero: no events where there is no friction."""
    time = np.arange(6000) * 1e-3
    hand = {"theta_ref": 0.349, "grip": 1.0}
    with Fmu(fmus / f"HeldJoystick{law}.fmu") as held:
        start = {"theta_start": math.radians(-20.0)}
        run = held.run(time, parameters=start, inputs=hand, outputs=["theta", "omega", "alpha", "T_hand"])
    rest = run.iloc[-1]
    assert abs(rest["omega"]) < 1e-8
    assert rest["T_hand"] == pytest.approx(25.0 * (0.349 - rest["theta"]), abs=1e-8)
