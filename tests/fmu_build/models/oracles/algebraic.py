"""Oracles of Algebraic.mo."""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.optimize import brentq, fsolve

from ..case import Array, Case, Values
from .state_events import at


def shared_part(t: Array) -> Values:
    p = 1.06
    return {"z": p * np.sin(p * np.sin(p)) * t + np.sin(p)}


def linear_loop(t: Array) -> Values:
    """The loop is A z = b + c x, so x' = -(z_b + z_c x) with the first components of A^-1 b and A^-1 c."""
    matrix = np.array([[2.0, 1, -1], [1, -3, 1], [1, 1, 4]])
    constant, slope = np.linalg.solve(matrix, [0, 0, 1]), np.linalg.solve(matrix, [2, 1, 1])
    rest = -constant[0] / slope[0]
    x = rest + (1 - rest) * np.exp(-slope[0] * t)
    u, v, w = constant[:, np.newaxis] + slope[:, np.newaxis] * x
    return {"x": x, "u": u, "v": v, "w": w}


def nonlinear_loop(t: Array) -> Values:
    def residual(z: Array, x: float) -> list[float]:
        u, v, w = z
        return [u + v * v - 2 - x, v + w**3 - 2 - x, w + np.exp(u - 1) - 2 - x]

    solution, guess = np.empty((3, t.size)), np.ones(3)
    for k in np.argsort(t):
        guess = fsolve(residual, guess, args=(t[k],), xtol=1e-12)
        solution[:, k] = guess
    return dict(zip("uvw", solution, strict=True))


def tiny_loop(t: Array) -> Values:
    """Cardano's solution of z + z^3 = 2 exp(-t)."""
    half = np.exp(-t)
    root = np.sqrt(half * half + 1 / 27)
    return {"z": np.cbrt(half + root) + np.cbrt(half - root)}


def kepler_case(eccentricity: float) -> Case:
    def anomaly(mean: float) -> float:
        return float(brentq(lambda e: e - eccentricity * np.sin(e) - mean, mean - 1, mean + 1, xtol=1e-15))

    def expected(t: Array) -> Values:
        e = np.array([anomaly(mean) for mean in t])
        return {"E": e, "r": 1 - eccentricity * np.cos(e)}

    parameters = {"eccentricity": eccentricity}
    return Case("Algebraic.Kepler", 13.0, expected, parameters=parameters, label=f"{eccentricity}")


def no_states(t: Array) -> Values:
    u, w = 1 + 2 * t, 3 - t
    return {"sum": u + 3 * w, "product": u * w, "root": np.hypot(u, w)}


def diode_bridge(t: Array) -> Values:
    """V = u/(1 + R g); over a half period the charge grows by 2 g/(1 + R g)."""
    forward, backward = 10 / 21, 1e-3 / 1.002
    factor = np.where(np.sin(t) > 0, forward, backward)
    half, rest = np.divmod(t, np.pi)
    whole = 2 * (np.ceil(half / 2) * forward - np.floor(half / 2) * backward)
    sign = np.where(half % 2 == 0, 1, -1)
    return {"i": factor * np.sin(t), "q": whole + sign * factor * (1 - np.cos(rest))}


def aliases(t: Array) -> Values:
    x = 2 * np.exp(-t)
    return {"x": x, "same": x, "opposite": -x, "twice_opposite": x, "v": -x}


def kinks(t: Array) -> Values:
    u = np.sin(2 * t)
    half, rest = np.divmod(2 * t, np.pi)
    return {
        "lowest": np.minimum(u, 0.25),
        "highest": np.maximum(u, -0.25),
        "absolute": np.abs(u),
        "direction": np.sign(u),
        "z": (2 * half + 1 - np.cos(rest)) / 2,
    }


def warm_resistor(t: Array) -> Values:
    """With u = T - 300: slope u^2 + u = v^2/(R_0 G)."""
    v = 10 * np.sin(t)
    u = np.sqrt(1 + 4 * 0.5 * v**2 / (10 * 0.5)) - 1
    resistance = 10 * (1 + 0.5 * u)
    return {"T": 300 + u, "R": resistance, "i": v / resistance, "Q": v**2 / resistance}


def through_function(t: Array, k: float) -> Values:
    """Cardano's solution of k s^3 + 2 s = t."""
    half, third = t / (2 * k), 2 / (3 * k)
    root = np.sqrt(half**2 + third**3)
    s = np.cbrt(half + root) + np.cbrt(half - root)
    return {"stretch": s, "force": t - s, "energy": s**2 / 2 + k * s**4 / 4}


def undefined_at_zero(t: Array) -> Values:
    """The supply is 20, so that 0.95 current = t/20; z is the square of r with r + r^2 = 2 + t."""
    current = t / 19
    return {
        "current": current,
        "plus": 10 - current / 2,
        "z": (np.sqrt(2.25 + t) - 0.5) ** 2,
        "a": 1.75 + t / 2,
        "c": 2 + t / 2,
    }


CASES = (
    Case("Algebraic.UndefinedAtZero", 2.0, undefined_at_zero),
    Case("Algebraic.WarmResistor", 3.0, warm_resistor),
    Case("Algebraic.LoopThroughFunction", 2.0, partial(through_function, k=2.0)),
    Case(
        "Algebraic.LoopThroughFunction",
        2.0,
        partial(through_function, k=0.3),
        parameters={"k": 0.3},
        label="soft",
    ),
    Case("Algebraic.LinearLoop", 2.0, linear_loop),
    Case("Algebraic.SharedPart", 1.0, shared_part),
    Case("Algebraic.NonlinearLoop", 1.0, nonlinear_loop),
    Case("Algebraic.TinyLoop", 2.0, tiny_loop),
    kepler_case(0.5),
    kepler_case(0.9),
    Case(
        "Algebraic.NoStates",
        1.0,
        no_states,
        accuracy=1e-12,
        inputs={"u": lambda t: 1 + 2 * t, "w": lambda t: 3 - t},
    ),
    Case("Algebraic.DiodeBridge", 10.0, diode_bridge, events=at(0.0, np.pi, 2 * np.pi, 3 * np.pi)),
    Case("Algebraic.Aliases", 2.0, aliases),
    # abs, sign, min and max make no events: the integrator steps over the kinks of |sin|.
    Case("Algebraic.Kinks", 5.0, kinks, accuracy=1e-6),
)
