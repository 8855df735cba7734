"""Torque and motion between stops are as without stops, and no motion passes them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.forced_motion import (
    ForwardAndReturn,
    Samples,
    ShakenJoystick,
    Shaking,
    demands,
    round_trip,
    solve,
    torque_by_fmu,
    torque_by_reference,
)
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError

pytestmark = pytest.mark.usefixtures("fmus_by_name")

STOPPED = NOMINAL.replace({"stops.theta_stop": math.radians(20.0)})


def test_within_the_stops_the_torque_is_the_same() -> None:
    motion = ForwardAndReturn(amplitude=math.radians(18.0), rise=0.12)
    samples = Samples.of(STOPPED, motion)
    torque = torque_by_fmu(STOPPED, samples)
    assert torque.equals(torque_by_fmu(NOMINAL, samples))
    assert np.abs(torque["T"] - torque_by_reference(STOPPED, samples)["T"]).max() < 1e-12
    assert round_trip(STOPPED, motion).theta_error < 1e-6
    (there,), (plain,) = (demands([one], [motion]) for one in (STOPPED, NOMINAL))
    assert there.positive_work == plain.positive_work


def test_beyond_the_stops_there_is_none() -> None:
    motion = ForwardAndReturn(amplitude=math.radians(22.0), rise=0.12)
    samples = Samples.of(STOPPED, motion)
    for torque in (torque_by_fmu, torque_by_reference):
        with pytest.raises(ParameterError, match="within the stops"):
            torque(STOPPED, samples)
    with pytest.raises(ParameterError, match="within the stops"):
        demands([NOMINAL, STOPPED], [motion])


def test_stops_end_the_large_motion_of_a_shaken_joystick() -> None:
    """0.6 N m at 4 Hz: 25.6 degrees without them. Its multipliers have the loss of impacts besides C's."""
    with Fmu("MountedJoystick") as fmu:
        shaken = ShakenJoystick(fmu, STOPPED, Shaking(torque=0.6, frequency=4.0))
        settled = shaken.with_periods(40).images(np.array([[-0.35, 0.0]]), 4.0)[0]
        motion = solve(shaken.smooth(), settled, 4.0, shaken.scales[:2])
        high, low = shaken.orbit(motion.state, 4.0).extremes
    assert motion.is_stable
    assert math.radians(20.0) < max(high, -low) < math.radians(21.0)
    assert abs(np.prod(motion.multipliers)) < math.exp(-0.045 / 0.01135 * 0.25)
    assert set(shaken.kinks(4.0)) >= {"forward stop", "backward stop"}
