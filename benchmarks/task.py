"""The task of every contender: release from rest, 1.5 s, 901 samples; and the error of a result."""

from __future__ import annotations

import math
from functools import cache
from typing import Final, Literal

import numpy as np

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, simulate
from pyjoystick.support import FloatArray

Law = Literal["constant", "power-law"]
LAWS: Final[tuple[Law, ...]] = ("constant", "power-law")
MODELS: Final[dict[Law, str]] = {"constant": "Joystick", "power-law": "JoystickPowerLaw"}
PARAMETERS: Final = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}

#: Length of a run (s).
DURATION: Final = 1.5
#: Equal intervals between the samples.
INTERVALS: Final = 900
#: The release (rad) whose run is timed.
RELEASE: Final = math.radians(-20.0)
#: The releases (rad) over which the error is taken: the error of a single run depends on chance.
RELEASES: Final = tuple(math.radians(angle) for angle in (-20.0, -15.0, -8.0, 11.0, 17.0))
#: Tolerance of the FMU's integrator.
TOLERANCE: Final = 1e-8
#: Tolerance of the reference for errors; see `reference_theta`.
_TRUE_TOLERANCE: Final = 1e-15


def sample_times(intervals: int) -> FloatArray:
    """Instants (s) of the samples of a run, shape (intervals + 1,)."""
    return np.linspace(0.0, DURATION, intervals + 1)


@cache
def reference_theta(law: Law, release: float) -> FloatArray:
    """Angle (rad) at the 901 samples, shape (901,), by the reference at its tightest tolerance."""
    times = sample_times(INTERVALS)
    run = simulate(PARAMETERS[law], time=times, theta_start=release, tolerance=_TRUE_TOLERANCE)
    return run.theta


def error(law: Law, release: float, theta: FloatArray) -> float:
    """Largest error (rad) of theta, shape (n + 1,) at equal intervals over the run, n a divisor of 900."""
    return float(np.max(np.abs(theta - reference_theta(law, release)[:: INTERVALS // (theta.size - 1)])))
