"""Oracles of Oscillators.mo, Functions.mo and Arrays.mo."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.linalg import expm

from tests.hybrid import Trajectory, integrate

from ..case import Array, Case, Values
from .state_events import at, count
from .time_events import ramps


def linear_system(matrix: Array, forcing: Array, start: Array, times: Array) -> Array:
    """The solution of x' = A x + b with constant b, through the exponential of [[A, b], [0, 0]]."""
    n = len(start)
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n] = matrix, forcing
    extended = np.append(start, 1.0)
    return np.array([(expm(whole * t) @ extended)[:n] for t in times]).T


def smooth_run(derivatives: object, start: object, stop: float) -> Trajectory:
    return integrate(
        lambda t, y, _: derivatives(t, y),  # type: ignore[operator]
        start,
        None,
        lambda t, y, _: [],
        lambda t, y, mode, k: (y, mode),
        stop,
    )


def harmonic_case(omega: float) -> Case:
    def expected(t: Array) -> Values:
        return {"x": np.cos(omega * t), "v": -omega * np.sin(omega * t)}

    return Case("Oscillators.Harmonic", 10.0, expected, parameters={"omega": omega}, label=f"{omega}")


@cache
def van_der_pol_run() -> Trajectory:
    return smooth_run(lambda t, z: [z[1], (1 - z[0] ** 2) * z[1] - z[0]], [2.0, 0.0], 15.0)


def van_der_pol(t: Array) -> Values:
    x, y = van_der_pol_run()(t)
    return {"x": x, "y": y}


def driven_ramp(t: Array) -> Values:
    """M = 1, d = 0.4, k = 4 under F = 2t: a straight line and a damped oscillation."""
    omega = np.sqrt(4 - 0.04)
    rate, offset = 2 / 4, -0.4 * 2 / 16
    a, b = -offset, (-rate - 0.2 * offset) / omega
    decay, c, s = np.exp(-0.2 * t), np.cos(omega * t), np.sin(omega * t)
    x = offset + rate * t + decay * (a * c + b * s)
    v = rate + decay * ((b * omega - 0.2 * a) * c - (a * omega + 0.2 * b) * s)
    return {"x": x, "v": v, "a": 2 * t - 0.4 * v - 4 * x, "power": 2 * t * v}


def stiff(t: Array) -> Values:
    return {"x": np.exp(-t), "y": 1000 / 999 * (np.exp(-t) - np.exp(-1000 * t))}


def differentiated(t: Array) -> Values:
    x = np.sin(t)
    return {"y": np.sin(x) * x, "rate": (np.cos(x) * x + np.sin(x)) * np.cos(t)}


def switched_input(t: Array) -> Values:
    """U = t - 0.5 until t = 2; it is interpolated linearly, so that its zero is exact."""
    u = t - 0.5
    return {
        "x": ramps(t, [0.5], [-1, 1]),
        "y": np.where(u > 0, 2 * u, u),
        "changes": count(t, np.array([0.5])),
    }


def inlined(t: Array) -> Values:
    return {"x": -np.tanh(t - np.arctanh(0.5))}


def polynomial(t: Array) -> Values:
    p = (t - 1) * (t - 2) * (t - 3)
    return {"p": p, "dp": 3 * t**2 - 12 * t + 11, "integral": p}


def function_table(t: Array) -> Values:
    return {"y": np.interp(4 * t, [0, 1, 2, 4], [0, 2, 1, 5])}


def newton(t: Array) -> Values:
    return {"y": np.sqrt(1 + 3 * t)}


def function_threshold(t: Array) -> Values:
    """The polynomial x^2 + x + 1 passes 1.75 at x = 0.5 and 3 at x = 1."""
    return {"above": (t > 0.5).astype(float), "y": ramps(t, [0.5, 1.0], [0, 1, 2])}


def rotation(t: Array) -> Values:
    return {
        "x[1]": np.cos(t),
        "x[2]": np.sin(t),
        "w[1]": np.cos(t + 0.5),
        "w[2]": np.sin(t + 0.5),
    }


def shapes_case(g: float) -> Case:
    def at_time(t: float) -> dict[str, float]:
        a = np.array([[1, 2, t], [4, 5, 6]])
        arrays = {
            "A": a,
            "B": a.T,
            "C": a @ a.T,
            "row": a[1],
            "column": a[:, 2],
            "long": np.array([t, g, g * t, g * t]),
            "d": np.diag([g, t]),
            "t": 2 * (a + np.array([[t, 0, 0], [0, 0, 1]])).T,
            "k": t * np.linspace(0, g, 3),
            "beside": np.hstack((a, np.diag([g, t]))),
            "r": np.eye(5) - g**2 * np.outer(range(1, 6), range(1, 6)) / 55,
        }
        return {
            f"{name}[{','.join(str(i + 1) for i in index)}]": float(array[index])
            for name, array in arrays.items()
            for index in np.ndindex(array.shape)
        }

    def expected(t: Array) -> Values:
        rows = [at_time(time) for time in t]
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}

    return Case("Arrays.Shapes", 1.0, expected, 1e-12, 1e-12, parameters={"g": g}, label=f"{g}")


