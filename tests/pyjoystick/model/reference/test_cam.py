"""The cam plate's geometry against eqs. (2a, b), from which eq. (3) follows."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.model import (
    NOMINAL,
    JoystickParameters,
    angle_of_travel,
    contact_travel,
    contact_travel_slope,
)
from pyjoystick.support import ParameterError
from tests.pyjoystick.random_parameters import random_cases

ANGLES = np.linspace(-1.5, 1.5, 601)
JOYSTICKS = [NOMINAL, *(case.parameters for case in random_cases(NOMINAL, 5))]


@pytest.mark.parametrize("parameters", JOYSTICKS)
def test_both_components_of_the_contact_point_agree(parameters: JoystickParameters) -> None:
    """Eqs. (2a, b) with the mirrored geometry for theta < 0: one length r satisfies both."""
    angle = np.abs(ANGLES)
    x = contact_travel(parameters, ANGLES)
    r_from_2a = (parameters.a - parameters.b * np.sin(angle)) / np.cos(angle)
    r_sine_from_2b = x - parameters.b + parameters.b * np.cos(angle)
    np.testing.assert_allclose(r_from_2a * np.sin(angle), r_sine_from_2b, rtol=1e-12, atol=1e-17)


def test_travel_is_eq_3_and_keeps_its_digits_near_zero() -> None:
    expected = NOMINAL.a * np.abs(np.tan(ANGLES)) + NOMINAL.b * (1.0 - 1.0 / np.cos(ANGLES))
    np.testing.assert_allclose(contact_travel(NOMINAL, ANGLES), expected, rtol=1e-13, atol=1e-17)
    tiny = np.array([1e-12, 1e-9, 1e-6])
    series = NOMINAL.a * (tiny + tiny**3 / 3.0) - NOMINAL.b * tiny**2 / 2.0
    np.testing.assert_allclose(contact_travel(NOMINAL, -tiny), series, rtol=1e-15)


def test_travel_at_the_stops_is_inside_the_last_segment() -> None:
    travel = contact_travel(NOMINAL, math.radians(20.0))
    assert NOMINAL.forward.kinks[3] < travel < 0.009


@pytest.mark.parametrize("parameters", JOYSTICKS)
def test_slope_is_the_derivative_of_travel(parameters: JoystickParameters) -> None:
    """Against a central difference of the sixth order, away from the corner at zero."""
    angles = ANGLES[np.abs(ANGLES) > 0.02]
    h = 2e-3
    weights = {1: 45.0 / 60.0, 2: -9.0 / 60.0, 3: 1.0 / 60.0}
    inner = angles[np.abs(angles) < 1.3]
    difference = sum(
        weight * (contact_travel(parameters, inner + i * h) - contact_travel(parameters, inner - i * h))
        for i, weight in weights.items()
    )
    np.testing.assert_allclose(contact_travel_slope(parameters, inner), difference / h, rtol=1e-9)


def test_slope_jumps_from_minus_a_to_a_at_zero() -> None:
    np.testing.assert_allclose(
        contact_travel_slope(NOMINAL, [-1e-300, 0.0, 1e-300]), [-NOMINAL.a, 0.0, NOMINAL.a]
    )


@pytest.mark.parametrize("parameters", JOYSTICKS)
@pytest.mark.parametrize("x", [0.0, 1e-12, 75e-6, 3e-3, 9e-3, 0.1, 10.0])
def test_angle_of_travel_inverts_travel(parameters: JoystickParameters, x: float) -> None:
    angle = angle_of_travel(parameters, x)
    assert 0.0 <= angle < math.pi / 2.0
    assert float(contact_travel(parameters, angle)) == pytest.approx(x, rel=1e-12, abs=1e-300)


def test_angles_beyond_the_geometry_are_refused_and_nan_passes() -> None:
    with pytest.raises(ParameterError, match=r"theta = -20\.0: .* -20 degrees are -0\.349066 rad"):
        contact_travel(NOMINAL, [0.1, -20.0, 30.0])
    with pytest.raises(ParameterError, match="theta = inf"):
        contact_travel_slope(NOMINAL, math.inf)
    assert np.isnan(contact_travel(NOMINAL, [0.1, math.nan])).tolist() == [False, True]
