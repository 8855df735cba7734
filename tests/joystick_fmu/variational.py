"""The variational equations of the joystick, eqs. (1), (3), (5) corrected, (6)-(8), (11), by hand.

Shares no code with the FMU or the reference: branches, partial derivatives and the jumps at their ends are
written out here, and SciPy's DOP853 integrates them.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

Array = NDArray[np.float64]
Values = Mapping[str, float]
LARGEST_ANGLE = 1.5
#: Seconds: short enough that the motion cannot pass a kink and return to it within the first step behind it.
FIRST_STEP = 1e-6


@dataclass(frozen=True)
class Kink:
    """An angle (rad) where the branch changes, and its derivatives by the parameters."""

    theta: float
    partials: Array


@dataclass(frozen=True)
class Springs:
    """What the springs are on one branch: linear in the travel x, and so are their derivatives."""

    side: float
    stiffness: float
    force_at_zero: float
    partials_at_zero: Array
    partials_slope: Array


def _excess(time: float, motion: Any, angle: float) -> float:
    return float(motion(time)[0] - angle)


def _terminal(place: int, value: float, direction: float) -> Any:
    """A terminal event of SciPy where y[place] passes a value upwards (1) or downwards (-1)."""

    def event(_: float, y: Array) -> float:
        return float(y[place] - value)

    event.terminal, event.direction = True, direction  # type: ignore[attr-defined]
    return event


class Joystick:
    """Angle, angular velocity and their derivatives by `parameters`, one joystick, released from rest."""

    def __init__(self, values: Values, parameters: Sequence[str]) -> None:
        self.values = values
        self.parameters = list(parameters)
        self.places = {name: place for place, name in enumerate(parameters)}
        self.law = {name.partition(".")[2]: value for name, value in values.items() if "damping." in name}
        self.kinks = sorted(self._kinks(), key=lambda kink: kink.theta)
        self.springs = [self._springs(branch) for branch in range(len(self.kinks) + 1)]

    def motion(self, times: Array, theta_start: float, omega_start: float = 0.0) -> tuple[Array, int]:
        """Return the rows theta, omega, then both by each parameter, at `times`; and the number of events."""
        n = len(self.parameters)
        state = np.zeros(2 + 2 * n)
        state[:2] = theta_start, omega_start
        for start, place in (("theta_start", 0), ("omega_start", 1)):
            if start in self.parameters:
                state[2 + 2 * self.parameters.index(start) + place] = 1.0
        rows, now, events = np.empty((len(state), len(times))), float(times[0]), 0
        branch = bisect_right([kink.theta for kink in self.kinks], theta_start)
        heading = math.copysign(1.0, omega_start or self._rates(state, branch)[1])
        while now < times[-1]:
            leg = self._leg(state, branch, heading, now, float(times[-1]))
            end, change = self._end(leg, branch)
            for number in np.flatnonzero((times >= now) & (times <= end)):
                rows[:, number] = leg.sol(times[number])
            state, now = leg.sol(end), end
            if change == 0:
                heading = -heading  # it turns, or the run has ended
                continue
            events += 1
            heading = float(change)
            kink = self.kinks[branch if change > 0 else branch - 1]
            move = (kink.partials - state[2::2]) / state[1]
            after = branch + change
            state[3::2] += (self._rates(state, branch)[1] - self._rates(state, after)[1]) * move
            branch = after
        return rows, events

    def _leg(self, state: Array, branch: int, heading: float, start: float, stop: float) -> Any:
        """Integrate to the end of the branch, or of the run, or until the motion turns.

        Without the turning points SciPy would not see that the motion leaves a branch and returns in a step.
        """
        return solve_ivp(
            lambda _, y: self._rates(y, branch),
            (start, stop),
            state,
            "DOP853",
            dense_output=True,
            first_step=min(FIRST_STEP, stop - start),
            rtol=1e-11,
            atol=1e-12,
            events=[
                _terminal(0, self._end_angle(branch, -1), -1.0),
                _terminal(0, self._end_angle(branch, 1), 1.0),
                _terminal(1, 0.0, -heading),
            ],
        )

    def _end_angle(self, branch: int, side: int) -> float:
        number = branch if side > 0 else branch - 1
        return self.kinks[number].theta if 0 <= number < len(self.kinks) else side * LARGEST_ANGLE

    def _end(self, leg: Any, branch: int) -> tuple[float, int]:
        """Return when the leg ends, to rounding, and whether it enters the branch above (1) or below (-1)."""
        stop = float(leg.t[-1])
        if leg.status != 1:
            return stop, 0
        for side, reached in ((-1, leg.t_events[0]), (1, leg.t_events[1])):
            angle = self._end_angle(branch, side)
            last = float(leg.sol.interpolants[-1].t) if len(reached) else stop
            if len(reached) or side * (leg.sol(stop)[0] - angle) > 0.0:
                crossing = brentq(_excess, float(leg.t[-2]), last, args=(leg.sol, angle), xtol=1e-15)
                return float(crossing), side
        return stop, 0

    def _rates(self, y: Array, branch: int) -> Array:
        theta, omega = float(y[0]), float(y[1])
        alpha, by_theta, by_omega, partials = self._acceleration(theta, omega, branch)
        rates = np.empty_like(y)
        rates[0], rates[1] = omega, alpha
        rates[2::2] = y[3::2]
        rates[3::2] = by_theta * y[2::2] + by_omega * y[3::2] + partials
        return rates

    def _acceleration(self, theta: float, omega: float, branch: int) -> tuple[float, float, float, Array]:
        """Return alpha and its partial derivatives by theta, omega and the parameters, within a branch."""
        v, springs = self.values, self.springs[branch]
        side = springs.side
        tangent, cosine = math.tan(theta), math.cos(theta)
        x = v["a"] * side * tangent + v["b"] * (1.0 - 1.0 / cosine)
        slope = (v["a"] * side - v["b"] * math.sin(theta)) / cosine**2
        bend = 2.0 * tangent * slope - v["b"] / cosine
        force = springs.force_at_zero + springs.stiffness * x
        damping, d_theta, d_omega, d_parameter = self._damping(theta, omega, side)
        weight = v["m"] * v["g"] * v["h"]
        moment = weight * math.sin(theta) - force * slope - damping * omega
        alpha, inertia = moment / v["J"], v["J"]
        by_theta = weight * math.cos(theta) - springs.stiffness * slope**2 - force * bend - d_theta * omega
        partials = -slope * (springs.partials_at_zero + springs.partials_slope * x)
        for name, derivative in d_parameter.items():
            if name in self.places:
                partials[self.places[name]] -= derivative * omega
        if "J" in self.places:
            partials[self.places["J"]] -= alpha
        return alpha, by_theta / inertia, -(damping + d_omega * omega) / inertia, partials / inertia

    def _middle(self, branch: int) -> float:
        ends = [-LARGEST_ANGLE, *(kink.theta for kink in self.kinks), LARGEST_ANGLE]
        return 0.5 * (ends[branch] + ends[branch + 1])

    def _springs(self, branch: int) -> Springs:
        middle = self._middle(branch)
        side = "forward" if middle > 0.0 else "backward"
        inside = self._travel(abs(middle))
        stiffness, force_at_zero = 0.0, 0.0
        at_zero, slope = np.zeros(len(self.parameters)), np.zeros(len(self.parameters))
        for spring in (f"{side}.returnSpring", f"{side}.balanceSpring"):
            k_s, k_h, preload, start = (
                self.values[f"{spring}.{name}"] for name in ("k_s", "k_h", "F_0", "x_0")
            )
            if inside <= start:
                continue
            if inside <= start + preload / k_h:  # (k_s + k_h) * (x - x_0)
                of_spring, force, following = k_s + k_h, 0.0, ("k_s", "k_h")
            else:  # F_0 + k_s * (x - x_0)
                of_spring, force, following = k_s, preload, ("k_s",)
            stiffness += of_spring
            force_at_zero += force - of_spring * start
            partials = {"x_0": (-of_spring, 0.0), **dict.fromkeys(following, (-start, 1.0))}
            if force:
                partials["F_0"] = (1.0, 0.0)
            for name, (constant, factor) in partials.items():
                if (place := self.places.get(f"{spring}.{name}")) is not None:
                    at_zero[place] += constant
                    slope[place] += factor
        return Springs(math.copysign(1.0, middle), stiffness, force_at_zero, at_zero, slope)

    def _damping(
        self, theta: float, omega: float, side: float
    ) -> tuple[float, float, float, dict[str, float]]:
        """Return C and its derivatives by theta, omega and the law's parameters: constant, or eq. (11)."""
        v = self.law
        if "C" in v:
            return v["C"], 0.0, 0.0, {"damping.C": 1.0}
        sign = "pos" if side > 0.0 else "neg"
        amount, exponent = v[f"A_{sign}"], v[f"n_{sign}"]
        angle, rate = math.hypot(theta, v["eps_theta"]), math.hypot(omega, v["eps_omega"])
        of_angle, of_rate = angle**exponent, rate ** v["m"]
        first, second = v["alpha"] * amount * of_angle, (1.0 - v["alpha"]) * v["B"] * of_rate
        partials = {
            "damping.alpha": amount * of_angle - v["B"] * of_rate,
            f"damping.A_{sign}": v["alpha"] * of_angle,
            f"damping.n_{sign}": first * math.log(angle),
            "damping.B": (1.0 - v["alpha"]) * of_rate,
            "damping.m": second * math.log(rate),
        }
        return (
            first + second,
            first * exponent * theta / angle**2,
            second * v["m"] * omega / rate**2,
            partials,
        )

    def _travel(self, theta: float) -> float:
        v = self.values
        return v["a"] * math.tan(theta) + v["b"] * (1.0 - 1.0 / math.cos(theta))

    def _kinks(self) -> list[Kink]:
        """The middle, and where a spring engages (x_0) or is released (x_0 + F_0/k_h), on either side."""
        v = self.values
        found = [Kink(0.0, np.zeros(len(self.parameters)))]
        for side, sign in (("forward", 1.0), ("backward", -1.0)):
            for kind in ("returnSpring", "balanceSpring"):
                spring = f"{side}.{kind}"
                start, preload, k_h = (v[f"{spring}.{name}"] for name in ("x_0", "F_0", "k_h"))
                release = {
                    f"{spring}.x_0": 1.0,
                    f"{spring}.F_0": 1.0 / k_h,
                    f"{spring}.k_h": -preload / k_h**2,
                }
                found.append(self._kink(start, sign, {f"{spring}.x_0": 1.0}))
                found.append(self._kink(start + preload / k_h, sign, release))
        return found

    def _kink(self, x: float, sign: float, partials: Values) -> Kink:
        theta = float(brentq(lambda angle: self._travel(angle) - x, 0.0, LARGEST_ANGLE, xtol=1e-16))
        slope = (self.values["a"] - self.values["b"] * math.sin(theta)) / math.cos(theta) ** 2
        by_parameter = np.array([partials.get(name, 0.0) for name in self.parameters])
        return Kink(sign * theta, sign * by_parameter / slope)
