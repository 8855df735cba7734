"""Oracles of Initialization.mo."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.special import ellipj, ellipk

from tests.hybrid import Trajectory, integrate

from ..case import Array, Case, Values
from .state_events import at


@cache
def steady_state_run() -> Trajectory:
    """At rest 2x = y + 3 and x = y^2, so y = 1.5; from t = 1 on y is pushed by 1. Mode: the push."""

    def derivatives(_: float, z: Array, push: float) -> list[float]:
        return [-2 * z[0] + z[1] + 3, z[0] - z[1] ** 2 + push]

    def guards(t: float, _: Array, push: float) -> list[float]:
        return [1 - t] if push == 0 else [1.0]

    return integrate(derivatives, [2.25, 1.5], 0.0, guards, lambda t, y, mode, k: (y, 1.0), 4.0)


def steady_state(t: Array) -> Values:
    x, y = steady_state_run()(t)
    return {"x": x, "y": y}


def found_parameter_case(x_0: float) -> Case:
    """The stiffness is 8/x_0."""

    def expected(t: Array) -> Values:
        omega = np.sqrt(8 / x_0)
        x = x_0 * np.cos(omega * t)
        return {"k": np.full_like(t, 8 / x_0), "x": x, "force": -8 / x_0 * x}

    return Case("Initialization.FoundParameter", 5.0, expected, parameters={"x_0": x_0}, label=f"x_0={x_0}")


def found_from_zero_case(slope: float) -> Case:
    """An exponential decay from 2 with this slope."""

    def expected(t: Array) -> Values:
        return {"p": np.full_like(t, -slope / 2), "s": 2.0 * np.exp(slope / 2 * t)}

    return Case(
        "Initialization.FoundFromZero", 1.0, expected, parameters={"slope": slope}, label=f"slope={slope}"
    )


def starts_case(amplitude: float, omega: float) -> Case:
    def expected(t: Array) -> Values:
        phase = omega * t + 0.5
        return {
            "x": amplitude * np.cos(phase),
            "v": -amplitude * omega * np.sin(phase),
            "relative": np.ones_like(t),
            "stiffness": np.full_like(t, omega**2),
        }

    return Case(
        "Initialization.StartsFromParameters",
        3.0,
        expected,
        parameters={"amplitude": amplitude, "omega": omega},
        label=f"{amplitude}, {omega}",
    )


def pendulum_case(height: float) -> Case:
    def expected(t: Array) -> Values:
        """The elliptic sine: sin(phi/2) = k sn(K - t, k), with k = sin(phi_0/2)."""
        k = np.sqrt(height / 2)
        sn, cn, *_ = ellipj(ellipk(k**2) - t, k**2)
        return {"phi": 2 * np.arcsin(k * sn), "omega": -2 * k * cn, "h": 2 * (k * sn) ** 2}

    parameters = {"height": height}
    return Case("Initialization.Pendulum", 10.0, expected, parameters=parameters, label=f"{height}")


def guesses_case(p: float, q: tuple[float, float], upper: bool) -> Case:
    def expected(t: Array) -> Values:
        one, two, three = np.sqrt(1 + t), np.sqrt(4 + t), np.sqrt(9 + t)
        return {
            "k": np.full_like(t, -p),
            "loose": 3 * p + t,
            "z": np.full_like(t, 3 * p),
            "w": (1 if upper else -1) * np.sqrt(abs(p) + t),
            "u[1]": np.sign(q[0]) * two,
            "u[2]": np.sign(q[1]) * three,
            "r[1]": -one,
            "r[2]": np.sign(q[1]) * two,
            "each_one[1]": np.sign(p) * one,
            "each_one[2]": np.sign(p) * two,
            "filled[1]": np.sign(p) * one,
            "filled[2]": np.sign(p) * two,
        }

    parameters = {"p": p, "q[1]": q[0], "q[2]": q[1], "upper": upper}
    return Case("Initialization.Guesses", 1.0, expected, parameters=parameters, label=f"{p}, {q}, {upper}")


CASES = (
    Case("Initialization.SteadyState", 4.0, steady_state, events=at(1.0)),
    found_parameter_case(2.0),
    found_parameter_case(0.5),
    found_from_zero_case(-6.0),
    found_from_zero_case(-0.3),
    starts_case(2.0, 3.0),
    starts_case(0.3, 5.0),
    pendulum_case(0.5),
    pendulum_case(1.2),
    guesses_case(2.0, (1.0, -2.0), True),
    guesses_case(-5.0, (-1.0, 2.0), False),
)
