"""Oracles of Homotopy.mo."""

from __future__ import annotations

import numpy as np

from ..case import Array, Case, Values

_GAIN = 1000.0
_SWITCH = 0.5 - 1.0 / _GAIN
"""Voltage of the capacitor at which the amplifier leaves its upper limit."""


def chosen_case(side: float) -> Case:
    def expected(t: Array) -> Values:
        z = np.sign(side) * (1 + t)
        return {"z": z, "twice": 2 * z, "late": t, "x": side + 2 * side * t}

    return Case("Homotopy.Chosen", 2.0, expected, parameters={"side": side}, label=f"{side}")


def nested_case(side: float) -> Case:
    parameters = {"side": side}
    return Case(
        "Homotopy.Nested",
        1.0,
        lambda t: {"z": np.sign(side) * (1 + t)},
        parameters=parameters,
        label=f"{side}",
    )


def switches(stop: float) -> Array:
    """The capacitor approaches the present limit, 1 in size, with a time constant of 1."""
    times = np.log(1 / (1 - _SWITCH)) + np.arange(100) * np.log((1 + _SWITCH) / (1 - _SWITCH))
    return times[times <= stop]


def multivibrator_case(first: float) -> Case:
    def expected(t: Array) -> Values:
        passed = np.searchsorted(switches(t[-1]), t, side="right")
        before = np.concatenate(([0.0], switches(t[-1])))[passed]
        v = np.where(passed % 2 == 0, 1.0, -1.0)
        start = np.where(passed == 0, 0.0, -v * _SWITCH)
        w = v - (v - start) * np.exp(-(t - before))
        return {"v": first * v, "w": first * w}

    parameters = {"first": first}
    return Case(
        "Homotopy.Multivibrator", 5.0, expected, parameters=parameters, events=switches, label=f"{first}"
    )


CASES = (
    chosen_case(2.0),
    chosen_case(-3.0),
    nested_case(2.0),
    nested_case(-2.0),
    Case("Homotopy.DeadEnd", 1.0, lambda t: {"z": 1 + t}),
    multivibrator_case(1.0),
    multivibrator_case(-1.0),
)
