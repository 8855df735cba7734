"""Oracles of Components.mo."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np

from tests.hybrid import Trajectory

from ..case import Array, Case, Values
from .smooth import linear_system, smooth_run
from .state_events import at
from .time_events import ramps


def circuit(t: Array) -> Values:
    """L i' = V - R i - u, C u' = i with V = 2, R = 0.5, L = 1, C = 0.25."""
    i, u = linear_system(np.array([[-0.5, -1.0], [4.0, 0.0]]), np.array([2.0, 0.0]), np.zeros(2), t)
    return {"inductor.i": i, "capacitor.u": u, "resistor.u": 0.5 * i, "inductor.u": 2 - 0.5 * i - u}


def bridge(t: Array) -> Values:
    """Thevenin: V*(R3/(R1 + R3) - R4/(R2 + R4)) behind R1||R3 + R2||R4 and the load."""
    source = 3 * (3 / 4 - 4 / 6)
    resistance = 3 / 4 + 8 / 6 + 0.5
    u = source * (1 - np.exp(-t / (resistance * 0.2)))
    return {"capacitor.u": u, "load.i": (source - u) / resistance}


def chain(t: Array) -> Values:
    n = 5
    stiffness = 10 * (2 * np.eye(n) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1))
    stiffness[-1, -1] = 10
    squares, shapes = np.linalg.eigh(stiffness)
    omega = np.sqrt(squares)[:, np.newaxis]
    start = shapes.T @ np.eye(n)[-1]
    s = shapes @ (start[:, np.newaxis] * np.sin(omega * t) / omega)
    v = shapes @ (start[:, np.newaxis] * np.cos(omega * t))
    return {f"body[{k + 1}].s": s[k] for k in range(n)} | {f"body[{k + 1}].v": v[k] for k in range(n)}


def heavy_chain(t: Array) -> Values:
    """Four times the mass: everything takes twice as long; the same speed at the start, twice the way."""
    light = chain(t / 2)
    return {name: (2 if name.endswith(".s") else 1) * value for name, value in light.items()}


def replaceable(t: Array) -> Values:
    return {"body.s": np.cos(t), "body.v": -np.sin(t)}


@cache
def redeclared_run() -> Trajectory:
    return smooth_run(lambda t, y: [y[1], -(y[0] + 4 * y[0] ** 3) / 2], [1.0, 0.0], 10.0)


def redeclared(t: Array) -> Values:
    s, v = redeclared_run()(t)
    return {"body.s": s, "body.v": v, "element.f": s + 4 * s**3}


def redeclared_component(t: Array) -> Values:
    return {f"part.{name}": value for name, value in redeclared(t).items()}


def conditional(t: Array) -> Values:
    return {"body.s": np.cos(3 * t), "extra.f": 5 * np.cos(3 * t)}


def falling(t: Array) -> Values:
    return {
        "light.h": 10 - 2.5 * t**2,
        "heavy.h": 20 - 2.5 * t**2,
        "light.weight": np.full_like(t, 30.0),
        "heavy.weight": np.full_like(t, 60.0),
    }


def gear_case(selected: int, ratio: int, braked: bool, label: str) -> Case:
    speed = 0 if braked else {1: -1, 2: 0, 3: ratio}[selected]

    def expected(t: Array) -> Values:
        gear = np.where((t < 1) | braked, 2.0, selected)
        return {"gear": gear, "x": ramps(t, [1.0], [0, speed])}

    parameters: dict[str, float | int | bool] = {"selected": selected, "ratio": ratio, "braked": braked}
    return Case("Components.GearBox", 2.0, expected, events=at(1.0), parameters=parameters, label=label)


def torsion(t: Array) -> Values:
    """J = 1 and 2, c = 2, d = 0.1; states phi_1, w_1, phi_2, w_2."""
    a = np.array([[0.0, 1, 0, 0], [-2, -0.1, 2, 0.1], [0, 0, 0, 1], [1, 0.05, -1, -0.05]])
    phi_1, w_1, phi_2, w_2 = linear_system(a, np.zeros(4), np.array([1.0, 0, 0, 0]), t)
    return {
        "first.phi": phi_1,
        "first.w": w_1,
        "second.phi": phi_2,
        "second.w": w_2,
        "shaft.tau": 2 * (phi_2 - phi_1) + 0.1 * (w_2 - w_1),
    }


def rates(
    r: float,
    g: tuple[float, float],
    n: int = 1,
    is_on: bool = True,
    open_gain: tuple[float, float] = (1, 1),
    twice: float | None = None,
) -> dict[str, float]:
    """The rate of change of each part of Rates."""

    def rate(value: float, gain: tuple[float, float], double: float | None = None) -> float:
        return gain[0] * value + gain[1] * (2 * value if double is None else double)

    return {
        "open": rate(r, open_gain),
        "closed": rate(r, g, twice),
        "half": rate(r / 2, (1, n)),
        "many[1]": rate(r, (r, 0)),
        "many[2]": rate(r, g),
        "switched": rate(r if is_on else 0, (1, 1)),
    }


def handed_down_case(
    first: dict[str, float], second: dict[str, float], label: str, parameters: Mapping[str, float] = {}
) -> Case:
    parts = {"first": first, "second": second}
    slopes = {f"{name}.{part}.y": slope for name, one in parts.items() for part, slope in one.items()}
    return Case(
        "Components.HandedDown",
        1.5,
        lambda t: {name: slope * t for name, slope in slopes.items()},
        parameters=parameters,
        label=label,
    )


CASES = (
    handed_down_case(
        rates(0.5, (2, 0.25), 2), rates(0.25, (1, 1), open_gain=(3, 0), twice=0.1), "as written"
    ),
    handed_down_case(
        rates(0.9, (2, 0.25), 5, is_on=False),
        rates(-1.25, (1, 1), open_gain=(3, 0), twice=0.1),
        "set",
        {"first.r": 0.9, "first.n": 5, "first.is_on": False, "second.r": -1.25},
    ),
    handed_down_case(
        rates(0.5, (-1.5, 0.75), 2),
        rates(0.25, (0.5, 1), open_gain=(4, 0), twice=0.3),
        "arrays set",
        {
            "first.g[1]": -1.5,
            "first.g[2]": 0.75,
            "second.g[1]": 0.5,
            "second.open.gain[1]": 4.0,
            "second.closed.twice": 0.3,
        },
    ),
    Case("Components.Opposites", 1.0, lambda t: {"one.y": 2 * t, "other.y": t}),
    Case(
        "Components.Opposites",
        1.0,
        lambda t: {"one.y": t, "other.y": 2 * t},
        parameters={"pace": 1},
        label="slow",
    ),
    Case("Components.Circuit", 8.0, circuit),
    Case("Components.Bridge", 2.0, bridge),
    Case("Components.Chain", 5.0, chain),
    Case(
        "Components.Chain",
        5.0,
        heavy_chain,
        parameters={f"body[{k}].m": 4.0 for k in range(1, 6)},
        label="heavy",
    ),
    Case("Components.Hidden", 5.0, lambda t: {"seen": np.sin(2 * t), "own": np.exp(-t)}),
    Case("Components.Replaceable", 10.0, replaceable),
    Case("Components.Redeclared", 10.0, redeclared),
    Case("Components.RedeclaredComponent", 10.0, redeclared_component),
    Case("Components.OuterParameter", 1.0, lambda t: {"first.v": -3 * t, "second.v": 1 - 3 * t}),
    Case(
        "Components.OuterParameter",
        1.0,
        lambda t: {"first.v": -7 * t, "second.v": 1 - 7 * t},
        parameters={"gravity": 7.0},
        label="gravity",
    ),
    Case("Components.Conditional", 5.0, conditional),
    Case("Components.Falling", 1.0, falling),
    gear_case(3, 3, False, "default"),
    gear_case(3, 5, False, "ratio"),
    gear_case(1, 3, False, "reverse"),
    gear_case(3, 3, True, "braked"),
    Case("Components.Torsion", 10.0, torsion),
)
