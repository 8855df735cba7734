"""The solutions of Moving.mo as analytic functions, so that complex steps differentiate them.

A complex step of 1e-30 gives the derivative to rounding error (Squire and Trapp, SIAM Review 40, 1998).
Branches are chosen by real parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, complex]
Solution = Callable[[float, Values], Mapping[str, complex]]

_STEP = 1e-30


@dataclass(frozen=True)
class Case:
    """A model of Moving.mo, its parameters, and its solution at a time from these parameters."""

    model: str
    parameters: Mapping[str, float]
    solution: Solution
    stop_time: float = 2.0
    accuracy: float = 1e-8
    """Largest difference allowed at a tolerance of 1e-10, relative to the derivative or to 1."""

    @property
    def request(self) -> str:
        return f"{','.join(self.solution(0.0, self.parameters))}:{','.join(self.parameters)}"

    def derivatives(self, times: Array) -> dict[str, Array]:
        """The sensitivities by name, at times that are no events."""
        return {
            f"sensitivity.{name}.{parameter}": np.array(
                [self._derivative(t, name, parameter) for t in times.tolist()]
            )
            for parameter in self.parameters
            for name in self.solution(0.0, self.parameters)
        }

    def _derivative(self, time: float, name: str, parameter: str) -> float:
        moved = {**self.parameters, parameter: self.parameters[parameter] + 1j * _STEP}
        return float(np.imag(self.solution(time, moved)[name]) / _STEP)


def _ball(time: float, p: Values) -> Mapping[str, complex]:
    g, e, floor = p["g"], p["e"], p["floor"]
    bounce, speed, best, latest = np.sqrt(2 * (p["start"] - floor) / g), g * 0, p["start"], g * 0
    speed = g * bounce
    if time < np.real(bounce):
        h, v = p["start"] - g * time**2 / 2, -g * time
    else:
        while True:
            latest, speed = bounce, e * speed
            best = floor + speed**2 / (2 * g)
            bounce = latest + 2 * speed / g
            if time < np.real(bounce):
                break
        h = floor + speed * (time - latest) - g * (time - latest) ** 2 / 2
        v = speed - g * (time - latest)
    return {"h": h, "v": v, "energy": v**2 / 2 + g * h, "t_bounce": latest, "best": best}


def _switch(time: float, p: Values) -> Mapping[str, complex]:
    change = 2 * p["T"]
    if time < np.real(change):
        return {"x": p["a"] * time**2 / 2, "held": p["a"]}
    there = p["a"] * change**2 / 2
    return {"x": there + p["b"] * (time - change), "held": there + p["b"]}


def _relay(time: float, p: Values) -> Mapping[str, complex]:
    x, since, on = p["low"], 0.0 * p["rate"], True
    while True:
        level, end = (1.0, p["high"]) if on else (0.0, p["low"])
        change = since + np.log((level - x) / (level - end)) / p["rate"]
        if time < np.real(change):
            return {"x": level + (x - level) * np.exp(-p["rate"] * (time - since))}
        x, since, on = end, change, not on


def _block(time: float, p: Values) -> Mapping[str, complex]:
    braking = 9.81 * p["mu"]
    rest = p["speed"] / braking
    if time < np.real(rest):
        return {"x": p["speed"] * time - braking * time**2 / 2, "v": p["speed"] - braking * time}
    return {"x": p["speed"] ** 2 / (2 * braking), "v": 0 * braking}


def _steady(time: float, p: Values) -> Mapping[str, complex]:
    k, x = p["k"], 0.5 + 0j
    for _ in range(60):
        x = x - (x + k * x**3 - p["u"]) / (1 + 3 * k * x**2)
    gain = k * x
    now = x * np.exp(-k * time) + gain * (np.exp(-time) - np.exp(-k * time)) / (k - 1)
    return {"x": now, "rest": gain - now}


def _loop(time: float, p: Values) -> Mapping[str, complex]:
    """``(1 + 3*y^2)*der(y) = -k*y``, so that log(y) + 3/2*y^2 falls as k*t."""
    k, first = p["k"], 1.0 + 0j
    for _ in range(60):
        first = first - (first + first**3 - 1.5 * k) / (1 + 3 * first**2)
    level, y = np.log(first) + 1.5 * first**2 - k * time, first
    for _ in range(200):
        step = (np.log(y) + 1.5 * y**2 - level) / (1 / y + 3 * y)
        y = y - step if np.real(y - step) > 0 else y / 2
    return {"x": (y + y**3) / k, "y": y}


def _called(time: float, p: Values) -> Mapping[str, complex]:
    return {"x": p["start"] / (1 + p["k"] * p["start"] * time)}


def _sampled(time: float, p: Values) -> Mapping[str, complex]:
    x, number = 1.0 + 0 * p["k"], int(time / 0.1 + 1e-9)
    for tick in range(number + 1):
        u, past = -p["k"] * x, min(time - 0.1 * tick, 0.1)
        x = u + (x - u) * np.exp(-past)
    return {"x": x, "u": u}


CASES = [
    Case("Ball", {"start": 1.3, "g": 9.81, "e": 0.8, "floor": 0.2}, _ball, stop_time=2.5),
    Case("Switch", {"T": 0.5, "a": 2.0, "b": -0.7}, _switch),
    Case("Relay", {"low": 0.4, "high": 0.6, "rate": 3.0}, _relay),
    Case("Block", {"speed": 2.0, "mu": 0.3}, _block),
    Case("Steady", {"k": 2.0, "u": 0.5}, _steady),
    Case("Loop", {"k": 2.0}, _loop),
    Case("Called", {"k": 0.9, "start": 2.0}, _called),
    Case("Sampled", {"k": 4.0}, _sampled),
]
