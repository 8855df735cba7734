"""Records of the synthetic swing test."""

from __future__ import annotations

import math

import numpy as np

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
