"""The branches reproduce the equation of motion and switch at the right angles."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, JoystickParameters, contact_travel, inverse_torque
from pyjoystick.model.reference.branches import PiecewiseEquation
from pyjoystick.support import SimulationError
from tests.pyjoystick.random_parameters import RandomCase, both_laws

CASES = both_laws(5)
NO_CLEARANCE = NOMINAL.replace({"forward.returnSpring.x_0": 0.0, "backward.returnSpring.x_0": 0.0})


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_acceleration_is_that_of_the_moments(case: RandomCase) -> None:
    equation = PiecewiseEquation(case.parameters, lambda time: 2.0 * time)
    random = np.random.default_rng(1)
    for theta in np.concatenate([random.uniform(-0.5, 0.5, 200), random.uniform(-0.01, 0.01, 200)]):
        omega = random.uniform(-6.0, 6.0)
        branch = equation.branches[equation.index(theta, omega)]
        alpha = branch.acceleration(0.25, theta, omega)
        assert branch.lower <= theta <= branch.upper
        # The sum cancels near equilibrium, so it is compared as a torque of the size of its parts.
        torque = inverse_torque(case.parameters, theta, omega, alpha)
        assert float(torque.T) == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_boundaries_are_the_kinks_in_order(case: RandomCase) -> None:
    boundaries = PiecewiseEquation(case.parameters, None).boundaries
    angles = np.array([boundary.theta for boundary in boundaries])
    assert np.all(np.diff(angles) > 0.0)
    expected = [*case.parameters.backward.kinks[::-1], 0.0, *case.parameters.forward.kinks]
    np.testing.assert_allclose(contact_travel(case.parameters, angles), expected, rtol=1e-13)
    names = [f"backward x_{i}" for i in (3, 2, 1, 0)] + ["theta = 0"] + [f"forward x_{i}" for i in range(4)]
    assert [boundary.kinks for boundary in boundaries] == [(name,) for name in names]


@pytest.mark.parametrize("parameters", [NOMINAL, NO_CLEARANCE])
def test_neighboring_branches_agree_where_they_meet(parameters: JoystickParameters) -> None:
    equation = PiecewiseEquation(parameters, None)
    for i, boundary in enumerate(equation.boundaries):
        below, above = (
            branch.acceleration(0.0, boundary.theta, 2.0) for branch in equation.branches[i : i + 2]
        )
        assert below == pytest.approx(above, rel=1e-11)


def test_steep_branches_are_those_with_a_restraint_in_tension() -> None:
    steep = [branch.steep for branch in PiecewiseEquation(NOMINAL, None).branches]
    assert steep == [False, True, False, True, False, False, True, False, True, False]


def test_on_a_boundary_the_heading_picks_the_branch() -> None:
    equation = PiecewiseEquation(NOMINAL, None)
    for i, boundary in enumerate(equation.boundaries):
        assert equation.index(boundary.theta, -1.0) == i
        assert equation.index(boundary.theta, 1.0) == i + 1


def test_kinks_at_one_angle_share_a_boundary() -> None:
    boundaries = PiecewiseEquation(NO_CLEARANCE, None).boundaries
    assert len(boundaries) == 7
    assert boundaries[3].theta == 0.0
    assert boundaries[3].kinks == ("backward x_0", "theta = 0", "forward x_0")


def test_a_torque_that_is_no_number_is_named() -> None:
    equation = PiecewiseEquation(NOMINAL, lambda time: math.nan)
    with pytest.raises(SimulationError, match=r"t = 0\.5 s: the torque is nan N m"):
        equation.branches[0].acceleration(0.5, -0.3, 0.0)
