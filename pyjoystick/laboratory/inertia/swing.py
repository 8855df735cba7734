"""Moment of inertia from the pendulum period, upside down and out of contact (section 3.2)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike
from scipy.special import ellipk

from pyjoystick.laboratory.inertia.budget import Estimate, Measured, combined
from pyjoystick.laboratory.inertia.decay import Decay
from pyjoystick.support import FloatArray, ParameterError, angle, not_negative, positive, whole_number

#: Standard uncertainty of the difference of the reaction times at start and stop of a stopwatch (s).
REACTION_TIME: Final = 0.05
#: Largest ratio of two readings of the same pendulum.
_ALIKE: Final = 1.5
#: Readings that differ by this part of a swing, and this many reaction times, are of other numbers of swings.
_MISCOUNTED: Final = 0.75
_BEYOND_REACTION: Final = 6.0
#: By this many standard uncertainties J may be below m h^2 (parallel axes).
_BEYOND_ERROR: Final = 3.0
#: Shortest and longest full swing (s), with a wide margin.
_SHORTEST: Final = 1e-3
_LONGEST: Final = 1e4
_NODES: Final = 16
#: Smallest part of a small swing's drive at the turn, in the middle: where less is left, the joystick stops.
_BARELY: Final = 0.01
#: Growth of the product of both frictions with the amplitude, from the second order of the energy's integral.
_BOTH_AT_AMPLITUDE: Final = 0.1835


@dataclass(frozen=True, slots=True)
class SwingPeriod:
    """The period of small undamped swings.

    Attributes:
        period: with its uncertainty (s)
        measured: mean measured period (s)
        amplitude_factor: factor by which the amplitude lengthens the measured period
        decay: viscous damping and dry friction from the decay; None if that was not recorded
    """

    period: Estimate
    measured: float
    amplitude_factor: float
    decay: Decay | None = None


def amplitude_factor(amplitude: ArrayLike) -> FloatArray:
    """Period of a pendulum over that of small swings: 2 K(sin(A/2))/pi, K the complete elliptic integral.

    Args:
        amplitude: A (rad), any shape

    Returns:
        same shape; 1.0019 at 10 degrees
    """
    return np.asarray(2.0 / math.pi * ellipk(np.sin(np.asarray(amplitude, np.float64) / 2.0) ** 2))


def half_swing_factor(amplitude: FloatArray, friction_angle: float, damping_ratio: float) -> FloatArray:
    """Time from one passage of the middle to the next, over that of small swings without dry friction.

    Without viscous damping, omega^2 = 2*w^2*(cos(theta) - cos(A) +- f*(A - theta)) on the way to the turn at
    A and back, f the angle of friction, w the natural frequency. The way there becomes shorter by dry
    friction, and the way back longer by a little more: 2*f^2/A^2 for small angles, or pi*z*f/A with viscous
    damping too, whose ratio is z.

    Args:
        amplitude: A (rad), above 0, shape (n,)
        friction_angle: f (rad)
        damping_ratio: z
    """
    nodes, weights = leggauss(_NODES)
    # With theta = A*(1 - s^2), the integrand has no singularity at the turn, s = 0.
    fall = amplitude[:, None] * ((nodes + 1.0) / 2.0) ** 2
    weight = 2.0 * np.sin(amplitude[:, None] - fall / 2.0) * np.sinc(fall / (2.0 * math.pi))
    least = _BARELY * amplitude[:, None]
    both = sum(1.0 / np.sqrt(np.maximum(weight + 2.0 * side * friction_angle, least)) for side in (-1.0, 1.0))
    viscous = damping_ratio * friction_angle * (1.0 / amplitude + _BOTH_AT_AMPLITUDE * amplitude)
    return np.sqrt(amplitude) * (both @ weights) / math.pi + viscous


def mean_amplitude_factor(first: float, last: float) -> float:
    """Mean of `amplitude_factor` while the amplitude (rad) decays exponentially from `first` to `last`."""
    if first == 0.0 or last == 0.0:
        return float((amplitude_factor(first) + amplitude_factor(last)) / 2.0)
    nodes, weights = leggauss(_NODES)
    amplitudes = first * (last / first) ** ((nodes + 1.0) / 2.0)
    return float(weights @ amplitude_factor(amplitudes)) / 2.0


def period_of_readings(
    readings: Sequence[float],
    swings: int,
    first_amplitude: Measured,
    last_amplitude: Measured | None = None,
    *,
    reaction_time: float = REACTION_TIME,
) -> SwingPeriod:
    """Period of small swings from stopwatch readings.

    The scatter of the readings counts as type A, with Student's factor for their number. `reaction_time`
    covers errors that all readings share, which the scatter does not show. Damping is not corrected: a
    damping ratio of 0.1 lengthens the period by 0.5 %.

    Args:
        readings: time of `swings` full swings each (s)
        swings: number of full swings in a reading, 1 or more
        first_amplitude: amplitude at the start of a reading (rad)
        last_amplitude: amplitude at its end (rad); by default the same
        reaction_time: standard uncertainty that all readings share (s)

    Raises:
        ParameterError: no reading, a number that is not above 0, readings that differ by a swing, a swing of
            less than 1 ms or more than 10,000 s, a negative uncertainty, a reaction time longer than a
            reading, an amplitude out of range, or one that grows
    """
    whole_number("swings", swings, 1)
    if not readings:
        raise ParameterError("readings", "none", "one time or more (s)")
    times = np.array([positive(f"readings[{i}]", time, "s") for i, time in enumerate(readings)])
    _require_alike(times, swings, reaction_time)
    shortest, longest = swings * _SHORTEST, swings * _LONGEST
    for i, time in enumerate(times.tolist()):
        if not shortest <= time <= longest:
            allowed = f"between {shortest:g} and {longest:g} s for {swings} swing{'s' * (swings > 1)}"
            raise ParameterError(f"readings[{i}]", time, allowed)
    if not_negative("reaction_time", reaction_time, "s") > times.min():
        raise ParameterError("reaction_time", reaction_time, f"at most the reading, {times.min():g} s")
    amplitudes = {"first_amplitude": first_amplitude, "last_amplitude": last_amplitude or first_amplitude}
    first, last = (not_negative(name, angle(name, one.value), "rad") for name, one in amplitudes.items())
    for name, one in amplitudes.items():
        not_negative(f"{name}.uncertainty", one.uncertainty, "rad")
    if last > first:
        raise ParameterError("last_amplitude", last, f"at most the first amplitude, {first:g} rad")
    scatter = float(np.std(times, ddof=1)) / math.sqrt(len(times)) if len(times) > 1 else 0.0
    quantities = {
        "mean of the readings": Measured(float(np.mean(times)), scatter, max(len(times) - 1.0, 1.0)),
        "reaction": Measured(0.0, reaction_time),
        "first amplitude": first_amplitude,
    }
    # One amplitude for both is one quantity, with one error.
    if last_amplitude is not None:
        quantities["last amplitude"] = last_amplitude

    def small(**by_name: float) -> float:
        time, reaction, first, *others = by_name.values()
        return (time + reaction) / swings / mean_amplitude_factor(abs(first), abs([first, *others][-1]))

    return SwingPeriod(
        combined(small, quantities), float(np.mean(times)) / swings, mean_amplitude_factor(first, last)
    )


def _require_alike(times: FloatArray, swings: int, reaction_time: float) -> None:
    """Reject readings (s) that cannot be of the same number of swings."""
    swing, given = float(np.median(times)) / swings, f"from {times.min():g} to {times.max():g} s"
    if times.max() > _ALIKE * times.min():
        raise ParameterError("readings", given, f"all within a factor of {_ALIKE:g} of each other")
    if np.ptp(times) > max(_MISCOUNTED * swing, _BEYOND_REACTION * reaction_time):
        allowed = f"the same to within a swing of {swing:.3g} s: was one miscounted?"
        raise ParameterError("readings", given, allowed)


def inertia_of_swing(period: Estimate, m: Measured, h: Measured, g: Measured) -> Estimate:
    """J = m*g*h*(T/(2*pi))^2, about the pivot (kg m2).

    Args:
        period: T of small undamped swings (s)
        m: mass (kg)
        h: pivot to center of mass (m)
        g: gravitational acceleration (m/s2); its sign does not matter

    Raises:
        ParameterError: m or h is not above 0, g is 0, so that nothing swings, or a body with its center of
            mass at h cannot swing as fast
    """
    positive("m", m.value, "kg")
    positive("h", h.value, "m")
    positive("g", abs(g.value), "m/s2")

    def inertia(T: float, m: float, h: float, g: float) -> float:  # noqa: N803  # the symbol of the period
        return m * abs(g) * h * (T / (2.0 * math.pi)) ** 2

    measured = Measured(period.value, period.uncertainty, period.freedom)
    found = combined(inertia, {"T": measured, "m": m, "h": h, "g": g})
    least = m.value * h.value**2
    if found.value + _BEYOND_ERROR * found.uncertainty < least:
        allowed = f"at least m h^2 = {least:.4g} kg m2: is a swing of {period.value:.4g} s right?"
        raise ParameterError("J", f"{found.value:.4g} kg m2", allowed)
    return found


def friction_of_swing(decay: Decay, m: Measured, h: Measured, g: Measured) -> Estimate:
    """Dry friction of the pivot, T_c = m*g*h*f (N m), with the friction angle f.

    Args:
        decay: from `period_of_record`
        m: mass (kg)
        h: pivot to center of mass (m)
        g: gravitational acceleration (m/s2); its sign does not matter
    """
    return combined(
        lambda f, m, h, g: m * abs(g) * h * f, {"f": decay.friction_angle, "m": m, "h": h, "g": g}
    )
