"""Accelerating base: against SciPy, and against the energy balance in an inertial frame."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from tests.modelica.physics import (
    GRAVITY,
    MASS,
    Array,
    Damping,
    H,
    J,
    constant_damping,
    integrated,
    power_law_damping,
    shaft_torque,
)

TIMES = np.linspace(0.0, 1.5, 301)
#: Straight lines between these rows, for the FMU and for SciPy.
ROWS = np.linspace(0.0, 1.5, 76)
SHAKING = 25.0 * np.sin(2.0 * np.pi * 3.0 * ROWS)


@pytest.mark.parametrize(("law", "damping"), [("", constant_damping), ("PowerLaw", power_law_damping)])
def test_the_motion_in_a_hand_on_a_shaking_base_is_that_of_scipy(
    law: str, damping: Damping, fmus: Path
) -> None:
    """Nonlinear, across the middle and beyond both preloads: 1e-7 rad at a tolerance of 1e-8."""

    def derivatives(time: float, state: Array, branch: int) -> list[float]:
        theta, omega = state
        hand = 4.0 * (0.05 - theta) - 0.02 * omega
        base = -MASS * H * math.cos(theta) * float(np.interp(time, ROWS, SHAKING))
        return [omega, (shaft_torque(theta, omega, damping, branch) + hand + base) / J]

    expected = integrated(derivatives, [0.0, 0.0], TIMES)[0]
    inputs = pd.DataFrame({"a_base": SHAKING, "theta_ref": 0.05, "grip": 1.0}, index=ROWS)
    with Fmu(fmus / f"MountedJoystick{law}.fmu") as fmu:
        found = fmu.run(
            TIMES,
            parameters={"hand.K": 4.0, "hand.D": 0.02},
            inputs=inputs,
            outputs=["theta"],
            tolerance=1e-8,
        )
    assert expected.min() < -0.01 < 0.01 < expected.max()
    assert np.abs(found["theta"] - expected).max() < 1e-7


#: A base goes forward (m), rises (m) and turns (rad): amplitudes and circular frequencies of three sines.
RIDE = ((0.05, 4.0 * math.pi), (0.05, 6.0 * math.pi), (0.3, 2.0 * math.pi))


def _ride(time: float, derivative: int) -> list[float]:
    """The three motions, or their first or second derivatives."""
    return [
        size * rate**derivative * math.sin(rate * time + 0.5 * math.pi * derivative) for size, rate in RIDE
    ]


def _seen_from_the_base(time: float) -> dict[str, float]:
    """What an accelerometer on the base shows, less g upward, and the angular acceleration."""
    forward, up, alpha = _ride(time, 2)
    turn = _ride(time, 0)[2]
    up += GRAVITY
    return {
        "a_base": forward * math.cos(turn) - up * math.sin(turn),
        "a_base_z": forward * math.sin(turn) + up * math.cos(turn) - GRAVITY,
        "alpha_base": alpha,
    }


@pytest.mark.parametrize(("law", "damping"), [("", constant_damping), ("PowerLaw", power_law_damping)])
def test_on_a_base_that_goes_rises_and_turns_it_moves_as_in_space(
    law: str, damping: Damping, fmus: Path
) -> None:
    """SciPy has the angle in space, where neither base nor handle is special: 1e-7 rad at 1e-8.

    The straight lines between the rows of the inputs are off by 4e-7 of the accelerations.
    """

    def derivatives(time: float, state: Array, branch: int) -> list[float]:
        psi, speed = state
        forward, up, _ = _ride(time, 2)
        theta, omega = psi - _ride(time, 0)[2], speed - _ride(time, 1)[2]
        own = shaft_torque(theta, omega, damping, branch) - MASS * GRAVITY * H * math.sin(theta)
        pull = (GRAVITY + up) * math.sin(psi) - forward * math.cos(psi)
        return [speed, (own + MASS * H * pull) / J]

    start = [0.1, _ride(0.0, 1)[2]]
    psi = integrated(derivatives, start, TIMES, lambda time, state: state[0] - _ride(time, 0)[2])[0]
    expected = psi - [_ride(time, 0)[2] for time in TIMES]
    rows = np.linspace(0.0, 1.5, 15_001)
    with Fmu(fmus / f"MountedJoystick{law}.fmu") as fmu:
        found = fmu.run(
            TIMES,
            parameters={"theta_start": 0.1},
            inputs=pd.DataFrame(map(_seen_from_the_base, rows.tolist()), index=rows),
            outputs=["theta"],
            tolerance=1e-8,
        )
    assert expected.min() < -0.04 < 0.09 < expected.max()
    assert np.abs(found["theta"] - expected).max() < 1e-7


def test_the_force_on_the_base_does_the_work(fmus: Path) -> None:
    """In space the energy changes by the work of the force that moves the base, less the damping's loss.

    The force is Newton's: the mass times the horizontal acceleration of its center. Neither it nor the energy
    is what the moment on the handle was derived from. The sum over 0.1 ms is good to 2e-5 J, for the springs'
    force has kinks.
    """
    times = np.linspace(0.0, 1.5, 15_001)
    shake = 2.0 * np.pi * 3.0
    acceleration, speed = 8.0 * np.sin(shake * times), -8.0 / shake * np.cos(shake * times)
    inputs = pd.DataFrame({"a_base": acceleration}, index=times)
    start = {"theta_start": 0.2}
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        run = fmu.run(
            times,
            parameters=start,
            inputs=inputs,
            outputs=["theta", "omega", "alpha", "E", "M_d"],
            tolerance=1e-10,
        )
    theta, omega, alpha = (run[name].to_numpy() for name in ("theta", "omega", "alpha"))
    energy = run["E"] + MASS * H * np.cos(theta) * omega * speed + 0.5 * MASS * speed**2
    force = MASS * (acceleration + H * (np.cos(theta) * alpha - np.sin(theta) * omega**2))
    power = force * speed - run["M_d"] * omega
    mean = 0.5 * (power.to_numpy()[1:] + power.to_numpy()[:-1])
    work = np.append(0.0, np.cumsum(mean * np.diff(times)))
    assert np.ptp(energy) > 0.1
    assert np.abs(energy - energy.iloc[0] - work).max() < 5e-5


def test_a_steady_acceleration_is_tilted_gravity(fmus: Path) -> None:
    """The handle leans back to where weight and inertia balance the springs: the moments add up to zero."""
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        parameters = {"hand.K": 20.0, "hand.D": 1.0}
        inputs = {"a_base": 3.0, "theta_ref": -0.2, "grip": 1.0}
        outputs = ["theta", "M_s", "M_base", "T_hand"]
        rest = fmu.run([0.0, 20.0], parameters=parameters, inputs=inputs, outputs=outputs).iloc[-1]
    theta = rest["theta"]
    tilted = MASS * H * math.hypot(GRAVITY, 3.0) * math.sin(theta - math.atan2(3.0, GRAVITY))
    assert rest["M_base"] < 0.0
    assert rest["M_s"] == pytest.approx(tilted + rest["T_hand"], abs=1e-9)
