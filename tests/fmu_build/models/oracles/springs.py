"""Oracles of Springs.mo: integration of the equations with every kink located."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from tests.hybrid import Trajectory, integrate, relations

from ..case import Array, Case, Values


@dataclass(frozen=True)
class Spring:
    """A restrained preloaded spring."""

    k_s: float = 50.0
    k_h: float = 2000.0
    F_0: float = 5.0

    def force(self, d: float, touching: bool, released: bool) -> float:
        if not touching:
            return 0.0
        return self.F_0 + self.k_s * d if released else (self.k_h + self.k_s) * d

    def switches(self, d: float) -> list[float]:
        return [d, self.k_h * d - self.F_0]


def chain_run(
    springs: tuple[Spring, ...],
    compressions: Callable[[Array], list[float]],
    masses: tuple[float, ...],
    v_start: tuple[float, ...],
    damping: float,
    stop: float,
) -> Trajectory:
    """Masses in a row, springs[k] pushing mass k - 1 back and mass k forth, the outer ones against walls.

    States: positions, then velocities. Mode: for each spring, whether it touches and is released.
    """
    n = len(masses)

    def derivatives(_: float, y: Array, mode: tuple[bool, ...]) -> Array:
        forces = [
            spring.force(d, mode[2 * k], mode[2 * k + 1])
            for k, (spring, d) in enumerate(zip(springs, compressions(y[:n]), strict=True))
        ]
        return np.concatenate([y[n:], (-np.diff(forces) - damping * y[n:]) / np.array(masses)])

    def expressions(_: float, y: Array) -> list[float]:
        pairs = zip(springs, compressions(y[:n]), strict=True)
        return [value for spring, d in pairs for value in spring.switches(d)]

    # A spring that is exactly at its contact counts by where the motion takes it next.
    start = np.concatenate([np.zeros(n), v_start])
    ahead = np.concatenate([1e-9 * np.array(v_start), v_start])
    mode = tuple(value > 0 for value in expressions(0.0, ahead))
    guards, switch = relations(expressions)
    return integrate(derivatives, start, mode, guards, switch, stop)


@cache
def two_masses_run() -> Trajectory:
    return chain_run(
        (Spring(), Spring(k_s=30.0, F_0=3.0), Spring()),
        lambda x: [-x[0] - 0.01, x[0] - x[1] - 0.01, x[1] - 0.01],
        (1.0, 0.5),
        (2.0, 0.0),
        0.0,
        3.0,
    )


def two_masses(t: Array) -> Values:
    x_1, x_2, v_1, v_2 = two_masses_run()(t)
    return {"x_1": x_1, "x_2": x_2, "v_1": v_1, "v_2": v_2, "energy": v_1**2 / 2 + v_2**2 / 4}


@cache
def three_masses_run() -> Trajectory:
    return chain_run(
        (Spring(),) * 4,
        lambda x: [-x[0], x[0] - x[1] - 0.02, x[1] - x[2] - 0.02, x[2]],
        (1.0, 0.7, 1.3),
        (1.5, 0.0, -1.0),
        0.5,
        3.0,
    )


def three_masses(t: Array) -> Values:
    values = three_masses_run()(t)
    names = [f"{name}[{k}]" for name in "xv" for k in (1, 2, 3)]
    return dict(zip(names, values, strict=True))


@cache
def one_mass_run() -> Trajectory:
    return chain_run(
        (Spring(), Spring(30.0, 1000.0, 3.0)), lambda x: [-x[0], x[0] - 0.005], (1.0,), (1.0,), 0.0, 3.0
    )


def library_two_masses(t: Array) -> Values:
    x_1, x_2, v_1, v_2 = two_masses_run()(t)
    return {"first.s": x_1, "second.s": x_2, "first.v": v_1, "second.v": v_2, "first.E": v_1**2 / 2}


def library_three_masses(t: Array) -> Values:
    values = three_masses_run()(t)
    names = [f"mass[{k}].{name}" for name in "sv" for k in (1, 2, 3)]
    return dict(zip(names, values, strict=True))


def one_mass(t: Array) -> Values:
    x, v = one_mass_run()(t)
    return {"x": x, "v": v}


CASES = (
    Case("Springs.TwoMasses", 3.0, two_masses, events=lambda _: two_masses_run().events),
    # A hundred impacts on stiff contacts: what CVode is off at one of them grows at the next.
    Case(
        "Springs.ThreeMasses", 3.0, three_masses, me_accuracy=2e-4, events=lambda _: three_masses_run().events
    ),
    Case("LibraryChains.TwoMasses", 3.0, library_two_masses, events=lambda _: two_masses_run().events),
    Case(
        "LibraryChains.ThreeMasses",
        3.0,
        library_three_masses,
        me_accuracy=2e-4,
        events=lambda _: three_masses_run().events,
    ),
    # Relations inside a function make no events: the integrator has to step down over the kinks.
    Case("Springs.InlineFunction", 3.0, one_mass, accuracy=1e-5, me_accuracy=1e-4),
)
