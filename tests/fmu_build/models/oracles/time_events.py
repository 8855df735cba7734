"""Oracles of TimeEvents.mo."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from scipy.special import sici

from ..case import Array, Case, Values
from .state_events import at, count, latest


def ramps(t: Array, corners: Any, slopes: Any) -> Array:
    """A piecewise-linear function from 0: `slopes[k]` up to `corners[k]`, and the last one from there on."""
    edges = np.concatenate([[0.0], corners, [np.inf]])
    return sum(
        (slope * (np.clip(t, edges[k], edges[k + 1]) - edges[k]) for k, slope in enumerate(slopes)),
        start=np.zeros_like(t),
    )


def steps_case(t_1: float, duration: float, label: str) -> Case:
    when = (2 * t_1 - 0.1, 1.5)

    def expected(t: Array) -> Values:
        counts = np.searchsorted(sorted(when), t, side="right")
        added = [1.0, 10.0] if when[0] < when[1] else [10.0, 1.0]
        return {
            "x": ramps(t, [t_1, t_1 + duration], [1, -2, 3]),
            "y": ramps(t, [t_1], [0, 1]),
            "t_when": latest(t, np.array(sorted(when)), 0.0),
            "n": np.concatenate([[0.0], np.cumsum(added)])[counts],
        }

    parameters = {"t_1": t_1, "duration": duration}
    events = at(t_1, t_1 + duration, *when)
    return Case("TimeEvents.Steps", 2.0, expected, events=events, parameters=parameters, label=label)


SCHEDULED = np.array([0.1, 0.3, 0.7, 1.5, 3.1])


def self_scheduling(t: Array) -> Values:
    n = count(t, SCHEDULED)
    t_next = np.concatenate([SCHEDULED, [6.3]])[n.astype(int)]
    return {"n": n, "t_next": t_next, "x": ramps(t, SCHEDULED, range(6))}


def neighbours(t: Array) -> Values:
    ticks = 0.1 + 0.05 * np.arange(40)
    n = count(t, ticks)
    return {"n": n, "since": np.mod(t, 0.25), "x": ramps(t, ticks, range(41))}


def ramp_case(t_start: float, duration: float, label: str) -> Case:
    def expected(t: Array) -> Values:
        since = np.clip(t - t_start, 0, duration)
        after = np.maximum(t - t_start - duration, 0)
        return {"y": 2 * since / duration, "z": since**2 / duration + 2 * after}

    parameters = {"t_start": t_start, "duration": duration}
    events = at(t_start, t_start + duration)
    return Case("TimeEvents.Ramp", 1.5, expected, events=events, parameters=parameters, label=label)


def initial_when(t: Array) -> Values:
    return {"held": np.where(t < 1, 3.0, 6.0), "x": ramps(t, [1.0], [3, 6])}


def stepped_branches(t: Array) -> Values:
    """ceil(-time - 1) is -1 up to one second and -2 up to two."""
    late = t > 0.5
    return {
        "up": np.where(late, -np.floor(t + 1.0), 1.0),
        "down": np.where(t > 1.0, 4.0, 1.0),
        "n": np.where(late, 2.0, 0.0),
        "x": 2.0 * np.maximum(t - 0.5, 0.0),
    }


def level(t: Array) -> Values:
    return {"level": np.where(t < 0.5, 1.0, 9.0), "x": ramps(t, [0.5], [1, 9])}


def pulses(t: Array, period: float, origin: float, start: float = 0.0) -> Values:
    """Pulses of two fifths of a period, where v begins at `start`."""
    number = np.floor((t - origin) / period)
    since = origin + number * period

    def on_until(time: Array) -> Array:
        whole, part = np.divmod(time - origin, period)
        return 0.4 * period * whole + np.minimum(part, 0.4 * period)

    return {
        "number": number,
        "since": since,
        "y": np.where(t < since + 0.4 * period, 1.0, 0.0),
        "v": on_until(t) - on_until(np.array([start])),
    }


def pulse_events(period: float, origin: float) -> Callable[[float], Array]:
    """Where pulses begin and end."""
    begins = origin + period * np.arange(1000)
    both = np.sort(np.concatenate([begins, begins + 0.4 * period]))
    return lambda stop: both[(both >= 0) & (both <= stop)]


def pulse_case(period: float, origin: float, label: str) -> Case:
    return Case(
        "TimeEvents.PulseTrain",
        2.0,
        partial(pulses, period=period, origin=origin),
        events=pulse_events(period, origin),
        parameters={"period": period, "origin": origin},
        label=label,
    )


def sinc_case(begin: float, label: str) -> Case:
    def expected(t: Array) -> Values:
        x = 10 * (t - begin)
        return {"y": np.where(t < begin, 0.0, np.sinc(x / np.pi)), "z": sici(np.maximum(x, 0.0))[0] / 10}

    events = at(begin) if begin > 0 else at()
    return Case("TimeEvents.Sinc", 2.0, expected, events=events, parameters={"t_begin": begin}, label=label)


CASES = (
    steps_case(0.5, 0.25, "default"),
    steps_case(0.65, 0.4, "other times"),
    steps_case(0.9, 0.3, "other order"),
    Case("TimeEvents.SelfScheduling", 4.0, self_scheduling, events=at(*SCHEDULED)),
    Case("TimeEvents.Neighbours", 1.0, neighbours, events=at(*(0.05 * np.arange(2, 21)))),
    ramp_case(0.3, 0.4, "default"),
    ramp_case(0.55, 0.7, "other times"),
    Case("TimeEvents.InitialWhen", 2.0, initial_when, events=at(1.0)),
    Case("TimeEvents.Level", 1.0, level, events=at(0.5)),
    Case("TimeEvents.SteppedBranches", 1.8, stepped_branches, events=at(0.5, 1.0)),
    pulse_case(0.3, -1.0, "default"),
    pulse_case(0.37, -20.05, "begun long ago"),
    sinc_case(0.0, "from the start"),
    sinc_case(0.1, "default"),
    sinc_case(0.37, "later"),
)
