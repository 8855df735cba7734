"""A second integrator, to check the reference by: Taylor series of high order from the equations themselves.

It shares with the reference neither the method (derivatives are computed exactly, one order after the other,
instead of being sampled by stages), nor the error control (the step follows from the decay of the series,
which sees a nearby singularity of eq. (11) whatever its width), nor the way events are found (zeros of a
polynomial), nor the form of the equations (sine, cosine and secant; the force from the table of segments).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from pyjoystick.model import ConstantDamping, JoystickParameters, SegmentTable

FloatArray = NDArray[np.float64]
#: Taylor coefficients 0 .. order of the torque about an instant, from (instant, order).
TorqueSeries = Callable[[float, int], FloatArray]

ORDER = 22
ACCURACY = 1e-15
SAMPLES = 24


@dataclass
class TaylorMotion:
    """theta and omega at the wanted times, and the passages (time, angle) of kinks and of the middle."""

    theta: FloatArray
    omega: FloatArray
    passages: list[tuple[float, float]] = field(default_factory=list)


def taylor_motion(
    parameters: JoystickParameters,
    times: FloatArray,
    theta: float,
    omega: float = 0.0,
    torque: TorqueSeries | None = None,
) -> TaylorMotion:
    """The motion from times[0] to times[-1]."""
    kinks = _kink_angles(parameters)
    motion = TaylorMotion(np.empty_like(times), np.empty_like(times))
    time, position = float(times[0]), 0
    heading = omega if omega != 0.0 else -theta
    region = int(np.searchsorted(kinks, theta, side="right" if heading > 0.0 else "left"))
    while position < len(times):
        driving = np.zeros(ORDER + 1) if torque is None else torque(time, ORDER)
        angle_series = _Series(parameters, kinks, region).of_angle(theta, omega, driving)
        rate_series = angle_series[1:] * np.arange(1, ORDER + 1)
        length = _step_length(rate_series)
        ends = (
            kinks[region - 1] if region > 0 else -np.inf,
            kinks[region] if region < len(kinks) else np.inf,
        )
        passage = _first_passage(angle_series, rate_series, length, ends)
        length = length if passage is None else passage[0]
        while position < len(times) and times[position] <= time + length:
            part = times[position] - time
            motion.theta[position] = polynomial.polyval(part, angle_series)
            motion.omega[position] = polynomial.polyval(part, rate_series)
            position += 1
        theta = float(polynomial.polyval(length, angle_series))
        omega = float(polynomial.polyval(length, rate_series))
        time += length
        if passage is not None and position < len(times):
            theta = ends[passage[1]]
            motion.passages.append((time, theta))
            region += 1 if passage[1] == 1 else -1
    return motion


def _kink_angles(parameters: JoystickParameters) -> list[float]:
    """Solve a*sin(u) + (b - x)*cos(u) = b, which is eq. (3) times cos(u), for every kink; in rising order."""

    def angle(x: float) -> float:
        radius = np.hypot(parameters.a, parameters.b - x)
        return float(np.arcsin(parameters.b / radius) - np.arctan2(parameters.b - x, parameters.a))

    backward = [-angle(x) for x in reversed(parameters.backward.kinks)]
    return [*backward, 0.0, *(angle(x) for x in parameters.forward.kinks)]


def _line(table: SegmentTable, travel: float) -> tuple[float, float]:
    """Intercept and slope of the force around a travel."""
    force, stiffness = 0.0, 0.0
    start = 0.0
    for x, k in zip(table.x, table.k, strict=True):
        if travel < x:
            break
        force, stiffness, start = force + stiffness * (x - start), k, x
    return force - stiffness * start, stiffness


class _Series:
    """Taylor coefficients of the motion about an instant, computed one order after the other."""

    def __init__(self, parameters: JoystickParameters, kinks: list[float], region: int) -> None:
        self.p = parameters
        self.side = 1.0 if region > kinks.index(0.0) else -1.0
        table = (parameters.forward if self.side > 0.0 else parameters.backward).to_table()
        inside = 0.5 * (kinks[region - 1] + kinks[region]) if 0 < region < len(kinks) else 1.0
        travel = parameters.a * abs(np.tan(inside)) + parameters.b * (1.0 - 1.0 / np.cos(inside))
        self.intercept, self.stiffness = _line(table, float(travel))
        self.theta, self.omega, self.sine, self.cosine, self.tangent, self.secant = np.zeros((6, ORDER + 1))
        self.lever, self.force, self.damping = np.zeros((3, ORDER + 1))
        self.theta_squared, self.omega_squared, self.of_theta, self.of_omega = np.zeros((4, ORDER + 1))

    def of_angle(self, theta: float, omega: float, driving: FloatArray) -> FloatArray:
        """Coefficients of theta from its start values and those of the torque."""
        self.theta[0], self.omega[0] = theta, omega
        for n in range(ORDER):
            self._extend_circle(n)
            self._extend_contact(n)
            self._extend_damping(n)
            moment = driving[n] + self.p.m * self.p.g * self.p.h * self.sine[n]
            moment -= _product(self.lever, self.force, n) + _product(self.damping, self.omega, n)
            self.theta[n + 1] = self.omega[n] / (n + 1)
            self.omega[n + 1] = moment / self.p.J / (n + 1)
        return self.theta

    def _extend_circle(self, n: int) -> None:
        """Sine and cosine from sin' = cos*theta', cos' = -sin*theta'; the secant from sec*cos = 1."""
        if n == 0:
            self.sine[0], self.cosine[0] = np.sin(self.theta[0]), np.cos(self.theta[0])
            self.secant[0] = 1.0 / self.cosine[0]
        else:
            slopes = np.arange(1, n + 1) * self.theta[1 : n + 1]
            self.sine[n] = slopes @ self.cosine[n - 1 :: -1] / n
            self.cosine[n] = -(slopes @ self.sine[n - 1 :: -1]) / n
            self.secant[n] = -(self.cosine[1 : n + 1] @ self.secant[n - 1 :: -1]) * self.secant[0]
        self.tangent[n] = _product(self.sine, self.secant, n)

    def _extend_contact(self, n: int) -> None:
        """Force along its line; lever side*a + (x - b)*tan, where x - b = side*a*tan - b*sec by eq. (3)."""
        once = 1.0 if n == 0 else 0.0
        x = self.side * self.p.a * self.tangent[n] + self.p.b * (once - self.secant[n])
        self.force[n] = self.intercept * once + self.stiffness * x
        of_a = self.side * (once + _product(self.tangent, self.tangent, n))
        self.lever[n] = of_a * self.p.a - self.p.b * _product(self.secant, self.tangent, n)

    def _extend_damping(self, n: int) -> None:
        law = self.p.damping
        once = 1.0 if n == 0 else 0.0
        if isinstance(law, ConstantDamping):
            self.damping[n] = law.C * once
            return
        self.theta_squared[n] = _product(self.theta, self.theta, n) + law.eps_theta**2 * once
        self.omega_squared[n] = _product(self.omega, self.omega, n) + law.eps_omega**2 * once
        coefficient, exponent = (law.A_pos, law.n_pos) if self.side > 0.0 else (law.A_neg, law.n_neg)
        _extend_power(self.of_theta, self.theta_squared, exponent / 2.0, n)
        _extend_power(self.of_omega, self.omega_squared, law.m / 2.0, n)
        self.damping[n] = law.alpha * coefficient * self.of_theta[n]
        self.damping[n] += (1.0 - law.alpha) * law.B * self.of_omega[n]


def _product(first: FloatArray, second: FloatArray, n: int) -> float:
    return float(first[: n + 1] @ second[n::-1])


def _extend_power(power: FloatArray, base: FloatArray, exponent: float, n: int) -> None:
    """Coefficient n of base**exponent, from base*power' = exponent*power*base'."""
    if n == 0:
        power[0] = base[0] ** exponent
        return
    j = np.arange(1, n + 1)
    power[n] = ((exponent * j - (n - j)) * base[1 : n + 1]) @ power[n - 1 :: -1][:n] / (n * base[0])


def _step_length(rate_series: FloatArray) -> float:
    """The length at which the last two terms of omega's series are down to the accuracy."""
    last = len(rate_series) - 1
    lengths = [
        (ACCURACY / abs(c)) ** (1.0 / k)
        for k, c in ((last - 1, rate_series[-2]), (last, rate_series[-1]))
        if c
    ]
    return float(min([0.5, *lengths]))


