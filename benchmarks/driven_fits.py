"""Fits of records with a measured torque: do 95 % intervals hold, and which excitation identifies what?

    python -m benchmarks.driven_fits                # 30 sets
    python -m benchmarks.driven_fits --excitations  # standard errors by excitation

A hand pushes the joystick to one side, then to and fro. Torque and angle are sampled at 1 kHz; the angle has
0.02 degree of noise and lags 4 ms behind the torque.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections import defaultdict
from collections.abc import Mapping
from typing import Final

import numpy as np

from benchmarks.disturbed_motion import Disturbance, disturbed_motion
from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    Fit,
    FitSettings,
    Free,
    Measurement,
    Search,
    Uncertainty,
    driven,
    fit,
)
from pyjoystick.model import NOMINAL, contact_moment, gravity_moment
from pyjoystick.support import FloatArray, TextTable

RATE: Final = 1000.0
DURATION: Final = 4.0
NOISE: Final = math.radians(0.02)
DELAY: Final = 0.004
#: The record begins at rest at this angle (rad), where the torque balances springs and gravity.
START: Final = math.radians(6.0)
HOLD: Final = float(contact_moment(NOMINAL, START) - gravity_moment(NOMINAL, START))
_SETTINGS: Final = dataclasses.replace(driven(CONSTANT_DAMPING), uncertainty=Uncertainty(profiles=()))
_TIME: Final = np.arange(int(DURATION * RATE) + 1) / RATE


def strokes(period: float, size: float, random: np.random.Generator, rise: float = 0.08) -> FloatArray:
    """Pushes in alternating directions of about `size` (N m), each for `period`/2 (s), within `rise` (s)."""
    torque = np.full(len(_TIME), HOLD)
    level, at, sign = HOLD, 0.25, -1.0
    while at < DURATION:
        after = sign * size * random.uniform(0.95, 1.05)
        part = np.clip((_TIME - at) / rise, 0.0, 1.0)
        torque += (after - level) * part * part * (3.0 - 2.0 * part)
        level, sign = after, -sign
        at += 0.5 * period * random.uniform(0.9, 1.1)
    return torque


def record(
    torque: FloatArray,
    random: np.random.Generator,
    name: str = "hand",
    disturbance: Disturbance | None = None,
) -> Measurement:
    """Return the instruments' record of a motion driven by a torque (N m), shape (4001,)."""
    motion = disturbed_motion(
        NOMINAL, disturbance or Disturbance(), time=_TIME, theta_start=START, torque=torque
    )
    late = np.interp(_TIME - DELAY, _TIME, motion)
    return Measurement(name, _TIME, {"theta": late + NOISE * random.standard_normal(len(_TIME)), "T": torque})


#: Period (s), size (N m) and rise (s) of the pushes.
EXCITATIONS: Final[Mapping[str, tuple[float, float, float]]] = {
    "slow strokes, 2 s": (2.0, 1.6, 0.5),
    "strokes, 1 s": (1.0, 1.6, 0.08),
    "fast strokes, 0.4 s": (0.4, 1.6, 0.04),
    "hard strokes, 1 s": (1.0, 2.2, 0.08),
}
_WIDER: Final = ("forward.returnSpring.F_0", "backward.returnSpring.F_0", "forward.returnSpring.k_s")


def main() -> None:
    """Print the requested table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--excitations", action="store_true")
    options = parser.parse_args()
    print(
        excitation_table(options.seed) if options.excitations else coverage_table(options.sets, options.seed)
    )


def coverage_table(sets: int, seed: int) -> str:
    """Return how often each interval contains the truth."""
    known = {"damping.C": NOMINAL.to_names()["damping.C"], "J": NOMINAL.J, "delay": DELAY}
    z: dict[str, list[float]] = defaultdict(list)
    holds: dict[str, list[bool]] = defaultdict(list)
    trusted = 0
    with Fmu(_SETTINGS.fmu) as fmu:
        for number in range(sets):
            random = np.random.default_rng([seed, number])
            found = fit([record(strokes(1.0, 1.6, random), random)], _SETTINGS, fmu=fmu)
            trusted += found.trusted
            for name, value in known.items():
                z[name].append((found.value(name) - value) / found.error(name))
                low, high = found.interval(name)
                holds[name].append(low <= value <= high)
    rows = [
        [name, f"{100.0 * np.mean(holds[name]):.0f} %", f"{np.mean(z[name]):+.2f}", f"{np.std(z[name]):.2f}"]
        for name in known
    ]
    header = ["parameter", "interval holds", "mean of z", "deviation of z"]
    return f"{sets} sets, {trusted} passed every check\n\n{TextTable(header, rows).markdown()}"


def excitation_errors(seed: int = 1) -> dict[str, dict[str, float]]:
    """Relative standard errors of J, C, springs (and of the delay in ms) by excitation, then by parameter."""
    truth = NOMINAL.to_names() | {"delay": DELAY}
    free = (*_SETTINGS.free, *(Free(name) for name in _WIDER))
    settings: FitSettings = dataclasses.replace(
        _SETTINGS,
        # The errors are evaluated at the truth: weak excitation makes so many parameters hard to find.
        free=tuple(dataclasses.replace(one, start=truth.get(one.name, one.start)) for one in free),
        search=Search(stages=()),
    )
    found: dict[str, dict[str, float]] = {}
    with Fmu(settings.fmu) as fmu:
        for name, (period, size, rise) in EXCITATIONS.items():
            random = np.random.default_rng([seed, 0])
            found[name] = _relative(
                fit([record(strokes(period, size, random, rise), random)], settings, fmu=fmu)
            )
    return found


def _relative(found: Fit) -> dict[str, float]:
    names = ("J", "damping.C", *_WIDER)
    return {name: found.error(name) / abs(found.value(name)) for name in names} | {
        "delay": 1e3 * found.error("delay")
    }


def excitation_table(seed: int) -> str:
    """The standard errors by excitation as Markdown."""
    errors = excitation_errors(seed)
    names = list(next(iter(errors.values())))
    rows = [
        [name, *(f"{100.0 * own[one]:.2g} %" if one != "delay" else f"{own[one]:.2g} ms" for one in names)]
        for name, own in errors.items()
    ]
    return TextTable(["excitation", *names], rows).markdown()


if __name__ == "__main__":
    main()
