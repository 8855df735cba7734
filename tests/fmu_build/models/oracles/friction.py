"""Oracles of Friction.mo."""

from __future__ import annotations

from functools import cache

import numpy as np

from ..case import Array, Case, Values
from ..hybrid import Trajectory, integrate
from .state_events import at


@cache
def stick_slip_run() -> Trajectory:
    """Mode: (slipping, number of slips). m = k = 1, belt 0.2, static friction 1.0, slip friction 0.6."""

    def guards(_: float, y: Array, mode: tuple[bool, int]) -> list[float]:
        return [0.2 - y[1]] if mode[0] else [1.0 - y[0]]

    def switch(_: float, y: Array, mode: tuple[bool, int], __: int) -> tuple[Array, tuple[bool, int]]:
        return np.array([y[0], 0.2]), (not mode[0], mode[1] + (0 if mode[0] else 1))

    def derivatives(_: float, y: Array, mode: tuple[bool, int]) -> list[float]:
        return [y[1], 0.6 - y[0] if mode[0] else 0.0]

    return integrate(derivatives, [0.0, 0.2], (False, 0), guards, switch, 25.0)


def stick_slip(t: Array) -> Values:
    y, modes = stick_slip_run()(t), stick_slip_run().modes(t)
    slipping, slips = (np.array([float(mode[k]) for mode in modes]) for k in (0, 1))
    return {"x": y[0], "v": y[1], "slipping": slipping, "slips": slips}


FIRST_STOP = (5 - np.sqrt(19)) / 3
BRAKE_EVENTS = (FIRST_STOP, 2 / 3 - FIRST_STOP, 5 / 3)
"""1 - 5t + 1.5t^2 = 0; then (t - t_1)*(1.5*(t + t_1) - 1) = 0; then the drive -3 + 3t reaches 2."""


def brake(t: Array) -> Values:
    """The velocity is a quadratic in each phase: forward, backward, stuck, forward."""
    t_1 = FIRST_STOP
    velocities = ((1.5, -5.0, 1.0), (1.5, -1.0, t_1 - 1.5 * t_1**2), (0.0,), (1.5, -5.0, 25 / 6))
    edges = (0.0, *BRAKE_EVENTS, np.inf)
    s = np.zeros_like(t)
    for k, velocity in enumerate(velocities):
        position = np.polyint(np.array(velocity))
        s += np.polyval(position, np.clip(t, edges[k], edges[k + 1])) - np.polyval(position, edges[k])
    phase = np.searchsorted(BRAKE_EVENTS, t, side="right")
    return {
        "v": np.choose(phase, [np.polyval(velocity, t) for velocity in velocities]),
        "s": s,
        "mode": np.array([1.0, -1.0, 0.0, 1.0])[phase],
    }


CASES = (
    Case("Friction.StickSlip", 25.0, stick_slip, events=lambda _: stick_slip_run().events),
    Case("Friction.Brake", 3.0, brake, events=at(*BRAKE_EVENTS)),
)
