"""Oracles of StateEvents.mo."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..case import Array, Case, Values


def at(*times: float) -> Callable[[float], Array]:
    """Event times that are known as numbers."""
    return lambda stop: np.array([time for time in times if time <= stop])


def count(times: Array, events: Array) -> Array:
    """How many of the events have happened at each time."""
    return np.searchsorted(np.sort(events), times, side="right").astype(float)


def latest(times: Array, events: Array, before: float) -> Array:
    """Time of the latest event, and `before` until the first."""
    return np.concatenate([[before], events])[np.searchsorted(events, times, side="right")]


def bounce_times(height: float, gravity: float, e: float, stop: float) -> Array:
    fall = np.sqrt(2 * height / gravity)
    times = [fall]
    while times[-1] <= stop:
        times.append(times[-1] + 2 * fall * e ** len(times))
    return np.array(times[:-1])


def bouncing(times: Array, height: float, gravity: float, e: float) -> tuple[Array, Array]:
    """Height and velocity of a ball dropped at time 0."""
    bounces = bounce_times(height, gravity, e, float(times.max()))
    k = np.searchsorted(bounces, times, side="right")
    impact = np.sqrt(2 * gravity * height)
    since = times - np.concatenate([[0.0], bounces])[k]
    launch = np.where(k == 0, 0.0, impact * e**k)
    return np.where(k == 0, height, 0.0) + launch * since - gravity * since**2 / 2, launch - gravity * since


def bouncing_ball(e: float) -> Case:
    def expected(t: Array) -> Values:
        bounces = bounce_times(1.0, 9.81, e, float(t.max()))
        h, v = bouncing(t, 1.0, 9.81, e)
        return {"h": h, "v": v, "bounces": count(t, bounces), "t_bounce": latest(t, bounces, 0.0)}

    def events(stop: float) -> Array:
        return bounce_times(1.0, 9.81, e, stop)

    return Case("StateEvents.BouncingBall", 2.0, expected, events=events, parameters={"e": e}, label=f"e={e}")


def planar_bounce(t: Array) -> Values:
    bounces = bounce_times(2.0, 10.0, 0.8, float(t.max()))
    y, vy = bouncing(t, 2.0, 10.0, 0.8)
    vx = 3 * 0.5 ** count(t, bounces)
    starts = np.concatenate([[0.0], bounces])
    x_at = np.concatenate([[0.0], np.cumsum(np.diff(starts) * 3 * 0.5 ** np.arange(len(bounces)))])
    k = np.searchsorted(bounces, t, side="right")
    return {"x": x_at[k] + vx * (t - starts[k]), "y": y, "vx": vx, "vy": vy}


def relay_switches(stop: float) -> Array:
    """Between the switches x rises as 1 - (1 - x0)*exp(-t) to 0.6 and falls as x0*exp(-t) to 0.4."""
    times = [-np.log(1 - 0.6)]
    while times[-1] <= stop:
        times.append(times[-1] + np.log(0.6 / 0.4))
    return np.array(times[:-1])


def relay(t: Array) -> Values:
    switches = relay_switches(float(t.max()))
    k = np.searchsorted(switches, t, side="right")
    since = t - np.concatenate([[0.0], switches])[k]
    on = k % 2 == 0
    rising = 1 - (1 - np.where(k == 0, 0.0, 0.4)) * np.exp(-since)
    return {
        "x": np.where(on, rising, 0.6 * np.exp(-since)),
        "on": on.astype(float),
        "switches": k.astype(float),
    }


def limiter_events(stop: float) -> Array:
    angle = np.arcsin(0.5)
    times = np.concatenate([np.arange(40) * np.pi + angle, np.arange(1, 40) * np.pi - angle])
    return np.sort(times[times <= stop])


def limiter(t: Array) -> Values:
    """In a half period the integral is 2*(1 - cos(a)) + level*(pi - 2*a), with the sign of the sine."""
    level, a = 0.5, np.arcsin(0.5)
    half = 2 * (1 - np.cos(a)) + level * (np.pi - 2 * a)
    n, s = np.divmod(t, np.pi)
    rise = 1 - np.cos(np.minimum(s, a))
    flat = level * np.clip(s - a, 0, np.pi - 2 * a)
    fall = np.where(s > np.pi - a, np.cos(a) - np.cos(np.pi - np.maximum(s, np.pi - a)), 0.0)
    part = rise + flat - fall
    whole = np.where(n % 2 == 0, 0.0, half)
    return {"y": np.clip(np.sin(t), -level, level), "z": whole + np.where(n % 2 == 0, part, -part)}


def grazing_events(stop: float) -> Array:
    half = np.arccos(0.995)
    middles = np.pi / 2 + 2 * np.pi * np.arange(20)
    times = np.concatenate([middles - half, middles + half])
    return np.sort(times[times <= stop])


def grazing(t: Array) -> Values:
    half = np.arccos(0.995)
    rises = np.pi / 2 - half + 2 * np.pi * np.arange(20)
    return {
        "x": np.sin(t),
        "above_one": np.zeros_like(t),
        "misses": np.zeros_like(t),
        "above_most": (np.sin(t) > 0.995).astype(float),
        "hits": count(t, rises),
    }


def simultaneous(t: Array) -> Values:
    after = (t > 0.5).astype(float)
    z = np.where(t < 0.5, 0.0, 1e-7 + 2 * (t - 0.5000001))
    return {"x": t, "y": 2 * t, "a": after, "b": after, "both": after, "z": z}


def event_chain(t: Array) -> Values:
    after = (t > 0.3).astype(float)
    return {
        "first": after,
        "second": 10 * after,
        "third": 100 * after,
        "t_third": np.where(t > 0.3, 0.3, -1.0),
    }


def when_priority(t: Array) -> Values:
    steps = np.searchsorted([0.2, 0.4, 0.6, 0.8], t, side="right")
    return {"k": np.array([0.0, 1, 2, 12, 22])[steps], "n": np.array([0.0, 1, 2, 3, 4])[steps]}


def edge_and_change(t: Array) -> Values:
    """The motion is x = sin(phase), v = cos(phase) and starts in the first quadrant."""
    phase = t + np.arcsin(0.6)
    quarters = np.floor(phase / (np.pi / 2))
    return {
        "x": np.sin(phase),
        "positive": (np.sin(phase) > 0).astype(float),
        "quadrant": quarters % 4 + 1,
        "rising": np.floor(phase / (2 * np.pi)),
        "falling": np.floor((phase + np.pi) / (2 * np.pi)),
        "turns": quarters,
    }


def quarter_turns(stop: float) -> Array:
    times = np.arange(1, 60) * np.pi / 2 - np.arcsin(0.6)
    return np.asarray(times[times <= stop])


def thresholds(t: Array) -> Values:
    above = [(t > 0.2 * i).astype(float) for i in (1, 2, 3)]
    values = {f"above[{i + 1}]": above[i] for i in range(3)}
    values |= {f"level[{i + 1}]": (i + 1) * above[i] for i in range(3)}
    return values | {"z": sum((i * np.maximum(t - 0.2 * i, 0) for i in (1, 2, 3)), start=np.zeros_like(t))}


def starts_on_root(t: Array) -> Values:
    return {"x": t, "z": 2 * t, "positive": np.ones_like(t), "rises": np.ones_like(t)}


def shared_thresholds(t: Array) -> Values:
    late = np.maximum(t - 0.5, 0)
    return {"y": 3 * t, "z": 7 * late, "past[1]": t > 0.5, "past[2]": t > 0.5}


def sign_of(t: Array) -> Values:
    late = (t > 1).astype(float)
    return {"sign_of": 1 - 2 * late, "changes": 2 * late, "between": late}


def latch(t: Array) -> Values:
    """At the start both gates could be open; the first one is, until it is reset."""
    reset = (t > 0.7).astype(float)
    return {"q": 1 - reset, "q_bar": reset, "changes": reset, "z": np.minimum(t, 0.7)}


def after_initial(t: Array) -> Values:
    return {"k": np.full_like(t, 7), "n": np.ones_like(t), "m": 1.0 + (t > 0.5)}


def cosine_crossings(stop: float) -> Array:
    """Where cos(t) = 0.5."""
    times = np.concatenate([np.pi / 3 + 2 * np.pi * np.arange(10), -np.pi / 3 + 2 * np.pi * np.arange(1, 10)])
    return np.sort(times[times <= stop])


def true_at_start(t: Array) -> Values:
    return {"x": np.cos(t), "n": np.floor((t + np.pi / 3) / (2 * np.pi))}


def reinit_chain(t: Array) -> Values:
    """At 0.5: y = 1, then x = 10."""
    late = t > 0.5
    return {"x": np.where(late, 9.5, 0.0) + t, "y": np.where(late, 0.5, 0.0) + t}


def integer_signal(t: Array) -> Array:
    return 3 * np.sin(t) + 0.1


def integer_events_times(stop: float) -> Array:
    """U = 3*sin(t) + 0.1 passes every integer and every multiple of 0.7."""
    levels = np.concatenate([np.arange(-2, 4), 0.7 * np.arange(-4, 5)])
    angles = np.arcsin((levels - 0.1) / 3)
    times = np.concatenate([angles, np.pi - angles, angles + 2 * np.pi, 3 * np.pi - angles])
    return np.unique(times[(times > 0) & (times <= stop)])


def integer_events(t: Array) -> Values:
    u = integer_signal(t)
    edges = np.concatenate([[0.0], integer_events_times(float(t.max())), [float(t.max())]])
    middles = integer_signal((edges[1:] + edges[:-1]) / 2)
    k = np.clip(np.searchsorted(edges, t, side="right") - 1, 0, len(middles) - 1)

    def integral(levels: Array) -> Array:
        areas = np.concatenate([[0.0], np.cumsum(np.diff(edges) * levels)])
        return areas[k] + levels[k] * (t - edges[k])

    return {
        "f": np.floor(u),
        "c": np.ceil(u),
        "m": u - np.floor(u / 0.7) * 0.7,
        "r": u - np.trunc(u / 0.7) * 0.7,
        "d": np.trunc(u / 0.7),
        "i": np.floor(u),
        "z": integral(np.floor(middles)),
        "w": integral(np.trunc(middles / 0.7)),
    }


def exact_steps(t: Array) -> Values:
    u = 3.0 - t
    return {"d": np.trunc(u), "r": u - np.trunc(u)}


def steps_in_relations(t: Array) -> Values:
    late = np.maximum(t - 0.25, 0)
    return {
        "y": t + late,
        "z": t + late,
        "w": np.clip(t - 0.5, 0, 0.25),
        "n": (t > 2 / 3).astype(float),
    }


_PULSES = (0.3, 0.7, 1.1, 1.5)


def relations_in_relations(t: Array) -> Values:
    after = t[:, np.newaxis] - np.array(_PULSES)
    return {
        "y": np.clip(after, 0, 0.001).sum(axis=1),
        "n": (after > 0).sum(axis=1).astype(float),
        "k": (t > 0.9) + 10.0 * (t > 1.2),
        "m": (t > 0.5).astype(float),
    }


def relations_in_relations_times(stop: float) -> Array:
    times = [*_PULSES, *(time + 0.001 for time in _PULSES), 0.4, 0.5, 0.9, 0.901, 1.2, 1.201]
    return at(*times)(stop)


def shared_zero(t: Array) -> Values:
    late = (t > 0.5).astype(float)
    return {"first": 2 + late, "second": 3 * late}


def passing_condition(t: Array) -> Values:
    return {"n": (t > 0.5).astype(float), "zeros": np.zeros_like(t)}


def stays_at_zero(t: Array) -> Values:
    begin, end = np.pi / 18, 5 * np.pi / 18
    return {"w": np.clip(t, begin, end) - begin, "n": (t > begin).astype(float)}


def breaks_away(force: float) -> Case:
    begin = np.arcsin(1 / force) / 5

    def expected(t: Array) -> Values:
        t = np.maximum(t, begin)
        return {"v": (force / 5 * (np.cos(5 * begin) - np.cos(5 * t)) - (t - begin)) / 3.4}

    return Case(
        "StateEvents.BreaksAway",
        0.4,  # before the force falls below 1
        expected,
        events=at(begin),
        parameters={"F": force},
        label=f"{force}",
    )


def no_events_model(t: Array) -> Values:
    x = t - 1
    kinked, shifted = np.maximum(x, 0), np.maximum(x - 0.5, 0)
    return {"kinked": kinked, "smoothed": shifted**2, "z": kinked**2 / 2 + shifted**3 / 3}


CASES = (
    bouncing_ball(0.7),
    bouncing_ball(0.8),
    Case(
        "StateEvents.PlanarBounce", 3.0, planar_bounce, events=lambda stop: bounce_times(2.0, 10.0, 0.8, stop)
    ),
    Case("StateEvents.Relay", 3.0, relay, events=relay_switches),
    Case("StateEvents.Limiter", 10.0, limiter, events=limiter_events),
    Case("StateEvents.Grazing", 15.0, grazing, events=grazing_events),
    Case("StateEvents.Simultaneous", 1.0, simultaneous, events=at(0.5, 0.5000001)),
    Case("StateEvents.EventChain", 1.0, event_chain, events=at(0.3)),
    Case("StateEvents.WhenPriority", 1.0, when_priority, events=at(0.2, 0.4, 0.6, 0.8)),
    Case("StateEvents.EdgeAndChange", 20.0, edge_and_change, events=quarter_turns),
    Case("StateEvents.Thresholds", 1.0, thresholds, events=at(0.2, 0.4, 0.6)),
    Case("StateEvents.StartsOnRoot", 1.0, starts_on_root, events=at(0.0)),
    Case("StateEvents.SharedThresholds", 1.0, shared_thresholds, events=at(0.5)),
    Case("StateEvents.SignOf", 2.0, sign_of, events=at(1.0)),
    Case("StateEvents.Latch", 1.0, latch, events=at(0.7)),
    Case("StateEvents.AfterInitial", 1.0, after_initial, events=at(0.5)),
    Case("StateEvents.TrueAtStart", 15.0, true_at_start, events=cosine_crossings),
    Case("StateEvents.ReinitChain", 1.0, reinit_chain, events=at(0.5)),
    Case("StateEvents.ExactSteps", 6.0, exact_steps, events=at(0.0, 1.0, 2.0, 4.0, 5.0, 6.0)),
    Case("StateEvents.StepsInRelations", 1.0, steps_in_relations, events=at(0.25, 0.5, 2 / 3, 0.75, 1.0)),
    Case(
        "StateEvents.RelationsInRelations", 1.7, relations_in_relations, events=relations_in_relations_times
    ),
    Case("StateEvents.SharedZero", 1.0, shared_zero, events=at(0.5)),
    Case("StateEvents.PassingCondition", 1.0, passing_condition, events=at(0.5)),
    Case("StateEvents.StaysAtZero", 1.0, stays_at_zero, events=at(np.pi / 18, 5 * np.pi / 18)),
    *(breaks_away(force) for force in (1.3, 1.6, 2.0, 2.3)),
    Case("StateEvents.IntegerEvents", 8.0, integer_events, events=integer_events_times),
    Case("StateEvents.NoEvents", 3.0, no_events_model),
)
