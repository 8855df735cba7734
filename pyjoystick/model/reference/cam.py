"""Geometry of the cam plate: contact travel, eq. (3), its slope and its inverse."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.support import FloatArray, angle


def contact_travel(parameters: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Eq. (3): travel of the contact point, x = a*|tan(theta)| + b*(1 - 1/cos(theta)).

    With t = tan(|theta|/2) this is 2*t*(a - b*t)/(1 - t^2), which has no cancellation near theta = 0.

    Args:
        parameters: the joystick
        theta: angle (rad), any shape, |theta| < pi/2; NaN gives NaN

    Returns:
        x (m), 0 or more, same shape

    Raises:
        ParameterError: some |theta| >= pi/2
    """
    t = np.tan(np.abs(_checked(theta)) / 2.0)
    return np.asarray(2.0 * t * (parameters.a - parameters.b * t) / ((1.0 - t) * (1.0 + t)))


def contact_travel_slope(parameters: JoystickParameters, theta: ArrayLike) -> FloatArray:
    """Derivative of eq. (3): dx/dtheta = (a*sign(theta) - b*sin(theta))/cos(theta)^2.

    Args:
        parameters: the joystick
        theta: angle (rad), any shape, |theta| < pi/2; NaN gives NaN

    Returns:
        dx/dtheta (m/rad), same shape; 0 at theta = 0, halfway between the one-sided slopes -a and a

    Raises:
        ParameterError: some |theta| >= pi/2
    """
    theta = _checked(theta)
    return np.asarray((parameters.a * np.sign(theta) - parameters.b * np.sin(theta)) / np.cos(theta) ** 2)


def angle_of_travel(parameters: JoystickParameters, x: float) -> float:
    """The angle |theta| (rad) at which the contact travel is x (m): the inverse of eq. (3).

    Eq. (3) in t = tan(theta/2) is (2*b - x)*t^2 - 2*a*t + x = 0. Its root that vanishes with x is taken in
    the form without cancellation. It is real and below pi/2 for every x >= 0 because b < a.
    """
    a, b = parameters.a, parameters.b
    return 2.0 * math.atan(x / (a + math.sqrt(a * a - x * (2.0 * b - x))))


def _checked(theta: ArrayLike) -> FloatArray:
    angles = np.asarray(theta, dtype=np.float64)
    for value in angles[np.abs(angles) >= np.pi / 2.0][:1]:
        angle("theta", value)
    return angles
