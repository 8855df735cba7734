"""Integration with dry friction: the joystick slides either way or sticks, and each change is located."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.polynomial import chebyshev

from pyjoystick.model.reference.branches import Acceleration, PiecewiseEquation
from pyjoystick.model.reference.dormand_prince import Step
from pyjoystick.model.reference.integration import Event, Integration, Rest, TurningPoint


class StickSlipIntegration(Integration):
    """Integration of a motion that friction opposes, and that ends where friction balances all else.

    Attributes:
        mode: 1 and -1 while the joystick slides forward and backward, 0 while it sticks
    """

    def __init__(
        self, equation: PiecewiseEquation, time: float, theta: float, omega: float, tolerance: float
    ) -> None:
        super().__init__(equation, time, theta, omega, tolerance)
        self._stribeck = equation.stribeck_velocity
        self.mode = (omega > 0.0) - (omega < 0.0) or self._mode_at_rest()

    def _acceleration(self) -> Acceleration:
        return self._branch.sliding(self.mode)

    def _advance(self, end: float, latest: float) -> tuple[Step | Rest, float] | None:
        if self._omega == 0.0:
            self._settle()
        return super()._advance(end, latest) if self.mode else self._rest(end, latest)

    def _mode_at_rest(self) -> int:
        """Return the direction in which all but friction pushes from rest; 0 if the joystick sticks."""
        push = self._branch.acceleration(self._time, self._theta, 0.0)
        hold = self._branch.friction(self._theta, 0.0)
        return (push > hold) - (push < -hold)

    def _settle(self) -> None:
        before, self.mode = self.mode, self._mode_at_rest()
        if before and self.mode == -before:
            self.turning_points.append(TurningPoint(self._time, self._theta))
        elif before != self.mode:
            kind = "slips" if self.mode else "sticks"
            self.events.append(Event(self._time, kind, before or self.mode, self._theta, 0.0))

    def _turned(self) -> None:
        """Do nothing: the next step decides whether the joystick reverses or sticks."""

    def _take(self, step: Step, heading: int, length: float, theta: float, omega: float, end: float) -> None:
        if heading == self.mode:
            super()._take(step, heading, length, theta, omega, end)
        else:  # a push that exceeds friction only by rounding does not move the joystick
            self._time = end if step.time + length >= end else step.time + length

    def _controlled(self, step: Step, end: float) -> tuple[float, float, float]:
        """Control a step as without friction, but keep it too short to skip the Stribeck peak."""
        speed, rate = abs(step.omega), abs(step.alpha)
        if self._stribeck > 0.0 and rate > 0.0:
            way = max(0.5 * (speed - _PEAK * self._stribeck), 0.25 * self._stribeck)
            self._length = min(self._length, way / rate)
        return super()._controlled(step, end)

    def _rest(self, end: float, latest: float) -> tuple[Rest, float]:
        rest = Rest(self._time, self._theta)
        if self._equation.torque is None:
            self._time = end
            return rest, end
        others, theta = self._branch.acceleration, self._theta
        hold = self._branch.friction(theta, 0.0)
        longest = max(_LONGEST, _LONGEST_PART * (end - self._time))

        def push(time: float) -> float:
            return others(min(time, latest), theta, 0.0)

        found = first_excess(push, hold, self._time, end, longest)
        self._time = end if found is None else found
        return rest, self._time


#: Beyond this multiple of omega_s, the Stribeck part of friction is smaller than rounding errors.
_PEAK: Final = 6.0
#: A torque is searched in spans: the first of length `_FIRST` (s), others up to the larger of `_LONGEST` (s)
#: and `_LONGEST_PART` of the wait.
_FIRST: Final = 1e-3
_LONGEST: Final = 0.05
_LONGEST_PART: Final = 1e-4
#: Spans of this length (s) or less are accepted even if the torque is not smooth in them.
_SHORTEST: Final = 1e-6
#: A span is resolved if the last coefficients of its Chebyshev series are at most this part of the largest.
_RESOLVED: Final = 1e-9
_DEGREE: Final = 16
_NODES: Final = chebyshev.chebpts2(_DEGREE + 1)
_TO_COEFFICIENTS: Final = np.linalg.inv(chebyshev.chebvander(_NODES, _DEGREE))


def first_excess(
    function: Callable[[float], float], bound: float, start: float, end: float, longest: float
) -> float | None:
    """Find the first instant at which the magnitude of a function of time exceeds a bound.

    Args:
        function: smooth function of time (s), at most `bound` in magnitude at `start`
        bound: 0 or more
        start: start of the search (s)
        end: end of the search (s)
        longest: longest span (s) searched at once; changes that last this long are detected

    Returns:
        the earliest floating-point number beyond the crossing; None if there is no crossing
    """
    length = _FIRST
    while start < end:
        length = min(length, longest, end - start)
        middle, half = start + 0.5 * length, 0.5 * length
        values = np.array([function(middle + half * float(node)) for node in _NODES])
        coefficients = _TO_COEFFICIENTS @ values
        size = np.max(np.abs(coefficients))
        if np.max(np.abs(coefficients[-3:])) > _RESOLVED * size and length > _SHORTEST:
            length *= 0.5
            continue
        before = start
        for node in sorted({*_NODES, *_extremes(coefficients)}):
            time = middle + half * float(node)
            if abs(function(time)) > bound:
                return _crossing(function, bound, before, time)
            before = time
        start = end if start + length >= end else start + length
        length *= 2.0
    return None


def _extremes(coefficients: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
    """Return where the slope of a Chebyshev series is zero, between -1 and 1."""
    slope = chebyshev.chebtrim(chebyshev.chebder(coefficients), 1e-14 * float(np.max(np.abs(coefficients))))
    return [
        float(root.real) for root in chebyshev.chebroots(slope) if abs(root.imag) < 1e-3 and abs(root) < 1.0
    ]


def _crossing(function: Callable[[float], float], bound: float, inside: float, outside: float) -> float:
    """Find the first floating-point number at which the value is beyond the bound, by bisection."""
    while inside < (middle := 0.5 * (inside + outside)) < outside:
        if abs(function(middle)) > bound:
            outside = middle
        else:
            inside = middle
    return outside
