"""Records of the synthetic swing test."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from pyjoystick.laboratory import synthetic_swing
from pyjoystick.model import NOMINAL
from pyjoystick.motion import Record

WEIGHT = NOMINAL.m * NOMINAL.g * NOMINAL.h
DAMPING = 0.002


def swing(seed: int | None, *, offset: float = 0.0) -> Record:
    """The paper's joystick from 25 degrees, by the seed of its noise; None is without noise."""
    return synthetic_swing(
        NOMINAL,
        random=np.random.default_rng(seed),
        damping=DAMPING,
        offset=offset,
        noise=0.0 if seed is None else math.radians(0.05),
    )


def small_swing(
    *,
    amplitude: float,
    friction_angle: float,
    damping_ratio: float,
    rate: float = 60.0,
    duration: float = 20.0,
) -> Record:
    """A linear pendulum of Table 2 with both kinds of friction, in closed form, without noise.

    Each half swing is a damped oscillation about the angle of friction, on the side that it comes from.
    """
    natural = math.sqrt(WEIGHT / NOMINAL.J)
    damped, fall = natural * math.sqrt(1.0 - damping_ratio**2), natural * damping_ratio
    time = np.arange(0.0, duration, 1.0 / rate)
    theta = np.empty_like(time)
    turn, side = 0.0, 1.0
    while turn < duration:
        own = (time >= turn) & (time < turn + math.pi / damped)
        late = time[own] - turn
        about = max(amplitude - friction_angle, 0.0)
        shape = np.exp(-fall * late) * (np.cos(damped * late) + fall / damped * np.sin(damped * late))
        theta[own] = side * (min(amplitude, friction_angle) + about * shape)
        amplitude = about * math.exp(-fall * math.pi / damped) - min(amplitude, friction_angle)
        turn, side = turn + math.pi / damped, -side
    return Record("small swing", time, theta)


def rubbing_swing(
    friction: float,
    seed: int | None,
    *,
    damping: float = DAMPING,
    amplitude: float = math.radians(25.0),
    rate: float = 60.0,
    duration: float = 20.0,
) -> Record:
    """As `swing`, with dry friction (N m), half swing by half swing, until it sticks."""
    time = np.arange(0.0, duration, 1.0 / rate)
    theta = np.empty_like(time)
    now, angle, sign = 0.0, amplitude, -1.0

    def fall(_: float, state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
        moment = WEIGHT * math.sin(state[0]) + damping * state[1] + sign * friction
        return [state[1], -moment / NOMINAL.J]

    def turns(_: float, state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
        return float(sign * state[1] + 1e-12)

    turns.terminal, turns.direction = True, -1.0  # type: ignore[attr-defined]
    while now < time[-1] and WEIGHT * abs(math.sin(angle)) > friction:
        run = solve_ivp(
            fall, (now, 30.0), [angle, 0.0], events=turns, dense_output=True, rtol=1e-10, atol=1e-12
        )
        own = (time >= now) & (time <= run.t[-1])
        theta[own] = run.sol(time[own])[0]
        now, angle, sign = float(run.t[-1]), float(run.y[0, -1]), -sign
    theta[time > now] = angle
    if seed is not None:
        theta = theta + math.radians(0.05) * np.random.default_rng(seed).standard_normal(time.size)
    return Record("rubbing swing", time, theta)
