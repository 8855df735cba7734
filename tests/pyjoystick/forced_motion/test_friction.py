"""Torque from motion and motion from torque, with dry friction."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.forced_motion import (
    ForwardAndReturn,
    Samples,
    columns_of,
    measure,
    round_trip,
    torque_by_fmu,
    torque_by_reference,
)
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, static_friction

pytestmark = pytest.mark.usefixtures("fmus_by_name")

FRICTION = {"friction.T_c": 0.03, "friction.T_s": 0.06, "friction.omega_s": 0.1, "friction.F_c": 1.0}
JOYSTICKS = [NOMINAL.replace(FRICTION), NOMINAL_POWER_LAW.replace(FRICTION)]
MOTION = ForwardAndReturn(amplitude=math.radians(-15.0), rise=0.12, dwell=0.1, shape="trapezoid")


@pytest.mark.parametrize("joystick", JOYSTICKS, ids=["constant", "power law"])
def test_the_torque_returns_the_motion_and_holds_it_at_rest(joystick: JoystickParameters) -> None:
    trip = round_trip(joystick, MOTION)
    # At the contact with the plunger, where its friction begins, a row may lie on the wrong side.
    assert trip.theta_error < 1e-6
    dwell = (trip.found.index > 0.13) & (trip.found.index < 0.21)
    assert (trip.found["omega"][dwell] == 0.0).all()


@pytest.mark.parametrize("joystick", JOYSTICKS, ids=["constant", "power law"])
def test_inverse_fmus_and_plain_python_agree(joystick: JoystickParameters) -> None:
    samples = Samples.of(joystick, MOTION)
    found, expected = torque_by_fmu(joystick, samples), torque_by_reference(joystick, samples)
    assert list(found.columns) == list(expected.columns)
    for name in columns_of(joystick):
        assert np.abs(found[name] - expected[name]).max() < 1e-12
    at_rest = samples.omega == 0.0
    assert at_rest.any()
    assert (found["T_friction"][at_rest] == 0.0).all()
    band = np.where(at_rest, static_friction(joystick, samples.theta), 0.0)
    assert np.abs(found["T_band"] - band).max() < 1e-15


def test_friction_is_a_part_of_the_torque_and_of_the_loss() -> None:
    joystick = JOYSTICKS[0]
    samples = Samples.of(joystick, MOTION)
    found = measure(joystick, samples, torque_by_fmu(joystick, samples))
    assert found.work == pytest.approx(found.loss + found.energy_change, abs=1e-12)
    assert found.loss == found.parts["damping"].work + found.parts["friction"].work
    assert math.fsum(part.share for part in found.parts.values()) == pytest.approx(1.0, rel=1e-14)
    # Coulomb's share in closed form: both moments act over the whole way, there and back.
    way = 2.0 * math.radians(15.0)
    assert found.parts["friction"].work > 0.03 * way
    plain = measure(NOMINAL, samples, torque_by_fmu(NOMINAL, samples))
    assert "friction" not in plain.parts
