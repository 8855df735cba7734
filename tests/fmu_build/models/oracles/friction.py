"""Oracles of Friction.mo."""

from __future__ import annotations

from functools import cache

import numpy as np

from tests.hybrid import Trajectory, integrate

from ..case import Array, Case, Values
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


def sliding_case(v_start: float) -> Case:
    """Without a drive: the block stops at v_0/(mu g), here |v_0|."""

    def expected(t: Array) -> Values:
        v = np.maximum(abs(v_start) - t, 0)
        moving = (v > 0) * np.sign(v_start)
        return {"v": np.sign(v_start) * v, "s": np.sign(v_start) * (v_start**2 - v**2) / 2, "mode": moving}

    events = at(abs(v_start)) if v_start else at()
    return Case(
        "Friction.Block", 4.0, expected, events=events, parameters={"v_start": v_start}, label=f"{v_start}"
    )


def driven_case(v_start: float, ramp: float, amplitude: float, omega: float, label: str) -> Case:
    """With a drive that stops the block, holds it, tears it away, or turns it round."""

    def drive(t: float) -> float:
        return float(ramp * t + amplitude * np.sin(omega * t))

    def guards(t: float, y: Array, mode: int) -> list[float]:
        return [mode * y[1]] if mode else [1 - drive(t), 1 + drive(t)]

    def switch(t: float, y: Array, mode: int, k: int) -> tuple[Array, int]:
        if mode:
            return np.array([y[0], 0.0]), int(np.sign(drive(t))) if abs(drive(t)) > 1 else 0
        return y, (1, -1)[k]

    @cache
    def run() -> Trajectory:
        def derivatives(t: float, y: Array, mode: int) -> list[float]:
            return [y[1], drive(t) - mode if mode else 0.0]

        return integrate(derivatives, [0.0, v_start], int(np.sign(v_start)), guards, switch, 6.0)

    def expected(t: Array) -> Values:
        return {"s": run()(t)[0], "v": run()(t)[1], "mode": np.array(run().modes(t), dtype=float)}

    parameters = {"v_start": v_start, "ramp": ramp, "amplitude": amplitude, "omega": omega}
    return Case(
        "Friction.Block", 6.0, expected, events=lambda _: run().events, parameters=parameters, label=label
    )


CASES = (
    Case("Friction.StickSlip", 25.0, stick_slip, events=lambda _: stick_slip_run().events),
    Case("Friction.Brake", 3.0, brake, events=at(*BRAKE_EVENTS)),
    *map(sliding_case, (2.0, -2.0, 0.0)),
    driven_case(0.0, -0.5, 0.0, 1.0, "torn away backward"),
    driven_case(-1.0, 0.0, 1.5, 1.0, "slow drive"),
    driven_case(0.0, 0.0, 5.0, 3.0, "strong drive"),
    driven_case(0.5, 0.5, 0.0, 1.0, "stops and is torn away"),
)