def _first_passage(
    angle_series: FloatArray, rate_series: FloatArray, length: float, ends: tuple[float, float]
) -> tuple[float, int] | None:
    """When within `length` the angle first leaves between its ends, and through which of them (0 or 1)."""
    samples = np.linspace(0.0, length, SAMPLES + 1)
    rates = polynomial.polyval(samples, rate_series)
    turns = [
        _bisected(rate_series, 0.0, samples[i], samples[i + 1])
        for i in range(SAMPLES)
        if rates[i] * rates[i + 1] < 0.0
    ]
    # Between these instants theta is monotone.
    instants = np.sort(np.concatenate((samples, turns)))
    angles = polynomial.polyval(instants, angle_series)
    for i in range(1, len(instants)):
        for which, (end, outward) in enumerate(zip(ends, (-1.0, 1.0), strict=True)):
            heads_out = (angles[i] - angles[i - 1]) * outward > 0.0
            if heads_out and (angles[i] - end) * outward >= 0.0:
                return _bisected(angle_series, end, instants[i - 1], instants[i]), which
    return None


def _bisected(series: FloatArray, value: float, lower: float, upper: float) -> float:
    """Where the series takes a value between two instants, by bisection to rounding."""
    rising = bool(polynomial.polyval(upper, series) > polynomial.polyval(lower, series))
    while True:
        middle = 0.5 * (lower + upper)
        if middle in (lower, upper):
            return float(upper)
        if bool(polynomial.polyval(middle, series) < value) == rising:
            lower = middle
        else:
            upper = middle
