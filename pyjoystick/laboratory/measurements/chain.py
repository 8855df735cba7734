"""The signal chain of section 2: resampling of the measured angle, low-pass filter and differentiation.

Derivatives use rules of 3, 5 or 7 points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.low_pass import LowPass
from pyjoystick.laboratory.measurements.resampling import resample
from pyjoystick.support import FloatArray, ParameterError, SeriesError, not_negative, positive

POINTS: Final = (3, 5, 7)


def derivative(values: FloatArray, interval: float, *, order: int, points: int) -> FloatArray:
    """First or second derivative by central differences, one-sided at the ends.

    The 5-point rule of the first derivative and the 3-point rule of the second are those of section 2:
    ``(y[-2] - 8 y[-1] + 8 y[1] - y[2])/(12 h)`` and ``(y[-1] - 2 y[0] + y[1])/h^2``. The one-sided rules of a
    second derivative use one more point, to keep their order.

    Args:
        values: samples, shape (n,), n > points
        interval: sampling interval (s)
        order: 1 or 2
        points: number of points of the rule: 3, 5 or 7

    Raises:
        ParameterError: the order, the points or the interval is not allowed
        SeriesError: too few samples
    """
    step = positive("interval", interval, "s")
    if order not in (1, 2):
        raise ParameterError("order", order, "1 or 2")
    if points not in POINTS:
        raise ParameterError("points", points, "3, 5 or 7")
    if len(values) <= points:
        raise SeriesError("values", f"has {len(values)} samples, more than {points} are needed")
    half = points // 2
    result = np.empty(len(values))
    inner = weights(tuple(range(-half, half + 1)), order)
    result[half : len(values) - half] = np.correlate(values, inner, mode="valid")
    width = points + order - 1
    for i in range(half):
        offsets = tuple(range(-i, width - i))
        result[i] = weights(offsets, order) @ values[:width]
        backward = tuple(-offset for offset in reversed(offsets))
        result[-1 - i] = weights(backward, order) @ values[-width:]
    return result / step**order


@cache
def weights(offsets: tuple[int, ...], order: int) -> FloatArray:
    """Weights at integer offsets that are exact for polynomials of a degree below their number."""
    powers = np.vander(np.array(offsets, dtype=np.float64), increasing=True).T
    wanted = np.zeros(len(offsets))
    wanted[order] = math.factorial(order)
    return np.asarray(np.linalg.solve(powers, wanted), dtype=np.float64)


#: Half a period of the paper's cut-off is 38 ms: a gap of up to two frames at 60 Hz hides nothing below it.
LONGEST_GAP: Final = 0.05


@dataclass(frozen=True, slots=True)
class Chain:
    """Settings of the chain; the defaults are the paper's.

    Attributes:
        rate: sampling rate after interpolation (Hz)
        low_pass: the filter
        velocity_points: number of points for the first derivative: 3, 5 or 7
        acceleration_points: number of points for the second derivative
        longest_gap: longest time between two adjacent frames to bridge (s)

    Raises:
        ParameterError: a value is outside its range
    """

    rate: float = 600.0
    low_pass: LowPass = field(default_factory=LowPass)
    velocity_points: int = 5
    acceleration_points: int = 3
    longest_gap: float = LONGEST_GAP

    def __post_init__(self) -> None:
        self.low_pass.design_cutoff(positive("rate", self.rate, "Hz"))
        not_negative("longest_gap", self.longest_gap, "s")
        for name in ("velocity_points", "acceleration_points"):
            if getattr(self, name) not in POINTS:
                raise ParameterError(name, getattr(self, name), "3, 5 or 7")

    def run(self, time: FloatArray, theta: FloatArray) -> Motion:
        """Process an angle; each stretch between gaps is processed separately.

        Args:
            time: times (s), shape (n,), increasing
            theta: angle (rad), shape (n,), NaN where a frame is missing

        Raises:
            SeriesError: no stretch is long enough
        """
        even = resample(time, theta, self.rate, longest_gap=self.longest_gap)
        series = np.full((3, len(even.time)), np.nan)
        fewest = max(2 * self.low_pass.order + 2, self.velocity_points + 1, self.acceleration_points + 2)
        for stretch in even.stretches():
            if stretch.stop - stretch.start >= fewest:
                series[:, stretch] = self._differentiated(even.values[stretch])
        if not np.isfinite(series).any():
            raise SeriesError("theta", f"no stretch between gaps has {fewest} samples at {self.rate:g} Hz")
        smooth, omega, alpha = series
        return Motion(even.time, smooth, omega, alpha, even.bridged & np.isfinite(smooth), even.gaps)

    def _differentiated(self, theta: FloatArray) -> FloatArray:
        smooth, interval = self.low_pass.filter(theta, self.rate), 1.0 / self.rate
        return np.stack(
            (
                smooth,
                derivative(smooth, interval, order=1, points=self.velocity_points),
                derivative(smooth, interval, order=2, points=self.acceleration_points),
            )
        )

    def response(self, frequency: FloatArray) -> FloatArray:
        """Amplitude response of the velocity to a sinusoidal angle, relative to an exact derivative.

        It covers the filter and the rule of differentiation, but not the spline through the camera's
        samples, which adds 1 % at a sixth of the camera's rate.

        Args:
            frequency: above 0 (Hz), any shape
        """
        half = self.velocity_points // 2
        offsets = tuple(range(-half, half + 1))
        phase = 2.0 * np.pi * np.asarray(frequency) / self.rate
        rule = sum(
            weight * np.sin(offset * phase)
            for offset, weight in zip(offsets, weights(offsets, 1), strict=True)
        )
        return np.asarray(self.low_pass.response(frequency, self.rate) * rule / phase, dtype=np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Output of the chain; arrays of shape (n,), NaN in gaps that are not bridged.

    Attributes:
        time: evenly spaced times (s)
        theta: angle (rad)
        omega: angular velocity (rad/s)
        alpha: angular acceleration (rad/s2)
        bridged: whether a sample is in a gap that was bridged by the spline
        gaps: first and last time (s) of each gap that was not bridged
    """

    time: FloatArray
    theta: FloatArray
    omega: FloatArray
    alpha: FloatArray
    bridged: NDArray[np.bool_]
    gaps: tuple[tuple[float, float], ...]
