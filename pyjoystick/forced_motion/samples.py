"""Sampled motions with weights for integration over time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from pyjoystick.forced_motion.motions import ForwardAndReturn, Limit
from pyjoystick.model import JoystickParameters, angle_of_travel
from pyjoystick.runs import time_grid
from pyjoystick.support import FloatArray, SeriesError

#: Panels of each smooth piece, graded towards its ends, and Gauss-Legendre nodes per panel.
_PANELS: Final = 12
_NODES: Final = 12
#: Panels and Gauss-Legendre nodes per panel between two samples of a measured motion.
_PANELS_BETWEEN: Final = 2
_NODES_BETWEEN: Final = 3
#: Halvings of an interval that locate a kink to rounding.
_HALVINGS: Final = 50
#: Times closer than this part of the interval are the same.
_ROUNDING: Final = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """A motion at n times; arrays of shape (n,).

    Attributes:
        time: times (s), nondecreasing; the time of a jump appears twice
        theta: angle (rad), |theta| < pi/2
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2)
        weights: quadrature weights (s): the time integral of any function of the samples is the sum of its
            values times the weights; 0 for samples that only show one side of a jump

    Raises:
        SeriesError: lengths differ, a number is not finite, or the time decreases
    """

    time: FloatArray
    theta: FloatArray
    omega: FloatArray
    alpha: FloatArray
    weights: FloatArray

    def __post_init__(self) -> None:
        for name in ("theta", "omega", "alpha", "weights"):
            series = getattr(self, name)
            if series.shape != self.time.shape:
                raise SeriesError(name, f"has the shape {series.shape}, time has {self.time.shape}")
            for i in np.flatnonzero(~np.isfinite(series))[:1]:
                raise SeriesError(name, f"sample {i} is {series[i]}")
        for i in np.flatnonzero(np.diff(self.time) < 0.0)[:1]:
            raise SeriesError("time", f"falls at sample {i + 1}, {self.time[i + 1]} s")

    def __len__(self) -> int:
        return len(self.time)

    @property
    def duration(self) -> float:
        """Time from the first to the last sample (s)."""
        return float(self.time[-1] - self.time[0])

    @classmethod
    def trapezoidal(
        cls, time: FloatArray, theta: FloatArray, omega: FloatArray, alpha: FloatArray
    ) -> Samples:
        """Take a motion as sampled, with weights of the trapezoidal rule.

        The preload of a spring sets in within about 0.1 mm of travel, often between two samples. Integrals of
        the torque are then several percent off: `refined` samples are for them.

        Args:
            time: times (s), shape (n,), nondecreasing; a repeated one is a jump
            theta: angle (rad), shape (n,)
            omega: angular velocity (rad/s)
            alpha: angular acceleration (rad/s2)

        Raises:
            SeriesError: see `Samples`, or all times are equal
        """
        steps = np.diff(time)
        if not np.any(steps > 0.0):
            raise SeriesError("time", "must have two or more instants")
        return cls(time, theta, omega, alpha, 0.5 * (np.append(steps, 0.0) + np.insert(steps, 0, 0.0)))

    @classmethod
    def evenly(cls, motion: ForwardAndReturn, interval: float) -> Samples:
        """Sample a motion in closed form every `interval` (s), for tables and figures; twice at jumps.

        Raises:
            ParameterError: the interval is not above 0 or longer than the motion, or there would be more than
                ten million rows
        """
        corners = np.array(motion.breakpoints)
        grid = time_grid(motion.duration, interval)
        apart = np.min(np.abs(grid[:, None] - corners), axis=1) > _ROUNDING * interval
        time = np.union1d(grid[apart], corners)
        before, after = motion.at(time, "before"), motion.at(time, "after")
        first = np.stack((time, before.theta, before.omega, before.alpha))
        second = np.stack((time, after.theta, after.omega, after.alpha))
        jumps = np.flatnonzero(before.alpha != after.alpha)
        return cls.trapezoidal(*np.insert(first, jumps + 1, second[:, jumps], axis=1))

    @classmethod
    def of(cls, joystick: JoystickParameters, motion: ForwardAndReturn) -> Samples:
        """Sample a motion in closed form at quadrature nodes that are nearly exact to rounding.

        The motion is split at each corner of the motion or the joystick's springs. Each piece has
        Gauss-Legendre panels graded towards its ends, and both ends with weight 0.
        """
        nodes, weights = np.polynomial.legendre.leggauss(_NODES)
        edges = np.sin(np.linspace(0.0, 0.5 * np.pi, _PANELS + 1)) ** 2
        halves = 0.5 * np.diff(edges)
        unit = (0.5 * (edges[1:] + edges[:-1])[:, None] + halves[:, None] * nodes).ravel()
        parts = (halves[:, None] * weights).ravel()
        columns = []
        for start, end in pairwise(smooth_spans(joystick, motion)):
            columns += [
                _column(motion, np.array([start]), np.zeros(1)),
                _column(motion, start + (end - start) * unit, (end - start) * parts),
                _column(motion, np.array([end]), np.zeros(1), "before"),
            ]
        return cls(*np.concatenate(columns, axis=1))

    def refined(self, joystick: JoystickParameters) -> Samples:
        """Interpolate between the samples of a measured motion, for integrals of the torque.

        Each interval is split where a spring of the joystick begins or ends, in the middle and at rest. Angle
        and velocity follow cubics with the given derivatives. So does the acceleration, with central
        differences: a derivative of the velocity would amplify noise. The samples stay, with weight 0.

        Raises:
            SeriesError: the time does not increase from sample to sample
        """
        for i in np.flatnonzero(np.diff(self.time) <= 0.0)[:1]:
            raise SeriesError("time", f"does not increase at sample {i + 1}, {self.time[i + 1]} s")
        theta = CubicHermiteSpline(self.time, self.theta, self.omega)
        omega = CubicHermiteSpline(self.time, self.omega, self.alpha)
        alpha = CubicHermiteSpline(self.time, self.alpha, np.gradient(self.alpha, self.time))
        parts = np.arange(_PANELS_BETWEEN) / _PANELS_BETWEEN
        grid = np.append((self.time[:-1, None] + np.diff(self.time)[:, None] * parts).ravel(), self.time[-1])
        crossings = [_crossings(theta, level, grid) for level in _levels(joystick)]
        edges = np.sort(np.concatenate([grid, _crossings(omega, 0.0, grid), *crossings]))
        nodes, weights = np.polynomial.legendre.leggauss(_NODES_BETWEEN)
        halves = 0.5 * np.diff(edges)[:, None]
        time = (0.5 * (edges[1:] + edges[:-1])[:, None] + halves * nodes).ravel()
        angle = theta(time)
        if joystick.stops:  # the angle may overshoot between two samples at a stop
            angle = np.clip(angle, -joystick.stops.theta_stop, joystick.stops.theta_stop)
        between = np.stack((time, angle, omega(time), alpha(time), (halves * weights).ravel()))
        given = np.stack((self.time, self.theta, self.omega, self.alpha, np.zeros(len(self))))
        columns = np.concatenate((given, between), axis=1)
        return Samples(*columns[:, np.argsort(columns[0], kind="stable")])


def _levels(joystick: JoystickParameters) -> list[float]:
    """Angles (rad) at which the torque or its slope may jump: where springs begin or end, and zero."""
    sides = ((1.0, joystick.forward), (-1.0, joystick.backward))
    return [0.0, *(sign * angle_of_travel(joystick, x) for sign, side in sides for x in side.kinks)]


def _crossings(series: CubicHermiteSpline, level: float, edges: FloatArray) -> FloatArray:
    """Times at which a series crosses a level, one at most between two edges."""
    excess = series(edges) - level
    i = np.flatnonzero(excess[:-1] * excess[1:] < 0.0)
    low, high, first = edges[i], edges[i + 1], excess[i]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        is_before = (series(middle) - level) * first > 0.0
        low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
    return low


def _column(
    motion: ForwardAndReturn, time: FloatArray, weights: FloatArray, limit: Limit = "after"
) -> FloatArray:
    at = motion.at(time, limit)
    return np.stack((time, at.theta, at.omega, at.alpha, weights))


def smooth_spans(joystick: JoystickParameters, motion: ForwardAndReturn) -> list[float]:
    """Times (s) between which both the motion and the contact force are smooth, from 0 to the end."""
    breakpoints = motion.breakpoints
    side = joystick.forward if motion.amplitude > 0.0 else joystick.backward
    kinks = [angle_of_travel(joystick, x) for x in side.kinks]
    instants = {*breakpoints}
    for start, end in pairwise(breakpoints):
        instants |= {
            _passage(motion, start, end, level) for level in kinks if _passes(motion, start, end, level)
        }
    return sorted(instants)


def _passes(motion: ForwardAndReturn, start: float, end: float, level: float) -> bool:
    first, last = np.abs(motion.at([start, end]).theta)
    return bool((first - level) * (last - level) < 0.0)


def _passage(motion: ForwardAndReturn, start: float, end: float, level: float) -> float:
    """Time at which the angle passes a level (rad) within a span in which it is monotonic."""
    return float(
        brentq(lambda time: float(np.abs(motion.at(time).theta)) - level, start, end, xtol=1e-15, rtol=1e-15)
    )
