"""Random joysticks and release angles, the same in every run, for comparing models."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters

SPREAD = 0.2
LARGEST_RELEASE_ANGLE = math.radians(20.0)
SEED = 274


@dataclass(frozen=True)
class RandomCase:
    """One joystick and the angle (rad) at which it is released from rest."""

    name: str
    parameters: JoystickParameters
    theta_start: float


def random_cases(nominal: JoystickParameters, count: int = 25, seed: int = SEED) -> list[RandomCase]:
    """Cases 0 .. count-1: every parameter of `nominal` within 20 %, released between -20 and 20 degrees.

    A smaller count gives the first cases of a larger one.
    """
    random = np.random.default_rng(seed)
    law = "power law" if "damping.alpha" in nominal.to_names() else "constant"
    return [_random_case(f"{law} {i}", nominal, random) for i in range(count)]


def both_laws(count: int = 25) -> list[RandomCase]:
    """`count` cases of each damping law."""
    return random_cases(NOMINAL, count) + random_cases(NOMINAL_POWER_LAW, count, SEED + 1)


def _random_case(name: str, nominal: JoystickParameters, random: np.random.Generator) -> RandomCase:
    values = {
        key: value * random.uniform(1.0 - SPREAD, 1.0 + SPREAD) for key, value in nominal.to_names().items()
    }
    if "damping.alpha" in values:
        values["damping.alpha"] = min(1.0, values["damping.alpha"])
    theta_start = random.uniform(-LARGEST_RELEASE_ANGLE, LARGEST_RELEASE_ANGLE)
    return RandomCase(name, nominal.replace(values), theta_start)
