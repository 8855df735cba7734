"""Peaks of releases for the tests: from closed forms and the reference."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.model import JoystickParameters
from pyjoystick.motion import Quantity, ReleasePeaks, make_table, peaks_of_run
from pyjoystick.runs import reference_free_oscillation


def peak_table(time: ArrayLike, value: ArrayLike) -> pd.DataFrame:
    values = np.asarray(value, dtype=np.float64)
    return pd.DataFrame({"time": time, "value": values, "sign": np.sign(values).astype(int)})


def linear_release(
    inertia: float, damping: float, frequency: float, *, start: float = 2.0, name: str = "linear"
) -> ReleasePeaks:
    """A linear joystick released at -0.3 rad; `frequency` is that of the damped motion (rad/s)."""
    decay = damping / (2.0 * inertia)
    undamped = math.hypot(frequency, decay)
    turns = np.arange(1, 13) * math.pi / frequency
    # omega ~ exp(-decay t) sin(frequency t), whose derivative is zero where tan(frequency t) is this ratio.
    fastest = (np.arange(12) * math.pi + math.atan2(frequency, decay)) / frequency
    sides = np.where(np.arange(12) % 2 == 0, 1.0, -1.0)
    velocity = 0.3 * undamped**2 / frequency * np.exp(-decay * fastest) * np.sin(frequency * fastest)
    return ReleasePeaks(
        name=name,
        release_time=start,
        release_angle=-0.3,
        displacement=peak_table(start + turns, 0.3 * sides * np.exp(-decay * turns)),
        velocity=peak_table(start + fastest, velocity),
    )


def linear_run(inertia: float, damping: float, frequency: float, *, start: float = 0.0) -> pd.DataFrame:
    """The motion of `linear_release` at 1 kHz over 1.5 s: theta, omega and alpha over time."""
    decay = damping / (2.0 * inertia)
    square = frequency**2 + decay**2
    time = np.arange(1501) / 1e3
    envelope, sine, cosine = -0.3 * np.exp(-decay * time), np.sin(frequency * time), np.cos(frequency * time)
    theta = envelope * (cosine + decay / frequency * sine)
    omega = -envelope * square / frequency * sine
    columns = {"theta": theta, "omega": omega, "alpha": -2.0 * decay * omega - square * theta}
    return make_table(start + time, columns, [Quantity("theta", "rad"), Quantity("omega", "rad/s")])


@cache
def reference_release(parameters: JoystickParameters, release_angle: float) -> ReleasePeaks:
    run = reference_free_oscillation(release_angle, parameters=parameters, output_interval=1e-3)
    return peaks_of_run(run, name="reference")