def members_case(k: tuple[float, float, float]) -> Case:
    def expected(t: Array) -> Values:
        one = np.ones_like(t)
        return {
            "whole[1,1]": k[2] * t,
            "whole[1,2]": (k[2] + 10) * one,
            "whole[2,1]": k[0] * t,
            "whole[2,2]": (k[0] + 10) * one,
            "first[1]": k[0] * t,
            "first[2]": k[1] * t,
            "first[3]": k[2] * t,
            "total": (k[1] + k[2]) * one,
        }

    parameters = {f"k[{i + 1}]": value for i, value in enumerate(k)}
    return Case("Arrays.Members", 1.0, expected, 1e-12, 1e-12, parameters=parameters, label=f"{k[1]}")


BREAKPOINTS = np.array([0.1, 0.3, 0.6, 0.8])


def table_case(slopes: tuple[float, ...], label: str) -> Case:
    def expected(t: Array) -> Values:
        return {"y": ramps(0.5 - 0.5 * np.cos(t), BREAKPOINTS, [0.0, *slopes])}

    def events(stop: float) -> Array:
        up = np.arccos(1 - 2 * BREAKPOINTS)
        return np.sort(np.concatenate([up, 2 * np.pi - up]))

    parameters = {f"k_i[{k + 1}]": slope for k, slope in enumerate(slopes)}
    return Case(
        "Arrays.Table",
        6.0,
        expected,
        accuracy=1e-12,
        me_accuracy=1e-12,
        events=events,
        parameters=parameters,
        label=label,
    )


def matrix_vector(t: Array) -> Values:
    a = np.array([[-1.0, 2, 0], [-2, -1, 1], [0, -1, -0.5]])
    x = linear_system(a, np.array([1.0, 0, -1]), np.array([1.0, 2, 3]), t)
    return {
        **{f"x[{k + 1}]": x[k] for k in range(3)},
        "norm": (x * x).sum(axis=0),
        "total": x.sum(axis=0),
        "quadratic": np.einsum("it,ij,jt->t", x, a.T, x),
        "biggest": x.max(axis=0),
    }


def heat(t: Array) -> Values:
    n = 8
    a = np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1) - 2 * np.eye(n)
    a[0, 0] = a[-1, -1] = -1
    temperature = linear_system(0.1 * n * n * a, np.eye(n)[0], np.zeros(n), t)
    return {**{f"T[{k + 1}]": temperature[k] for k in range(n)}, "mean": t / n}


def products(t: Array) -> Values:
    c = np.array([2.0, 6, 12])[:, np.newaxis] * t + 1
    values = {f"c[{j + 1}]": c[j] for j in range(3)}
    values |= {f"M[{i},{j}]": i * c[j - 1] for i in (1, 2) for j in (1, 2, 3)}
    return values | {"s": 3 * c.sum(axis=0), "slice[1]": c[1], "slice[2]": c[2]}


CASES = (
    harmonic_case(2.0),
    harmonic_case(0.5),
    Case("Oscillators.VanDerPol", 15.0, van_der_pol),
    Case("Oscillators.Driven", 5.0, driven_ramp, inputs={"F": lambda t: 2 * t}),
    Case("Oscillators.Stiff", 2.0, stiff),
    Case("Oscillators.Differentiated", 5.0, differentiated),
    Case("Oscillators.SwitchedInput", 2.0, switched_input, inputs={"u": lambda t: t - 0.5}, events=at(0.5)),
    Case("Oscillators.DefaultInput", 2.0, lambda t: {"x": 2 - np.exp(-t), "u": np.full_like(t, 2.0)}),
    Case("Functions.Inlined", 3.0, inlined),
    Case("Functions.Polynomial", 4.0, polynomial),
    Case("Functions.Ignored", 2.0, lambda t: {"y": np.sin(t), "z": 3 * np.sin(np.sqrt(1 + t)) + 1}),
    Case("Functions.Given", 2.0, lambda t: {"y": np.sin(t), "z": np.exp(-t)}),
    Case("Functions.Table", 1.0, function_table, accuracy=1e-12, me_accuracy=1e-12),
    Case("Functions.Newton", 1.0, newton, accuracy=1e-12, me_accuracy=1e-12),
    Case("Functions.Threshold", 1.5, function_threshold, events=at(0.5, 1.0)),
    Case("Functions.Rotation", 6.0, rotation),
    table_case((5.0, 1.0, 10.0, 2.0), "default"),
    table_case((1.0, 4.0, 0.0, 3.0), "other slopes"),
    Case("Arrays.MatrixVector", 4.0, matrix_vector),
    Case("Arrays.Heat", 1.0, heat),
    members_case((1.0, 2.0, 5.0)),
    members_case((1.5, -4.0, 0.25)),
    shapes_case(3.0),
    shapes_case(-0.7),
    Case("Arrays.Products", 1.0, products, accuracy=1e-12, me_accuracy=1e-12),
)
