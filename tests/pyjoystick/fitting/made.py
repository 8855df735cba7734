"""Records of known joysticks for the tests of fitting, made by the pure-Python reference."""

from __future__ import annotations

import math

import numpy as np

from pyjoystick.parameters import JoystickParameters
from pyjoystick.records import Record
from pyjoystick.synthetic_records import synthetic_record


def releases(
    joystick: JoystickParameters,
    count: int = 1,
    *,
    noise: float = 0.0,
    seed: int = 1,
    rate: float = 60.0,
    duration: float = 1.6,
) -> list[Record]:
    """Releases from about -20 degrees, each from another angle and at another instant between samples."""
    random = np.random.default_rng(seed)
    return [
        synthetic_record(
            joystick,
            release_angle=math.radians(-20.0 + 0.4 * number),
            random=random,
            name=f"run {number}",
            release_time=0.1 + 0.0037 * number,
            duration=duration,
            rate=rate,
            noise=noise,
        )
        for number in range(count)
    ]
