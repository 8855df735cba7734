"""Steps of the eighth-order method of Dormand and Prince, for theta' = omega and omega' = alpha.

The coefficients are class attributes of SciPy's DOP853. The loop is written for two floats: SciPy's own takes
some ten times as long for such a small system.
"""

from __future__ import annotations

import math
from operator import mul
from typing import Final, NamedTuple

from scipy.integrate import DOP853

from pyjoystick.model.reference.branches import Acceleration

#: Order of the error estimate in the step length.
ERROR_ORDER: Final = 8

_STAGES = tuple(
    (float(node), tuple(float(weight) for weight in row[:stage]))
    for stage, (node, row) in enumerate(zip(DOP853.C, DOP853.A, strict=True))
)[1:]
_WEIGHTS = tuple(float(weight) for weight in DOP853.B)
_ERROR_5 = tuple(float(weight) for weight in DOP853.E5)
_ERROR_3 = tuple(float(weight) for weight in DOP853.E3)


class Step(NamedTuple):
    """A point of the motion from which steps of any length can be taken along one smooth branch.

    Attributes:
        acceleration: acceleration of the branch
        time: time of the point (s)
        theta: angle (rad)
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2)
        latest: latest time (s) at which the acceleration is evaluated, so that a torque that jumps at the
            end of a step only counts with its value before the jump
        mode: with dry friction, the direction in which the joystick slides: 1 or -1
    """

    acceleration: Acceleration
    time: float
    theta: float
    omega: float
    alpha: float
    latest: float
    mode: int = 0

    def at(self, length: float) -> tuple[float, float]:
        """Return angle (rad) and angular velocity (rad/s) after one step of `length` (s)."""
        rates, accelerations = self._stages(length)
        return self._ends(length, rates, accelerations)

    def with_error(self, length: float) -> tuple[float, float, float]:
        """Return both after a step of `length` (s), and the larger of their estimated errors (rad, rad/s)."""
        rates, accelerations = self._stages(length)
        theta, omega = self._ends(length, rates, accelerations)
        error = max(_error(length, rates), _error(length, accelerations))
        return theta, omega, error

    def alpha_at(self, length: float, theta: float, omega: float) -> float:
        """Return the angular acceleration (rad/s2) `length` (s) after the point, at these theta and omega."""
        return self.acceleration(min(self.time + length, self.latest), theta, omega)

    def _stages(self, length: float) -> tuple[list[float], list[float]]:
        acceleration, time, theta, omega, alpha, latest, _ = self
        rates, accelerations = [omega], [alpha]
        for node, row in _STAGES:
            rate = omega + length * sum(map(mul, row, accelerations))
            angle = theta + length * sum(map(mul, row, rates))
            accelerations.append(acceleration(min(time + node * length, latest), angle, rate))
            rates.append(rate)
        return rates, accelerations

    def _ends(self, length: float, rates: list[float], accelerations: list[float]) -> tuple[float, float]:
        theta = self.theta + length * sum(map(mul, _WEIGHTS, rates))
        omega = self.omega + length * sum(map(mul, _WEIGHTS, accelerations))
        return theta, omega


def _error(length: float, slopes: list[float]) -> float:
    """Estimate the error: of fifth order, damped by one of third order to behave as one of eighth order."""
    fifth = float(sum(map(mul, _ERROR_5, slopes)))
    third = float(sum(map(mul, _ERROR_3, slopes)))
    # Written as a ratio, because the squares of slopes near rest can be too small for a float.
    return length * abs(fifth) * (abs(fifth) / math.hypot(fifth, 0.1 * third)) if fifth != 0.0 else 0.0
