"""Oracles of Sampling.mo."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..case import Array, Case, Values
from .state_events import at, count, latest
from .time_events import ramps


def ticks(first: float, period: float) -> Callable[[float], Array]:
    def times(stop: float) -> Array:
        return first + period * np.arange(int((stop - first) / period + 1e-9) + 1, dtype=np.float64)

    return times


def counter(t: Array) -> Values:
    n = np.floor(t / 0.125) + 1
    return {"k": 2 * n, "odd": n % 2, "y": n}


def sampled_pi(t: Array) -> Values:
    """Between ticks x goes to u as exp(-t); the controller is iterated tick by tick."""
    times = np.concatenate([[0.0], ticks(0.1, 0.1)(float(t.max()))])
    table = [(0.0, 0.0, 0.0, 0.0)]
    for span in np.diff(times):
        x, _, s, u = table[-1]
        x = u + (x - u) * np.exp(-span)
        e = 1 - x
        table.append((x, e, s + e, 2 * e + 0.5 * (s + e)))
    x, e, s, u = np.array(table)[np.searchsorted(times, t, side="right") - 1].T
    since = t - latest(t, times, 0.0)
    return {"x": u + (x - u) * np.exp(-since), "e": e, "s": s, "u": u}


def two_rates(t: Array) -> Values:
    fast, slow = count(t, ticks(0.1, 0.1)(3.0)), count(t, ticks(0.2, 0.2)(3.0))
    times = ticks(0.1, 0.1)(3.0)
    n = np.arange(len(times) + 1)
    return {
        "fast": fast,
        "slow": slow,
        "seen": 2 * slow,
        "delayed": np.maximum(2 * slow - 1, 0),
        "x": ramps(t, times, n - n // 2),
    }


def pulse_events(stop: float) -> Array:
    starts = ticks(0.05, 0.1)(stop)
    return np.sort(np.concatenate([starts, starts + 0.03]))


def pulse_train(t: Array) -> Values:
    starts = ticks(0.05, 0.1)(float(t.max()))
    since = t[:, np.newaxis] - starts
    high = ((since >= 0) & (since < 0.03)).any(axis=1)
    return {"y": 2.0 * high, "high": high.astype(float), "z": 2 * np.clip(since, 0, 0.03).sum(axis=1)}


def held_sine(t: Array) -> Values:
    n = np.floor(t / 0.25)
    sums = np.concatenate([[0.0], np.cumsum(np.sin(0.25 * np.arange(200)))]) * 0.25
    held = np.sin(0.25 * n)
    return {
        "x": np.sin(t),
        "held": held,
        "previous": np.sin(0.25 * np.maximum(n - 1, 0)),
        "z": sums[n.astype(int)] + held * (t - 0.25 * n),
    }


def sampled_reset(t: Array) -> Values:
    """Just after tick n, x_n = (x_(n-1) + 0.25)/2, that is 0.25*(1 - 2^-n)."""
    n = np.floor(t / 0.25)
    return {"x": 0.25 * (1 - 0.5**n) + t - 0.25 * n}


SAMPLES_AND_CROSSING = (0.1, 0.3, 0.45, 0.5, 0.7, 0.9)


def sample_or_state(t: Array) -> Values:
    times = np.array(SAMPLES_AND_CROSSING)
    return {"n": count(t, times), "t_last": latest(t, times, 0.0)}


def threshold_events(stop: float) -> Array:
    return np.sort(
        np.concatenate([ticks(0.25, 0.5)(stop), 0.7 + 0.4 * np.arange(int((stop - 0.7) / 0.4) + 1)])
    )


def sampled_threshold(t: Array) -> Values:
    """The threshold is 0.3 + 0.4*k after k ticks; x = t is above it from 0.7 + 0.4*j to tick j + 2."""
    raised = count(t, ticks(0.25, 0.5)(float(t.max())))
    d = 0.3 + 0.4 * raised
    j = np.arange(5)
    inside = np.clip(t[:, np.newaxis] - (0.7 + 0.4 * j), 0, 0.05 + 0.1 * j)
    above = t > d
    return {
        "z": inside.sum(axis=1),
        "d": d,
        "late": (raised > 0) & (0.25 + 0.5 * (raised - 1) > d - 0.5),
        "above": above,
        "level": 1.0 + above,
        "n": count(t, 0.7 + 0.4 * j),
        "any": t > 0.7,
    }


def guarded(t: Array) -> Values:
    n = count(t, np.array([0.5, 0.7, 0.9, 1.1, 1.3]))
    return {"n": n, "changes": n, "t_third": np.where(t > 0.9, 0.9, -1.0)}


def sampled_algorithm(t: Array) -> Values:
    n = np.floor(t / 0.1 + 1e-9)
    return {"n": n, "k": 2 * n + np.where(n >= 4, 100.0, 0.0), "t_n": 0.1 * n}


GRAPH_EVENTS = (1.0, 1.5, 2.5, 3.0, 4.0, 4.5)


def step_graph(t: Array) -> Values:
    """A second in the one step, half a second in the other."""
    inside = t % 1.5
    first = inside < 1
    return {
        "a.active": first,
        "b.active": ~first,
        "ab.t": np.where(first, inside, 0),
        "ba.t": np.where(first, 0, inside - 1),
        "x": np.floor(t / 1.5) + np.minimum(inside, 1),
    }


def initial_previous(k: float, x: float) -> Case:
    def expected(t: Array) -> Values:
        late = x + t > 3.5
        return {"d": k * x + 1 + 3.5 * late, "e": k / 2 + late}

    parameters = {"k": k, "x": x}
    events = at(3.5 - x)
    return Case(
        "Sampling.InitialPrevious", 1.0, expected, events=events, parameters=parameters, label=f"{k}, {x}"
    )


def mean_from_start(t: Array, start: float = 0.0) -> Values:
    """A ramp has its mean in the middle of each half second."""
    done = np.floor((t - start) / 0.5 + 1e-9)
    since = start + 0.5 * done
    return {"mean": np.where(done > 0, since - 0.25, 0.0), "x": 0.5 * (t**2 - since**2)}


def left_limits(t: Array) -> Values:
    """At each tick, the values just before it; n jumps by one there, the level after half a second."""
    tick = 0.25 * np.floor(4 * t + 1e-9)
    ticked, y = tick > 0, 2 * np.exp(-tick)
    before = [y, np.sin(tick), y, np.ones_like(t), np.where(tick > 0.6, 1.0, 3.0)]
    rows = {f"d[{k}]": np.where(ticked, row, 0.0) for k, row in enumerate(before, 1)}
    return rows | {"crossing": np.where(t > np.log(2 / 1.1), 1.1, 0.0)}


def left_limit_events(stop: float) -> Array:
    return np.append(ticks(0.25, 0.25)(stop), np.log(2 / 1.1))


MEAN_FROM_START = Case("Sampling.MeanFromStart", 2.2, mean_from_start, events=ticks(0.5, 0.5))
CASES = (
    Case("Sampling.Counter", 1.0, counter, events=ticks(0.0, 0.125)),
    Case("Sampling.SampledPI", 2.0, sampled_pi, events=ticks(0.1, 0.1)),
    Case("Sampling.TwoRates", 1.0, two_rates, events=ticks(0.1, 0.1)),
    Case("Sampling.PulseTrain", 1.0, pulse_train, events=pulse_events),
    Case("Sampling.SampledThreshold", 2.0, sampled_threshold, events=threshold_events),
    Case("Sampling.HeldSine", 5.0, held_sine, events=ticks(0.0, 0.25)),
    Case("Sampling.SampledReset", 2.0, sampled_reset, events=ticks(0.25, 0.25)),
    Case("Sampling.SampleOrState", 1.0, sample_or_state, events=at(*SAMPLES_AND_CROSSING)),
    Case("Sampling.Guarded", 1.4, guarded, events=ticks(0.1, 0.2)),
    Case("Sampling.StepGraph", 5.0, step_graph, events=at(*GRAPH_EVENTS)),
    initial_previous(2.0, 3.0),
    initial_previous(-3.0, 2.75),
    MEAN_FROM_START,
    Case("Sampling.LeftLimits", 1.2, left_limits, events=left_limit_events),
    Case("Sampling.SampledAlgorithm", 1.0, sampled_algorithm, events=ticks(0.1, 0.1)),
)
