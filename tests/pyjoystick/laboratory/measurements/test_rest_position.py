from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from pyjoystick.laboratory import rest_angle
from pyjoystick.model import NOMINAL, SIDES, Side, contact_moment, gravity_moment, simulate


@pytest.mark.parametrize("side", SIDES)
def test_the_weight_presses_into_the_springs_by_less_than_is_stated(side: Side) -> None:
    found = rest_angle(NOMINAL, side)
    assert np.sign(found) == (1.0 if side == "forward" else -1.0)

    def excess(theta: float) -> float:
        return float(contact_moment(NOMINAL, theta) - gravity_moment(NOMINAL, theta))

    balance = brentq(excess, found, 1.1 * found, xtol=1e-12)
    assert 1.0 < balance / found < 1.004


def test_a_joystick_that_is_let_go_ends_there() -> None:
    run = simulate(NOMINAL, time=np.array([0.0, 3.0, 6.0]), theta_start=np.radians(-20.0))
    side: Side = "forward" if run.theta[-1] > 0.0 else "backward"
    assert run.theta[-1] == pytest.approx(rest_angle(NOMINAL, side), rel=0.01)
